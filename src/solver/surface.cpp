#include "solver/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "solver/self_collision.h"

namespace clothsim {
namespace {

// Room at the start, which grows.
constexpr std::uint32_t PAIRS_A_PARTICLE = 8;

using Corners = std::array<std::uint32_t, 3>;

// A number of 10 bits with two zeros behind each.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// Where along the curve of Morton (1966) a triangle lies, in the box of its piece.
class Curve {
 public:
  Curve(const Cloth& cloth, const Piece& piece) : cloth_(&cloth) {
    const auto all = cloth.positions().subspan(piece.firstParticle, piece.particleCount());
    low_ = all[0];
    Vec3d high = low_;
    for (const Vec3d& x : all) {
      low_ = {std::min(low_.x, x.x), std::min(low_.y, x.y), std::min(low_.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    size_ = std::max({high.x - low_.x, high.y - low_.y, high.z - low_.z, 1e-9});
  }
  [[nodiscard]] std::uint32_t placeOf(const Corners& t) const {
    const auto x = cloth_->positions();
    const Vec3d center = (1.0 / 3) * (x[t[0]] + x[t[1]] + x[t[2]]) - low_;
    const auto cell = [&](double c) {
      return static_cast<std::uint32_t>(std::clamp(1023 * c / size_, 0.0, 1023.0));
    };
    return spread(cell(center.x)) | spread(cell(center.y)) << 1 | spread(cell(center.z)) << 2;
  }

 private:
  const Cloth* cloth_;
  Vec3d low_;
  double size_;
};

std::vector<Corners> sortedTriangles(const Cloth& cloth, const Cuts& cuts) {
  std::vector<Curve> curves;
  for (const Piece& piece : cloth.pieces()) curves.emplace_back(cloth, piece);
  struct Placed {
    std::uint64_t place;
    Corners corners;
  };
  std::vector<Placed> placed;
  for (const Corners& corners : remainingTriangles(cloth, cuts)) {
    const std::size_t piece = cloth.pieceOf(corners[0]);
    placed.push_back({std::uint64_t{piece} << 32 | curves[piece].placeOf(corners), corners});
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.place < b.place; });
  std::vector<Corners> corners;
  for (const Placed& each : placed) corners.push_back(each.corners);
  return corners;
}

struct SharedSide {
  std::uint32_t first, second;  // triangles, second may be none
};

}  // namespace

bool hasSurfaceContact(const Scene& scene) { return scene.solver.selfCollision == SelfCollision::contact; }

template <class Real>
ClothSurface<Real> makeSurface(const Cloth& cloth, const Scene& scene, const Cuts& cuts) {
  ClothSurface<Real> surface;
  const std::vector<Corners> corners = sortedTriangles(cloth, cuts);
  const auto none = static_cast<std::uint32_t>(corners.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, SharedSide> sides;
  std::vector<std::uint32_t> owners(cloth.particleCount(), none), valences(cloth.particleCount(), 0);
  std::vector<double> shortest(cloth.particleCount(), INFINITY);
  const auto sideOf = [&](const Corners& t, std::size_t k) { return std::minmax(t[k], t[(k + 1) % 3]); };
  double longest = 0;
  for (std::uint32_t i = 0; i < none; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[i][k], b = corners[i][(k + 1) % 3];
      owners[a] = std::min(owners[a], i);
      ++valences[a];
      const auto [side, isNew] = sides.try_emplace(sideOf(corners[i], k), SharedSide{i, none});
      if (!isNew) side->second.second = i;
      const double length = clothsim::length(cloth.positions()[a] - cloth.positions()[b]);
      longest = std::max(longest, length);
      shortest[a] = std::min(shortest[a], length);
      shortest[b] = std::min(shortest[b], length);
    }
  for (std::uint32_t i = 0; i < none; ++i) {
    const Corners& t = corners[i];
    std::uint32_t owned = 0;
    std::array<std::uint32_t, 3> across{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (owners[t[k]] == i) owned |= 1u << k;
      const SharedSide& side = sides.at(sideOf(t, k));
      if (side.first == i) owned |= 1u << (OWNED_SIDE + k);
      const std::uint32_t other = side.first == i ? side.second : side.first;
      across[k] = NO_PARTICLE;
      for (const std::uint32_t particle : other == none ? t : corners[other])
        if (other != none && particle != t[k] && particle != t[(k + 1) % 3]) across[k] = particle;
    }
    surface.triangles.push_back({t[0], t[1], t[2], owned, across[0], across[1], across[2], 0});
  }
  double smallestRadius = INFINITY, largestRadius = 0, widest = 0;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const std::size_t piece = cloth.pieceOf(i);
    const ClothSettings& settings = scene.cloths[piece];
    const double thickness = settings.material ? settings.material->thickness : settings.thickness,
                 radius = valences[i] > 0 ? std::min(thickness / 2, shortest[i] / 4) : 0,
                 friction = scene.solver.selfFriction.value_or(settings.material ? settings.material->friction
                                                                                 : 0.3);
    if (valences[i] > 0) {
      smallestRadius = std::min(smallestRadius, radius);
      largestRadius = std::max(largestRadius, radius);
      widest = std::max(widest, shortest[i]);
    }
    surface.points.push_back({static_cast<Real>(radius), static_cast<Real>(friction),
                              static_cast<Real>(1.0 / std::max(valences[i], 1u)),
                              static_cast<Real>(4 * cloth.pieces()[piece].stiffestSpring())});
  }
  constexpr double rounding = 0x1p-24;
  surface.margin = static_cast<Real>(widest / 4);
  surface.around = static_cast<Real>(largestRadius + widest / 8);
  surface.leastGap =
      none == 0 ? Real(0)
                : static_cast<Real>(std::min(std::max(0.1 * smallestRadius, std::sqrt(rounding * longest)),
                                             0.5 * smallestRadius));
  surface.roomForPairs = PAIRS_A_PARTICLE * cloth.particleCount();
  surface.firstBoxes = {0};
  for (std::uint32_t count = none; count > 0;
       count = count == 1 ? 0 : (count + BOX_CHILDREN - 1) / BOX_CHILDREN)
    surface.firstBoxes.push_back(surface.firstBoxes.back() + count);
  return surface;
}

SurfaceState freshSurfaceState() {
  SurfaceState state{};
  state.leastGap = gapBits(INFINITY);
  return state;
}

template <class Real>
bool growRoom(ClothSurface<Real>& surface, const SurfaceState& state) {
  if (state.mostPairs <= surface.roomForPairs / 2) return false;
  surface.roomForPairs = 2 * state.mostPairs;
  return true;
}

ContactCounts countsOf(const SurfaceState& state) {
  ContactCounts counts;
  counts.clampedSteps = state.guardedSteps;
  counts.pairs = state.mostPairs;
  counts.shortened = state.shortened;
  counts.crowdedSteps = state.crowdedSteps;
  counts.leastGap = static_cast<double>(std::bit_cast<float>(state.leastGap));
  return counts;
}

template bool growRoom(ClothSurface<float>&, const SurfaceState&);
template bool growRoom(ClothSurface<double>&, const SurfaceState&);
template ClothSurface<float> makeSurface(const Cloth&, const Scene&, const Cuts&);
template ClothSurface<double> makeSurface(const Cloth&, const Scene&, const Cuts&);

}  // namespace clothsim

#include "render/mesh_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "shared/render_layout.h"

namespace clothsim {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// The two corners of a triangle that come after `corner`.
std::array<std::uint32_t, 2> othersOf(const std::array<std::uint32_t, 3>& t, std::uint32_t corner) {
  if (t[0] == corner) return {t[1], t[2]};
  return t[1] == corner ? std::array{t[2], t[0]} : std::array{t[0], t[1]};
}

// The front of a walk over the mesh, edge by edge, that has gone `steps` edges from a particle.
class Rings {
 public:
  Rings(const SpringLists& lists, std::uint32_t particles) : lists_(lists), seen_(particles, NEVER) {}

  std::vector<std::uint32_t> around(std::uint32_t particle, int steps) {
    std::vector<std::uint32_t> front{particle}, next;
    seen_[particle] = particle;
    for (int step = 0; step < steps; ++step) {
      next.clear();
      for (const std::uint32_t i : front)
        for (std::uint32_t at = lists_.trianglesOf.starts[i]; at < lists_.trianglesOf.starts[i + 1]; ++at)
          for (const std::uint32_t j : lists_.triangles[lists_.trianglesOf.entries[at]])
            if (seen_[j] != particle) {
              seen_[j] = particle;
              next.push_back(j);
            }
      std::swap(front, next);
    }
    return front;
  }

 private:
  static constexpr std::uint32_t NEVER = ~0u;
  const SpringLists& lists_;
  std::vector<std::uint32_t> seen_;
};

// At the start, whatever the mesh has lost since.
Vec3d normalAt(const Cloth& cloth, std::uint32_t i) {
  const SpringLists& lists = cloth.lists();
  Vec3d sum;
  for (std::uint32_t at = lists.trianglesOf.starts[i]; at < lists.trianglesOf.starts[i + 1]; ++at) {
    const auto [p, q] = othersOf(lists.triangles[lists.trianglesOf.entries[at]], i);
    sum =
        sum + cross(cloth.positions()[p] - cloth.positions()[i], cloth.positions()[q] - cloth.positions()[i]);
  }
  return sum;
}

// Of `candidates` the one nearest to each of MESH_RING directions around the particle, unless it lies 45
// degrees off.
void appendSpread(const Cloth& cloth, std::uint32_t particle, const std::vector<std::uint32_t>& candidates,
                  std::vector<std::uint32_t>& words) {
  const Vec3d here = cloth.positions()[particle], normal = normalAt(cloth, particle);
  const Vec3d any = std::abs(normal.x) < 0.6 * length(normal) ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
  const Vec3d across = cross(normal, any);
  const Vec3d u = (1 / length(across)) * across;
  const Vec3d around = cross(normal, u);
  const Vec3d v = (1 / length(around)) * around;
  std::vector<double> angles;
  for (const std::uint32_t candidate : candidates) {
    const Vec3d d = cloth.positions()[candidate] - here;
    angles.push_back(std::atan2(dot(d, v), dot(d, u)));
  }
  for (unsigned k = 0; k < MESH_RING; ++k) {
    const double wanted = 2 * std::numbers::pi * k / MESH_RING;
    std::uint32_t best = particle;
    double least = std::numbers::pi / 4;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const double off = std::abs(std::remainder(angles[c] - wanted, 2 * std::numbers::pi));
      if (off >= least) continue;
      least = off;
      best = candidates[c];
    }
    words.push_back(best);
  }
}

// Of a triangle at a seam of the texture the coordinates of its corners 0, 1, 2, 0, 1: from each corner on
// there are three.
constexpr std::uint32_t COORDINATES_A_TRIANGLE = 5;

// Where in textureCoordinatesOf() those of each such triangle begin.
std::map<Triangles::value_type, std::uint32_t> placesAtSeams(const Cloth& cloth) {
  std::map<Triangles::value_type, std::uint32_t> places;
  std::uint32_t place = cloth.particleCount();
  for (const auto& [triangle, corners] : cloth.textureSeams()) {
    places.emplace_hint(places.end(), triangle, place);
    place += COORDINATES_A_TRIANGLE;
  }
  return places;
}

}  // namespace

std::vector<std::array<float, 2>> textureCoordinatesOf(const Cloth& cloth) {
  std::vector<std::array<float, 2>> coordinates = cloth.textureCoordinates();
  for (const auto& [triangle, corners] : cloth.textureSeams())
    for (std::uint32_t k = 0; k < COORDINATES_A_TRIANGLE; ++k) coordinates.push_back(corners[k % 3]);
  return coordinates;
}

std::vector<std::uint32_t> meshNeighbours(const Cloth& cloth, const SpringLists& lists, const Piece& mesh,
                                          double reach) {
  const std::uint32_t count = mesh.particleCount();
  const std::map<Triangles::value_type, std::uint32_t> seams = placesAtSeams(cloth);
  std::vector<std::uint32_t> words(std::size_t{count} + 1);
  for (std::uint32_t local = 0; local < count; ++local) {
    const std::uint32_t i = mesh.firstParticle + local;
    words[local] = static_cast<std::uint32_t>(words.size());
    for (std::uint32_t at = lists.trianglesOf.starts[i]; at < lists.trianglesOf.starts[i + 1]; ++at) {
      const auto& triangle = lists.triangles[lists.trianglesOf.entries[at]];
      const auto [next, previous] = othersOf(triangle, i);
      words.push_back(next);
      words.push_back(previous);
      const auto seam = seams.find(triangle);
      const auto corner = static_cast<std::uint32_t>(std::ranges::find(triangle, i) - triangle.begin());
      words.push_back(seam == seams.end() ? 0 : seam->second + corner);
    }
  }
  words[count] = static_cast<std::uint32_t>(words.size());
  const int steps = static_cast<int>(std::clamp(std::lround(reach / mesh.nominalLength[toLeft]), 1L, 8L));
  Rings rings(lists, cloth.particleCount());
  for (std::uint32_t local = 0; local < count; ++local)
    appendSpread(cloth, mesh.firstParticle + local, rings.around(mesh.firstParticle + local, steps), words);
  return words;
}

}  // namespace clothsim

#include "solver/cpu/near_parts.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "core/thread_team.h"

namespace clothsim::cpu {
namespace {

template <class Real>
bool isWithin(const Bounds<Real>& inner, const Bounds<Real>& outer, Four<Real> shift) {
  // Rounding keeps the order of numbers: boxes that meet, meet after the shift, too.
  const auto isInside = (outer.low <= inner.low - shift) & (inner.high - shift <= outer.high);
  return (isInside[0] & isInside[1] & isInside[2]) != 0;
}

}  // namespace

template <class Real>
bool NearParts<Real>::covers(const std::vector<MovingBounds<Real>>& particles, Four<Real> shift,
                             Four<Real> shiftAtEnd) const {
  if (covers_.particles.size() != particles.size()) return false;
  std::atomic<bool> all = true;
  ThreadTeam::shared().forEachRange(
      0, static_cast<std::uint32_t>(particles.size()), BOXES_AT_ONCE,
      [&](std::uint32_t first, std::uint32_t end) {
        for (std::uint32_t i = first; i < end && all.load(std::memory_order_relaxed); ++i)
          if (!isWithin(particles[i].start, covers_.particles[i].start, shift) ||
              !isWithin(particles[i].end, covers_.particles[i].end, shiftAtEnd))
            all.store(false, std::memory_order_relaxed);
      });
  return all;
}

// From how far particles may be from the middle of their covers, wherever in their boxes they are, with what
// rounding may hide of it.
template <class Real>
void NearParts<Real>::findDrifts(const ClothSurface<Real>& surface,
                                 const std::vector<MovingBounds<Real>>& particles, Four<Real> shift,
                                 Four<Real> shiftAtEnd, Real around) {
  const Four<Real> within{around, around, around, Real(0)};
  const Four<Real> rounding = Four<Real>{} + Real(8) * std::numeric_limits<Real>::epsilon();
  const auto largerOf = [](Four<Real> a, Four<Real> b) { return a < b ? b : a; };
  const auto drift = [&](const Bounds<Real>& box, const Bounds<Real>& cover, Four<Real> moved) {
    const Four<Real> middle = Real(0.5) * (cover.low + cover.high),
                     above = ((box.high - moved) - within) - middle,
                     below = middle - ((box.low - moved) + within);
    return largerOf(above, below) +
           rounding * (largerOf(cover.high, -cover.low) + largerOf(box.high, -box.low));
  };
  constexpr Real diagonal = static_cast<Real>(1.74);  // of a cube
  particleDrifts_.resize(particles.size());
  ThreadTeam::shared().forEach(
      0, static_cast<std::uint32_t>(particles.size()), BOXES_AT_ONCE, [&](std::uint32_t i) {
        const Four<Real> start = drift(particles[i].start, covers_.particles[i].start, shift),
                         end = drift(particles[i].end, covers_.particles[i].end, shiftAtEnd);
        const Four<Real> most = largerOf(start, end);
        particleDrifts_[i] = Real(3) * diagonal * std::max({most[0], most[1], most[2]});
      });
  drifts_.resize(surface.triangles.size());
  ThreadTeam::shared().forEach(
      0, static_cast<std::uint32_t>(drifts_.size()), BOXES_AT_ONCE, [&](std::uint32_t i) {
        const auto [a, b, c] = cornersOf(surface.triangles[i]);
        drifts_[i] = std::max({particleDrifts_[a], particleDrifts_[b], particleDrifts_[c]});
      });
}

// Triangles' boxes may be older than those of their particles.
template <class Real>
void NearParts<Real>::makeCovers(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes,
                                 Real more) {
  const Four<Real> around{more, more, more, Real(0)};
  covers_.particles.resize(boxes.particles.size());
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(boxes.particles.size()), BOXES_AT_ONCE,
                               [&](std::uint32_t i) {
                                 const MovingBounds<Real>& box = boxes.particles[i];
                                 covers_.particles[i] = {{box.start.low - around, box.start.high + around},
                                                         {box.end.low - around, box.end.high + around}};
                               });
  covers_.joinTriangles(surface);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    covers_.triangles[i] = joined(covers_.triangles[i], boxes.triangles[i]);
  SurfaceSearch<Real>::growTree(surface, covers_.triangles);
  children_.assign((surface.triangles.size() + BOX_CHILDREN - 1) / BOX_CHILDREN, {});
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    children_[i / BOX_CHILDREN].set(i % BOX_CHILDREN, covers_.triangles[i]);
}

template <class Real>
bool NearParts<Real>::areStillFlat(const FlatBlocks<Real>& flat) const {
  for (std::size_t block = 0; block < leftOut_.size(); ++block)
    if (leftOut_[block] > flat.isFlat()[block]) return false;
  return true;
}

template <class Real>
template <class Belongs>
void NearParts<Real>::makeList(const ClothSurface<Real>& surface, List& list, Belongs belongs) const {
  const auto triangles = static_cast<std::uint32_t>(surface.triangles.size()),
             chunks = (triangles + TRIANGLES - 1) / TRIANGLES;
  const SurfaceSearch<Real> search{surface, covers_.triangles};
  list.parts.resize(chunks);
  list.apart.resize(chunks);
  list.ends.resize(triangles);
  list.isTooLong.resize(chunks);
  ThreadTeam::shared().forEach(0, chunks, 1, [&](std::uint32_t chunk) {
    std::vector<Parts>& found = list.parts[chunk];
    found.clear();
    list.apart[chunk].clear();
    const std::uint32_t first = chunk * TRIANGLES, end = std::min(first + TRIANGLES, triangles);
    std::vector<std::uint32_t> nearGroups;
    for (std::uint32_t i = first; i < end && found.size() <= MOST; i += BOX_CHILDREN)
      search.forEachPairOfGroup(
          i / BOX_CHILDREN, covers_, children_, nearGroups, belongs,
          [&](const Parts& parts) {
            if (found.size() <= MOST) found.push_back(parts);
          },
          [&](std::uint32_t triangle) {
            for (std::size_t n = list.apart[chunk].size(); n < found.size(); ++n)
              list.apart[chunk].push_back(
                  {found[n].first == triangle ? found[n].second : found[n].first, Real(-1)});
            list.ends[triangle] = static_cast<std::uint32_t>(found.size());
          });
    list.isTooLong[chunk] = found.size() > MOST ? 1 : 0;
  });
}

template <class Real>
bool NearParts<Real>::update(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes,
                             Vec3<Real> origin, Vec3<Real> originAtEnd, Real around, Real more,
                             const FlatBlocks<Real>& flat) {
  const Four<Real> shift = fourOf(origin - origin_), shiftAtEnd = fourOf(originAtEnd - originAtEnd_);
  if (covers(boxes.particles, shift, shiftAtEnd) && areStillFlat(flat)) {
    findDrifts(surface, boxes.particles, shift, shiftAtEnd, around);
    return false;
  }
  origin_ = origin;
  originAtEnd_ = originAtEnd;
  makeCovers(surface, boxes, more);
  findDrifts(surface, boxes.particles, Four<Real>{}, Four<Real>{}, around);
  leftOut_ = flat.isSurelyFlat();
  makeList(surface, near_,
           [&](std::uint32_t triangle, std::uint32_t other) { return !isLeftOut(surface, triangle, other); });
  hasFlat_ = false;
  return true;
}

template <class Real>
void NearParts<Real>::listFlat(const ClothSurface<Real>& surface) {
  if (hasFlat_) return;
  makeList(surface, flat_,
           [&](std::uint32_t triangle, std::uint32_t other) { return isLeftOut(surface, triangle, other); });
  hasFlat_ = true;
}

template class NearParts<float>;
template class NearParts<double>;

}  // namespace clothsim::cpu

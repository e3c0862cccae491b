#include "solver/cpu/near_parts.h"

#include <algorithm>
#include <atomic>

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
  list.ends.resize(triangles);
  list.isTooLong.resize(chunks);
  ThreadTeam::shared().forEach(0, chunks, 1, [&](std::uint32_t chunk) {
    std::vector<Parts>& found = list.parts[chunk];
    found.clear();
    const std::uint32_t first = chunk * TRIANGLES, end = std::min(first + TRIANGLES, triangles);
    std::vector<std::uint32_t> nearGroups;
    for (std::uint32_t i = first; i < end && found.size() <= MOST; i += BOX_CHILDREN)
      search.forEachPairOfGroup(
          i / BOX_CHILDREN, covers_, children_, nearGroups, belongs,
          [&](const Parts& parts) {
            if (found.size() <= MOST) found.push_back(parts);
          },
          [&](std::uint32_t triangle) { list.ends[triangle] = static_cast<std::uint32_t>(found.size()); });
    list.isTooLong[chunk] = found.size() > MOST ? 1 : 0;
  });
}

template <class Real>
bool NearParts<Real>::update(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes,
                             Vec3<Real> origin, Vec3<Real> originAtEnd, Real more,
                             const FlatBlocks<Real>& flat) {
  if (covers(boxes.particles, fourOf(origin - origin_), fourOf(originAtEnd - originAtEnd_)) &&
      areStillFlat(flat))
    return false;
  origin_ = origin;
  originAtEnd_ = originAtEnd;
  makeCovers(surface, boxes, more);
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

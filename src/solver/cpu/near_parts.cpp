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
bool NearParts<Real>::covers(const std::vector<Bounds<Real>>& particles, Four<Real> shift) const {
  if (covers_.particles.size() != particles.size()) return false;
  std::atomic<bool> all = true;
  ThreadTeam::shared().forEachRange(0, static_cast<std::uint32_t>(particles.size()), BOXES_AT_ONCE,
                                    [&](std::uint32_t first, std::uint32_t end) {
                                      for (std::uint32_t i = first;
                                           i < end && all.load(std::memory_order_relaxed); ++i)
                                        if (!isWithin(particles[i], covers_.particles[i], shift))
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
  ThreadTeam::shared().forEach(
      0, static_cast<std::uint32_t>(boxes.particles.size()), BOXES_AT_ONCE, [&](std::uint32_t i) {
        covers_.particles[i] = {boxes.particles[i].low - around, boxes.particles[i].high + around};
      });
  covers_.joinTriangles(surface);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    covers_.triangles[i] = joined(covers_.triangles[i], boxes.triangles[i]);
  SurfaceSearch<Real>::growTree(surface, covers_.triangles);
}

template <class Real>
bool NearParts<Real>::update(const ClothSurface<Real>& surface, const SurfaceBoxes<Real>& boxes,
                             Vec3<Real> origin, Real more) {
  if (covers(boxes.particles, fourOf(origin - origin_))) return false;
  origin_ = origin;
  makeCovers(surface, boxes, more);
  const auto triangles = static_cast<std::uint32_t>(surface.triangles.size()),
             chunks = (triangles + TRIANGLES - 1) / TRIANGLES;
  const SurfaceSearch<Real> search{surface, covers_.triangles};
  parts_.resize(chunks);
  ends_.resize(triangles);
  isTooLong_.resize(chunks);
  ThreadTeam::shared().forEach(0, chunks, 1, [&](std::uint32_t chunk) {
    std::vector<Parts>& found = parts_[chunk];
    found.clear();
    const std::uint32_t first = chunk * TRIANGLES, end = std::min(first + TRIANGLES, triangles);
    std::vector<std::uint32_t> nearGroups;
    for (std::uint32_t i = first; i < end && found.size() <= MOST; i += BOX_CHILDREN)
      search.forEachPairOfGroup(
          i / BOX_CHILDREN, covers_, nearGroups,
          [&](const Parts& parts) {
            if (found.size() <= MOST) found.push_back(parts);
          },
          [&](std::uint32_t triangle) { ends_[triangle] = static_cast<std::uint32_t>(found.size()); });
    isTooLong_[chunk] = found.size() > MOST ? 1 : 0;
  });
  return true;
}

template class NearParts<float>;
template class NearParts<double>;

}  // namespace clothsim::cpu

#include "render/triangle_sides.h"

#include <algorithm>

namespace clothsim {
namespace {

constexpr int MOST_TRIANGLES_AROUND = 1000;  // a point

}  // namespace

TriangleSides::TriangleSides(std::span<const std::array<std::uint32_t, 3>> triangles)
    : triangles_(triangles) {
  std::uint32_t points = 0;
  for (const auto& triangle : triangles) points = std::max({points, triangle[0], triangle[1], triangle[2]});
  starts_.assign(std::size_t{points} + 3, 0);
  for (std::uint32_t side = 0; side < count(); ++side) ++starts_[from(side) + 2];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  sides_.resize(count());
  for (std::uint32_t side = 0; side < count(); ++side) sides_[starts_[from(side) + 1]++] = side;
}

std::uint32_t TriangleSides::find(std::uint32_t from, std::uint32_t to) const {
  if (from + 1 >= starts_.size()) return NONE;
  for (std::uint32_t at = starts_[from]; at < starts_[from + 1]; ++at)
    if (this->to(sides_[at]) == to) return sides_[at];
  return NONE;
}

std::uint32_t TriangleSides::nextOnBorder(std::uint32_t side) const {
  for (int k = 0; k < MOST_TRIANGLES_AROUND; ++k) {
    const std::uint32_t next = side / 3 * 3 + (side + 1) % 3, other = twin(next);
    if (other == NONE) return next;
    side = other;
  }
  return NONE;
}

std::vector<BorderCorner> borderOf(const TriangleSides& sides) {
  constexpr std::uint32_t NONE = TriangleSides::NONE;
  std::vector<std::uint32_t> found, before(sides.count(), NONE), place(sides.count(), NONE);
  for (std::uint32_t side = 0; side < sides.count(); ++side) {
    if (sides.twin(side) != NONE) continue;
    const std::uint32_t next = sides.nextOnBorder(side);
    if (next == NONE) continue;
    before[next] = side;
    found.push_back(side);
  }
  std::erase_if(found, [&](std::uint32_t side) { return before[side] == NONE; });
  for (std::size_t i = 0; i < found.size(); ++i) place[found[i]] = static_cast<std::uint32_t>(i);
  std::vector<BorderCorner> corners;
  for (const std::uint32_t side : found)
    corners.push_back(
        {sides.from(before[side]), sides.from(side), sides.to(side), place[sides.nextOnBorder(side)]});
  return corners;
}

}  // namespace clothsim

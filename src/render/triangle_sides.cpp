#include "render/triangle_sides.h"

#include <algorithm>

namespace clothsim {
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
  // Each triangle around the point has a side that begins there.
  const std::uint32_t point = to(side), around = starts_[point + 1] - starts_[point];
  for (std::uint32_t k = 0; k < around; ++k) {
    const std::uint32_t next = side / 3 * 3 + (side + 1) % 3, other = twin(next);
    if (other == NONE) return next;
    side = other;
  }
  return NONE;
}

namespace {

constexpr std::uint32_t NONE = TriangleSides::NONE;

// For each side on a border the next one, else NONE. Where triangles make no surface a border may break off:
// then its sides have none, either, since who follows a border comes back to its beginning.
std::vector<std::uint32_t> sidesBehind(const TriangleSides& sides) {
  enum : std::uint8_t { unseen, onTheWay, closed, open };
  std::vector<std::uint32_t> behind(sides.count(), NONE), way;
  std::vector<std::uint8_t> found(sides.count(), unseen);
  for (std::uint32_t side = 0; side < sides.count(); ++side)
    if (sides.twin(side) == NONE) behind[side] = sides.nextOnBorder(side);
  for (std::uint32_t side = 0; side < sides.count(); ++side) {
    std::uint32_t at = side;
    for (; at != NONE && found[at] == unseen; at = behind[at]) {
      found[at] = onTheWay;
      way.push_back(at);
    }
    const bool breaksOff = at == NONE || found[at] == open;
    for (const std::uint32_t passed : way) found[passed] = breaksOff ? open : closed;
    way.clear();
  }
  for (std::uint32_t side = 0; side < sides.count(); ++side)
    if (found[side] == open) behind[side] = NONE;
  return behind;
}

}  // namespace

std::vector<BorderCorner> borderOf(const TriangleSides& sides) {
  const std::vector<std::uint32_t> behind = sidesBehind(sides);
  std::vector<std::uint32_t> found, before(sides.count(), NONE), place(sides.count(), NONE);
  for (std::uint32_t side = 0; side < sides.count(); ++side)
    if (behind[side] != NONE) before[behind[side]] = side;
  for (std::uint32_t side = 0; side < sides.count(); ++side) {
    if (behind[side] == NONE || before[side] == NONE) continue;
    place[side] = static_cast<std::uint32_t>(found.size());
    found.push_back(side);
  }
  std::vector<BorderCorner> corners;
  for (const std::uint32_t side : found)
    corners.push_back({sides.from(before[side]), sides.from(side), sides.to(side), place[behind[side]]});
  return corners;
}

}  // namespace clothsim

// The sides of triangles, and which of them meet: borders are where none does.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace clothsim {

// A point of a border between the two beside it, in the direction in which the cloth lies to the left, seen
// from the front.
struct BorderCorner {
  std::uint32_t before, here, after;
  std::uint32_t next;  // the corner at `after`, as its place in the list
  friend bool operator==(const BorderCorner&, const BorderCorner&) = default;
};

// Directed sides of triangles, found by their ends. A side is three times its triangle and its place there.
class TriangleSides {
 public:
  static constexpr std::uint32_t NONE = ~0u;
  // Keeps a view of them.
  explicit TriangleSides(std::span<const std::array<std::uint32_t, 3>> triangles);
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(3 * triangles_.size()); }
  [[nodiscard]] std::uint32_t from(std::uint32_t side) const { return triangles_[side / 3][side % 3]; }
  [[nodiscard]] std::uint32_t to(std::uint32_t side) const { return triangles_[side / 3][(side + 1) % 3]; }
  [[nodiscard]] std::uint32_t find(std::uint32_t from, std::uint32_t to) const;  // or NONE
  // The same side of the other triangle; NONE on a border.
  [[nodiscard]] std::uint32_t twin(std::uint32_t side) const { return find(to(side), from(side)); }
  // Of a side on a border: the one that goes on from its end, around the triangles there. NONE where
  // triangles make no surface.
  [[nodiscard]] std::uint32_t nextOnBorder(std::uint32_t side) const;

 private:
  std::span<const std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> starts_, sides_;  // of each point where its sides begin; sides by their start
};

// Of triangles that are counterclockwise seen from the front, in their order. A point where several borders
// meet has a corner in each.
[[nodiscard]] std::vector<BorderCorner> borderOf(const TriangleSides& sides);

}  // namespace clothsim

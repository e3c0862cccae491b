#include "scene/polygon.h"

#include <algorithm>
#include <numeric>

namespace clothsim {
namespace {

using Corners = std::array<std::size_t, 3>;

// Of the area that a triangle has at least, as a part of the whole polygon's.
constexpr double LEAST_PART = 1e-9;

// Twice its area, along its normal (M. E. Newell, 1972).
Vec3d areaOf(std::span<const Vec3d> polygon) {
  Vec3d sum{};
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum = sum + cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  return sum;
}

class EarCutter {
 public:
  explicit EarCutter(std::span<const Vec3d> polygon) : polygon_(polygon), left_(polygon.size()) {
    const Vec3d area = areaOf(polygon);
    least_ = LEAST_PART * dot(area, area);
    normal_ = area;
    std::iota(left_.begin(), left_.end(), 0);
  }

  std::vector<Corners> cut() {
    std::vector<Corners> triangles;
    while (left_.size() > 3) {
      const std::size_t ear = nextEar();
      triangles.push_back(cornerAt(ear));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
    return triangles;
  }

  // Twice the area of a triangle as seen along the polygon's normal, times twice the polygon's.
  [[nodiscard]] double seen(const Corners& t) const {
    return dot(normal_, cross(polygon_[t[1]] - polygon_[t[0]], polygon_[t[2]] - polygon_[t[0]]));
  }
  [[nodiscard]] bool isWhole(const Corners& t) const { return seen(t) > least_; }

 private:
  [[nodiscard]] Corners cornerAt(std::size_t place) const {
    const std::size_t count = left_.size();
    return {left_[(place + count - 1) % count], left_[place], left_[(place + 1) % count]};
  }
  [[nodiscard]] double thirdSideOf(std::size_t place) const {
    const auto [a, b, c] = cornerAt(place);
    const Vec3d side = polygon_[c] - polygon_[a];
    return dot(side, side);
  }

  // Whether no other corner lies within, or on the sides.
  [[nodiscard]] bool isEmpty(const Corners& t) const {
    return std::none_of(left_.begin(), left_.end(), [&](std::size_t other) {
      for (const std::size_t corner : t)
        if (polygon_[corner] == polygon_[other]) return false;
      return seen({t[0], t[1], other}) >= -least_ && seen({t[1], t[2], other}) >= -least_ &&
             seen({t[2], t[0], other}) >= -least_;
    });
  }

  [[nodiscard]] std::size_t nextEar() const {
    std::vector<std::pair<double, std::size_t>> order(left_.size());
    for (std::size_t place = 0; place < order.size(); ++place) order[place] = {thirdSideOf(place), place};
    std::sort(order.begin(), order.end());
    for (const auto& [side, place] : order) {
      const Corners corner = cornerAt(place);
      if (isWhole(corner) && isEmpty(corner)) return place;
    }
    return order.front().second;
  }

  std::span<const Vec3d> polygon_;
  Vec3d normal_;
  double least_ = 0;
  std::vector<std::size_t> left_;
};

}  // namespace

std::vector<Corners> trianglesOf(std::span<const Vec3d> polygon) {
  if (polygon.size() == 3) return {{0, 1, 2}};
  EarCutter cutter(polygon);
  if (polygon.size() == 4) {
    const Vec3d first = polygon[2] - polygon[0], second = polygon[3] - polygon[1];
    const std::vector<Corners> halves = dot(first, first) < dot(second, second)
                                            ? std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}
                                            : std::vector<Corners>{{0, 1, 3}, {1, 2, 3}};
    if (cutter.isWhole(halves[0]) && cutter.isWhole(halves[1])) return halves;
  }
  return cutter.cut();
}

}  // namespace clothsim

#include "render/patches.h"

#include <algorithm>
#include <map>
#include <utility>

namespace clothsim {
namespace {

constexpr std::uint32_t NONE = TriangleSides::NONE;

class Divider {
 public:
  Divider(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t steps,
          std::uint32_t firstPoint, std::span<const Vec3d> rest,
          std::span<const std::array<float, 2>> textureCoordinates, const TextureSeams& textureSeams)
      : sides_(triangles),
        corners_(borderOf(sides_)),
        steps_(steps),
        firstPoint_(firstPoint),
        rest_(rest),
        textureCoordinates_(textureCoordinates),
        textureSeams_(textureSeams) {
    makeCornerPoints();
    makeSidePoints();
    for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) divide(triangle);
    makeBorder();
  }

  Patches made;

 private:
  std::uint32_t add(const PatchPoint& point, std::array<float, 2> textureCoordinate) {
    made.points.push_back(point);
    made.textureCoordinates.push_back(textureCoordinate);
    return firstPoint_ + static_cast<std::uint32_t>(made.points.size()) - 1;
  }
  // Between three particles, by their steps.
  std::uint32_t addBetween(std::array<std::uint32_t, 3> p, std::array<std::uint32_t, 3> steps) {
    const std::array corners{textureCoordinates_[p[0]], textureCoordinates_[p[1]], textureCoordinates_[p[2]]};
    return add({{p[0], p[1], p[2], p[2]}, {steps[0], steps[1], steps[2], 0}}, between(corners, steps));
  }
  // Texture coordinates that are `steps` away from those of three corners.
  [[nodiscard]] std::array<float, 2> between(const std::array<std::array<float, 2>, 3>& corners,
                                             std::array<std::uint32_t, 3> steps) const {
    std::array<double, 2> uv{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 2; ++c)
        uv[c] += static_cast<double>(steps[k]) / steps_ * static_cast<double>(corners[k][c]);
    return {static_cast<float>(uv[0]), static_cast<float>(uv[1])};
  }
  // The point itself, or one at its place with these texture coordinates.
  std::uint32_t withCoordinates(std::uint32_t point, std::array<float, 2> uv) {
    const std::size_t local = point - firstPoint_;
    if (made.textureCoordinates[local] == uv) return point;
    const auto [found, isNew] = pointsAtSeams_.try_emplace({point, uv}, 0);
    if (isNew) found->second = add(PatchPoint{made.points[local]}, uv);
    return found->second;
  }

  void makeCornerPoints() {
    std::uint32_t most = 0;
    for (std::uint32_t side = 0; side < sides_.count(); ++side) most = std::max(most, sides_.from(side));
    pointOf_.assign(std::size_t{most} + 1, NONE);
    for (std::uint32_t side = 0; side < sides_.count(); ++side) {
      const std::uint32_t particle = sides_.from(side);
      if (pointOf_[particle] == NONE)
        pointOf_[particle] = addBetween({particle, particle, particle}, {steps_, 0, 0});
    }
  }

  // Where the border goes straight on at a corner, the point before or behind it, else the corner itself.
  [[nodiscard]] std::uint32_t unlessSharp(const BorderCorner& corner, std::uint32_t other) const {
    const Vec3d in = rest_[corner.here] - rest_[corner.before],
                out = rest_[corner.after] - rest_[corner.here];
    constexpr double leastCosine = 0.7071;
    return dot(in, out) > leastCosine * length(in) * length(out) ? other : corner.here;
  }

  void makeSidePoints() {
    firstOnSide_.assign(sides_.count(), NONE);
    for (const BorderCorner& corner : corners_) {
      const BorderCorner& next = corners_[corner.next];
      const std::uint32_t side = sides_.find(corner.here, corner.after);
      firstOnSide_[side] = firstPoint_ + static_cast<std::uint32_t>(made.points.size());
      const std::uint32_t before = unlessSharp(corner, corner.before), behind = unlessSharp(next, next.after);
      for (std::uint32_t k = 1; k < steps_; ++k) {
        addBetween({corner.here, corner.after, corner.after}, {steps_ - k, k, 0});
        made.points.back() = {{before, corner.here, corner.after, behind}, {0, steps_ - k, k, 1}};
      }
    }
    for (std::uint32_t side = 0; side < sides_.count(); ++side) {
      const std::uint32_t twin = sides_.twin(side);
      if (firstOnSide_[side] != NONE || (twin != NONE && firstOnSide_[twin] != NONE)) continue;
      firstOnSide_[side] = firstPoint_ + static_cast<std::uint32_t>(made.points.size());
      const std::uint32_t a = sides_.from(side), b = sides_.to(side);
      for (std::uint32_t k = 1; k < steps_; ++k) addBetween({a, b, b}, {steps_ - k, k, 0});
    }
  }

  // `k` steps from the beginning of a side.
  [[nodiscard]] std::uint32_t pointOnSide(std::uint32_t side, std::uint32_t k) const {
    if (k == 0) return pointOf_[sides_.from(side)];
    if (k == steps_) return pointOf_[sides_.to(side)];
    if (firstOnSide_[side] != NONE) return firstOnSide_[side] + k - 1;
    return firstOnSide_[sides_.twin(side)] + steps_ - k - 1;
  }

  // Row by row from the first side of the triangle to its last corner.
  void divide(std::uint32_t triangle) {
    const std::uint32_t side = 3 * triangle;
    const std::array corners{sides_.from(side), sides_.from(side + 1), sides_.from(side + 2)};
    const auto seam = textureSeams_.find(corners);
    std::vector<std::uint32_t> below, row;
    for (std::uint32_t k = 0; k <= steps_; ++k) {
      row.clear();
      for (std::uint32_t j = 0; j + k <= steps_; ++j) {
        const std::uint32_t i = steps_ - j - k;
        if (k == 0)
          row.push_back(pointOnSide(side, j));
        else if (i == 0)
          row.push_back(pointOnSide(side + 1, k));
        else if (j == 0)
          row.push_back(pointOnSide(side + 2, i));
        else
          row.push_back(addBetween(corners, {i, j, k}));
        if (seam != textureSeams_.end())
          row.back() = withCoordinates(row.back(), between(seam->second, {i, j, k}));
      }
      for (std::size_t j = 0; k > 0 && j < row.size(); ++j) {
        made.triangles.push_back({below[j], below[j + 1], row[j]});
        if (j + 1 < row.size()) made.triangles.push_back({below[j + 1], row[j + 1], row[j]});
      }
      std::swap(below, row);
    }
  }

  void makeBorder() {
    std::vector<std::uint32_t> around;  // of each corner its point and those behind it
    for (const BorderCorner& corner : corners_)
      for (std::uint32_t k = 0; k < steps_; ++k)
        around.push_back(pointOnSide(sides_.find(corner.here, corner.after), k));
    made.border.resize(around.size());
    for (std::uint32_t i = 0; i < around.size(); ++i) {
      const std::uint32_t next = (i + 1) % steps_ != 0 ? i + 1 : steps_ * corners_[i / steps_].next;
      made.border[i].here = around[i];
      made.border[i].after = around[next];
      made.border[i].next = next;
      made.border[next].before = around[i];
    }
  }

  TriangleSides sides_;
  std::vector<BorderCorner> corners_;  // of particles
  std::uint32_t steps_, firstPoint_;
  std::span<const Vec3d> rest_;
  std::span<const std::array<float, 2>> textureCoordinates_;
  const TextureSeams& textureSeams_;
  std::map<std::pair<std::uint32_t, std::array<float, 2>>, std::uint32_t> pointsAtSeams_;
  std::vector<std::uint32_t> pointOf_;      // by particle
  std::vector<std::uint32_t> firstOnSide_;  // NONE: on its twin
};

}  // namespace

Patches divideTriangles(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t steps,
                        std::uint32_t firstPoint, std::span<const Vec3d> rest,
                        std::span<const std::array<float, 2>> textureCoordinates,
                        const TextureSeams& textureSeams) {
  return Divider(triangles, steps, firstPoint, rest, textureCoordinates, textureSeams).made;
}

}  // namespace clothsim

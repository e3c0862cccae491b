#include "render/backdrop_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clothsim {
namespace {

constexpr int TILE = 32;             // [pixels]
constexpr float OUTLINE_MARGIN = 2;  // [pixels] around the ground's outline, where both are seen

// Of the ground [sizes of the scene], by sides so short that tiles along them are few.
std::vector<glm::vec2> outlineOf(GroundShape shape) {
  constexpr int sides = 256;
  std::vector<glm::vec2> points;
  if (shape == GroundShape::endless) return points;
  const glm::vec2 half(HALF_TABLE_LENGTH, HALF_TABLE_DEPTH);
  for (int i = 0; i < sides; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / sides;
    const glm::vec2 direction(std::cos(angle), std::sin(angle));
    if (shape == GroundShape::room) {
      points.push_back(static_cast<float>(ROOM_RADIUS) * direction);
      continue;
    }
    // A table's corners are rounded: a quarter of the points each, and between them its sides.
    const glm::vec2 corner = (half - static_cast<float>(TABLE_CORNER)) *
                             glm::vec2(direction.x < 0 ? -1 : 1, direction.y < 0 ? -1 : 1);
    const glm::vec2 next = corner + static_cast<float>(TABLE_CORNER) * direction;
    if (!points.empty())
      if (const glm::vec2 last = points.back(); glm::distance(last, next) > TABLE_CORNER)
        for (int k = 1; k < sides / 4; ++k)
          points.push_back(glm::mix(last, next, static_cast<float>(k) / (sides / 4)));
    points.push_back(next);
  }
  return points;
}

// What of the ground is seen, as shaders/render/walls.glsl looks at it.
class SeenGround {
 public:
  SeenGround(const shared::RenderFrame& frame, GroundShape shape) : frame_(frame), shape_(shape) {}

  [[nodiscard]] bool isAt(glm::vec2 pixel) const {
    const glm::vec2 place = 2.0f * pixel * glm::vec2(frame_.pixels.z, frame_.pixels.w) - 1.0f;
    const glm::vec3 ray(frame_.rayMiddle + place.x * frame_.rayRight + place.y * frame_.rayUp);
    const float height = frame_.eye.y - frame_.stagePlace.y;
    if (!(frame_.ground.w > 0 && height > 0 && ray.y < -1e-5f * glm::length(ray))) return false;
    return isGround(fromMiddle(glm::vec3(frame_.eye) - height / ray.y * ray));
  }

  // Whether the eye is where its shape says what it sees.
  [[nodiscard]] bool isKnown() const {
    return shape_ != GroundShape::room ||
           glm::length(fromMiddle(glm::vec3(frame_.eye))) < static_cast<float>(ROOM_RADIUS);
  }

  // The pixels of a side of the outline; empty where it is behind the eye.
  [[nodiscard]] FlatBounds sideAt(glm::vec2 from, glm::vec2 to) const {
    FlatBounds seen;
    addSide(clipOf(from), clipOf(to), {frame_.pixels.x, frame_.pixels.y}, seen);
    return seen;
  }

 private:
  [[nodiscard]] glm::vec2 fromMiddle(glm::vec3 position) const {
    return glm::vec2(position.x - frame_.stagePlace.x, position.z - frame_.stagePlace.z) *
           (static_cast<float>(STAGE_SIZES) / frame_.stagePlace.w);
  }
  [[nodiscard]] bool isGround(glm::vec2 at) const {
    if (shape_ == GroundShape::endless) return true;
    if (shape_ == GroundShape::room) return glm::length(at) < static_cast<float>(ROOM_RADIUS);
    const glm::vec2 q =
        glm::abs(at) - (glm::vec2(HALF_TABLE_LENGTH, HALF_TABLE_DEPTH) - static_cast<float>(TABLE_CORNER));
    return glm::length(glm::max(q, 0.0f)) + std::min(std::max(q.x, q.y), 0.0f) <
           static_cast<float>(TABLE_CORNER);
  }
  [[nodiscard]] glm::vec4 clipOf(glm::vec2 at) const {
    const glm::vec2 metres = at * (frame_.stagePlace.w / static_cast<float>(STAGE_SIZES));
    return frame_.clipFromWorld *
           glm::vec4(frame_.stagePlace.x + metres.x, frame_.stagePlace.y, frame_.stagePlace.z + metres.y, 1);
  }

  const shared::RenderFrame& frame_;
  GroundShape shape_;
};

// The tiles of a picture, row by row.
struct Tiles {
  int columns, rows;
  [[nodiscard]] std::size_t number(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

std::vector<bool> tilesOnOutline(const SeenGround& ground, GroundShape shape, const Tiles& tiles) {
  std::vector<bool> marked(tiles.number(0, tiles.rows));
  const auto tileAt = [](float pixel, int count) {
    return static_cast<int>(std::clamp(std::floor(pixel / TILE), -1.0f, static_cast<float>(count)));
  };
  const std::vector<glm::vec2> outline = outlineOf(shape);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const FlatBounds side =
        ground.sideAt(outline[i], outline[(i + 1) % outline.size()]).grown(OUTLINE_MARGIN);
    if (!(side.low.x <= side.high.x)) continue;
    const int left = std::max(tileAt(side.low.x, tiles.columns), 0),
              right = std::min(tileAt(side.high.x, tiles.columns), tiles.columns - 1),
              bottom = std::max(tileAt(side.low.y, tiles.rows), 0),
              top = std::min(tileAt(side.high.y, tiles.rows), tiles.rows - 1);
    for (int row = bottom; row <= top; ++row)
      for (int column = left; column <= right; ++column) marked[tiles.number(column, row)] = true;
  }
  return marked;
}

// Of a tile without the outline, but perhaps with the horizon.
BackdropShows shownIn(const SeenGround& ground, int column, int row) {
  const float left = static_cast<float>(column * TILE) - OUTLINE_MARGIN,
              bottom = static_cast<float>(row * TILE) - OUTLINE_MARGIN, side = TILE + 2 * OUTLINE_MARGIN;
  int corners = 0;
  for (const float x : {left, left + side})
    for (const float y : {bottom, bottom + side}) corners += ground.isAt({x, y}) ? 1 : 0;
  return corners == 4 ? BackdropShows::ground : corners == 0 ? BackdropShows::beyond : BackdropShows::both;
}

}  // namespace

std::vector<BackdropPart> backdropParts(const shared::RenderFrame& frame, GroundShape shape) {
  const SeenGround ground(frame, shape);
  const auto width = static_cast<int>(frame.pixels.x), height = static_cast<int>(frame.pixels.y);
  if (!ground.isKnown()) return {{{0, 0, width, height}, BackdropShows::both}};
  const Tiles tiles{(width + TILE - 1) / TILE, (height + TILE - 1) / TILE};
  const std::vector<bool> onOutline = tilesOnOutline(ground, shape, tiles);
  std::vector<BackdropPart> parts;
  for (int row = 0; row < tiles.rows; ++row)
    for (int column = 0; column < tiles.columns; ++column) {
      const BackdropShows shown =
          onOutline[tiles.number(column, row)] ? BackdropShows::both : shownIn(ground, column, row);
      const int right = std::min((column + 1) * TILE, width);
      if (column > 0 && parts.back().shows == shown)
        parts.back().pixels.right = right;
      else
        parts.push_back({{column * TILE, row * TILE, right, std::min((row + 1) * TILE, height)}, shown});
    }
  // One program after the other.
  std::stable_sort(parts.begin(), parts.end(),
                   [](const BackdropPart& a, const BackdropPart& b) { return a.shows < b.shows; });
  return parts;
}

}  // namespace clothsim

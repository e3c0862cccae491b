#include "render/stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "render/look.h"
#include "render/pinned_cloth.h"
#include "scene/colliders/collider_set.h"

namespace clothsim {
namespace {

constexpr std::size_t samplesAlong = 64;  // points of a grid looked at along each of its sides
constexpr int coarseAlong = 8;            // and where it is looked at many times over

using PieceSamples = ClothOutline::GridPoints;

// Border, pins and a raster of a grid.
PieceSamples samplePiece(const Cloth& cloth, const Piece& piece) {
  PieceSamples samples;
  // A mesh has one row of all its particles.
  const int most = static_cast<int>(piece.isMesh ? samplesAlong * samplesAlong : samplesAlong);
  const int few = piece.isMesh ? coarseAlong * coarseAlong : coarseAlong;
  const auto step = [](int count, int steps) { return std::max(1, count / steps); };
  const auto isOn = [&](int index, int count, int steps) {
    return index % step(count, steps) == 0 || index == count - 1;
  };
  for (int row = 0; row < piece.rows; ++row) {
    for (int column = 0; column < piece.columns; ++column) {
      const std::uint32_t particle =
          piece.firstParticle + static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(piece.columns) +
          static_cast<std::uint32_t>(column);
      const glm::vec3 place = toGlm(cloth.positions()[particle]);
      const bool isLast = (row == piece.rows - 1 && !piece.isMesh) || column == piece.columns - 1;
      if (isLast || (row % step(piece.rows, most) == 0 && column % step(piece.columns, most) == 0))
        samples.points.push_back(place);
      if (isOn(row, piece.rows, few) && isOn(column, piece.columns, few)) samples.coarse.push_back(place);
      if (cloth.inverseMasses()[particle] == 0)
        samples.pins.push_back({place, particle - piece.firstParticle});
    }
  }
  // A pinned side of a large grid would make the search below quadratic.
  if (samples.pins.size() > 2 * samplesAlong) {
    std::vector<ClothOutline::Pin> fewer;
    for (std::size_t i = 0; i < samples.pins.size(); i += samples.pins.size() / samplesAlong)
      fewer.push_back(samples.pins[i]);
    fewer.push_back(samples.pins.back());
    samples.pins = fewer;
  }
  return samples;
}

void addCorners(const Bounds& box, Stage& stage) {
  for (int corner = 0; corner < 8; ++corner) {
    stage.staying.emplace_back((corner & 1) != 0 ? box.high.x : box.low.x,
                               (corner & 2) != 0 ? box.high.y : box.low.y,
                               (corner & 4) != 0 ? box.high.z : box.low.z);
  }
}

// The solids that cloth falls onto, or hangs around from the start.
struct Support {
  Bounds solids;                                     // empty without any
  float lowest = std::numeric_limits<float>::max();  // to which cloth hangs down around them [m]
  bool isUnder = true;                               // all of them begin below the cloth
};

Support supportOf(const Bounds& cloth, const ColliderSet& colliders) {
  const float halfDiagonal = 0.5f * glm::length(cloth.size());
  Support support;
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const Pose pose = poseAt(colliders[i], 0);
    const glm::vec3 place = toGlm(pose.position), half = toGlm(colliders.halfExtent(i, pose.rotation));
    const glm::vec3 low = place - half, high = place + half;
    const bool isBeside = low.x > cloth.high.x || high.x < cloth.low.x || low.z > cloth.high.z ||
                          high.z < cloth.low.z || low.y > cloth.high.y;
    if (half == glm::vec3(0) || isBeside) continue;
    support.solids.add(low);
    support.solids.add(high);
    support.isUnder = support.isUnder && place.y < cloth.low.y;
    // Over the top, a quarter of the way around, and straight down from there.
    const float overhang = std::max(0.0f, halfDiagonal - 1.5708f * 0.5f * (half.x + half.z));
    support.lowest = std::min(support.lowest, place.y - overhang);
  }
  return support;
}

// The highest plane under the middle of the cloth.
std::optional<float> floorUnder(const Bounds& cloth, const ColliderSet& colliders) {
  std::optional<float> floor;
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const auto* plane = std::get_if<Plane>(&colliders[i]);
    if (plane == nullptr) continue;
    const glm::vec3 normal = glm::normalize(toGlm(plane->normal));
    if (normal.y < 0.3f) continue;
    const glm::vec3 point = toGlm(poseAt(colliders[i], 0).position);
    const glm::vec3 middle = cloth.center();
    const float height =
        point.y - (normal.x * (middle.x - point.x) + normal.z * (middle.z - point.z)) / normal.y;
    if (height < cloth.high.y) floor = std::max(floor.value_or(height), height);
  }
  return floor;
}

// Free cloth stays on solids that its middle is above, and where there is no floor also around those that it
// begins around. Otherwise it falls to the floor, or on and on.
void addFalling(const Bounds& cloth, const ColliderSet& colliders, Stage& stage) {
  const float halfDiagonal = 0.5f * glm::length(cloth.size());
  const std::optional<float> floor = floorUnder(cloth, colliders);
  const Support support = supportOf(cloth, colliders);
  const glm::vec3 middle = cloth.center();
  const bool isOver = middle.x >= support.solids.low.x && middle.x <= support.solids.high.x &&
                      middle.z >= support.solids.low.z && middle.z <= support.solids.high.z;
  const bool onSolid = isOver && (support.isUnder || !floor);
  float rest = floor.value_or(cloth.low.y - 2 * halfDiagonal);
  if (onSolid) rest = floor ? std::max(*floor, support.lowest) : support.lowest;
  const glm::vec3 low{cloth.low.x, rest, cloth.low.z}, high{cloth.high.x, rest, cloth.high.z};
  const float folded = onSolid ? 0.15f : 0.0f;  // hanging in folds it is narrower
  glm::vec3 inward = folded * glm::vec3(high.x - low.x, 0, high.z - low.z);
  // What stands may fall over to either side.
  const float tipped = 0.35f * cloth.size().y;
  inward = glm::min(inward, 0.5f * cloth.size() - glm::vec3(tipped, 0, tipped));
  addCorners({low + inward, high - inward}, stage);
  stage.reach.add(low - glm::vec3(halfDiagonal, 0, halfDiagonal));
  stage.reach.add(high + glm::vec3(halfDiagonal, 0, halfDiagonal));
}

// Where cloth that is free at the start is taken later.
void addHands(const ClothSettings& settings, Stage& stage) {
  for (const PinMotion& motion : settings.pinMotion)
    for (const PinMotion::Key& key : motion.keys)
      if (key.position) stage.passing.push_back(toGlm(*key.position));
}

// Most of the shadow that what stays throws on the floor: its far end may be cut off.
void addShadow(glm::vec3 toLight, Stage& stage) {
  constexpr float lowest = 0.25f;  // a light nearer to the horizon throws shadows out of any picture
  if (toLight.y < lowest) return;
  const glm::vec3 middle = stage.view.center();
  for (const glm::vec3 point : stage.staying) {
    const glm::vec3 onFloor = point - (point.y - stage.floorHeight) / toLight.y * toLight;
    stage.passing.push_back(glm::mix(middle, onFloor, 0.8f));
  }
}

// Horizontal direction that a viewer of the cloth's front stands in. Cloth that lies flat shows its front
// once it hangs from its first row, which is then to +z.
glm::vec3 frontOf(const Cloth& cloth) {
  const Piece& piece = cloth.pieces().front();
  if (piece.isMesh) return {0, 0, 1};  // garments face that way
  const std::uint32_t lastColumn = piece.firstParticle + static_cast<std::uint32_t>(piece.columns - 1);
  const std::uint32_t lastRow = piece.firstParticle + static_cast<std::uint32_t>(piece.columns) *
                                                          static_cast<std::uint32_t>(piece.rows - 1);
  const glm::vec3 corner = toGlm(cloth.positions()[piece.firstParticle]);
  const glm::vec3 along = toGlm(cloth.positions()[lastColumn]) - corner;
  const glm::vec3 down = toGlm(cloth.positions()[lastRow]) - corner;
  const glm::vec3 normal = (piece.rowsGoUp ? -1.0f : 1.0f) * glm::cross(down, along);
  const glm::vec3 horizontal{normal.x, 0, normal.z};
  if (glm::length(horizontal) <= 0.5f * glm::length(normal)) return {0, 0, 1};
  return glm::normalize(horizontal);
}

}  // namespace

void Bounds::add(glm::vec3 point) {
  low = glm::min(low, point);
  high = glm::max(high, point);
}

void Bounds::add(const Bounds& other) {
  low = glm::min(low, other.low);
  high = glm::max(high, other.high);
}

ClothOutline outlineOf(const Cloth& cloth) {
  ClothOutline outline;
  for (const Piece& piece : cloth.pieces()) outline.pieces.push_back(samplePiece(cloth, piece));
  outline.front = frontOf(cloth);
  return outline;
}

Stage makeStage(const ClothOutline& cloth, const Scene& scene) {
  const ColliderSet colliders(scene);
  Stage stage;
  for (std::size_t i = 0; i < cloth.pieces.size(); ++i) {
    const PieceSamples& piece = cloth.pieces[i];
    Bounds rest;
    for (const glm::vec3 point : piece.points) rest.add(point);
    stage.passing.insert(stage.passing.end(), piece.points.begin(), piece.points.end());
    if (piece.pins.empty()) {
      addFalling(rest, colliders, stage);
      addHands(scene.cloths[i], stage);
    } else {
      addPinnedCloth(piece, scene.cloths[i], scene, rest, stage);
    }
  }
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const Collider& collider = colliders[i];
    const auto addAt = [&](Vec3d position, const Matrix3& rotation) {
      const glm::vec3 place = toGlm(position), half = toGlm(colliders.halfExtent(i, rotation));
      if (half != glm::vec3(0)) addCorners({place - half, place + half}, stage);
    };
    const Pose pose = poseAt(collider, 0);
    addAt(pose.position, pose.rotation);
    const auto& motion = std::visit(
        [](const auto& shape) -> const auto& { return shape.motion; }, collider);
    if (!motion) continue;
    for (const double time : timesAlong(*motion)) {
      const Pose then = poseAt(*motion, time);
      addAt(then.position, then.rotation);
    }
  }
  for (const glm::vec3 point : stage.staying) stage.view.add(point);
  stage.floorHeight = stage.view.low.y - 0.02f * glm::length(stage.view.size());
  for (const glm::vec3 point : stage.passing) stage.view.add(point);
  stage.reach.add(stage.view);
  addShadow(directionToKeyLight(scene.render, cloth.front), stage);
  return stage;
}

}  // namespace clothsim

#include "session/moved_pins.h"

#include <algorithm>
#include <numeric>

#include "cloth/pins.h"
#include "scene/rotation_vector.h"

namespace clothsim {
namespace {

constexpr double LET_GO = 1e6;  // of the free key [s]

bool isOfHands(const PinMotion& motion) {
  return motion.pinned.size() == 1 && motion.collider == NO_BODY && !motion.loop && !motion.release &&
         motion.keys.size() == 2 && !motion.keys[0].free && motion.keys[1].free && motion.keys[1].t == LET_GO;
}

const PinMotion* handOf(const ClothSettings& settings, const Pin& pin) {
  const auto found = std::ranges::find_if(settings.pinMotion, [&](const PinMotion& motion) {
    return isOfHands(motion) && motion.pinned[0] == pin;
  });
  return found == settings.pinMotion.end() ? nullptr : &*found;
}

// The particles that a pin holds, counted from the cloth's first one.
std::vector<std::uint32_t> particlesOf(const Pin& pin, const ClothSettings& settings) {
  std::vector<std::uint32_t> particles;
  if (settings.isMesh()) {
    ClothSettings one = settings;
    one.pinned = {pin};
    const std::vector<bool> held = pinnedParticles(one);
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i]) particles.push_back(static_cast<std::uint32_t>(i));
    return particles;
  }
  const GridRange range = pointsOf(pin, settings);
  for (int row = range.from.row; row <= range.to.row; ++row)
    for (int column = range.from.column; column <= range.to.column; ++column)
      particles.push_back(static_cast<std::uint32_t>(row * settings.numWidthPoints + column));
  return particles;
}

Vec3d startOf(const Pin& pin, const Scene& scene, const Cloth& cloth, std::size_t number) {
  const std::vector<std::uint32_t> particles = particlesOf(pin, scene.cloths[number]);
  const std::uint32_t first = cloth.pieces()[number].firstParticle;
  Vec3d sum;
  for (const std::uint32_t i : particles) sum = sum + cloth.positions()[first + i];
  return (1.0 / static_cast<double>(particles.size())) * sum;
}

// Whether a path of the scene, which is not one of hands, moves any of these particles.
bool isOnAPath(const std::vector<std::uint32_t>& particles, const ClothSettings& settings) {
  if (std::ranges::all_of(settings.pinMotion, isOfHands)) return false;
  const std::vector<int> motions = pinMotionOfPoints(settings);
  return std::ranges::any_of(particles, [&](std::uint32_t i) {
    return motions[i] != NO_MOTION && !isOfHands(settings.pinMotion[static_cast<std::size_t>(motions[i])]);
  });
}

}  // namespace

std::optional<PinGroup> pinGroupOf(const Scene& scene, const Cloth& cloth, std::uint32_t particle) {
  const std::size_t number = cloth.pieceOf(particle);
  const ClothSettings& settings = scene.cloths[number];
  const std::uint32_t place = particle - cloth.pieces()[number].firstParticle;
  if (isOnAPath({place}, settings)) return std::nullopt;
  for (const Pin& pin : settings.pinned) {
    const std::vector<std::uint32_t> particles = particlesOf(pin, settings);
    if (std::ranges::find(particles, place) == particles.end()) continue;
    if (isOnAPath(particles, settings)) return std::nullopt;
    return PinGroup{number, {pin}};
  }
  if (settings.isMesh()) return PinGroup{number, {vertexPinOf(settings, place)}};
  const int index = static_cast<int>(place);
  return PinGroup{number, {GridPoint{index % settings.numWidthPoints, index / settings.numWidthPoints}}};
}

PinGroup wholePinGroup(const Scene& scene, std::size_t ofCloth) {
  const ClothSettings& settings = scene.cloths[ofCloth];
  PinGroup group{ofCloth, {}};
  for (const Pin& pin : settings.pinned)
    if (!isOnAPath(particlesOf(pin, settings), settings)) group.pins.push_back(pin);
  return group;
}

std::vector<Vec3d> placesOf(const PinGroup& group, const Scene& scene, const Cloth& cloth) {
  std::vector<Vec3d> places;
  for (const Pin& pin : group.pins) {
    const PinMotion* hand = handOf(scene.cloths[group.cloth], pin);
    const Vec3d start = startOf(pin, scene, cloth, group.cloth);
    places.push_back(hand != nullptr ? hand->keys[0].position.value_or(start) : start);
  }
  return places;
}

bool isHeldByHands(const PinGroup& group, const Scene& scene) {
  return std::ranges::all_of(
      group.pins, [&](const Pin& pin) { return handOf(scene.cloths[group.cloth], pin) != nullptr; });
}

Scene withPinsHeld(Scene scene, const PinGroup& group, const Cloth& cloth,
                   const std::function<Vec3d(std::uint32_t particle)>& positionOf) {
  ClothSettings& settings = scene.cloths[group.cloth];
  for (const Pin& pin : group.pins) {
    if (handOf(settings, pin) != nullptr) continue;
    PinMotion::Key key;
    if (std::ranges::find(settings.pinned, pin) ==
        settings.pinned.end()) {  // pinned by hand, wherever it was
      settings.pinned.push_back(pin);
      key.position =
          positionOf(cloth.pieces()[group.cloth].firstParticle + particlesOf(pin, settings).front());
    }
    PinMotion::Key last = key;
    last.t = LET_GO;
    last.free = true;
    settings.pinMotion.push_back({.keys = {key, last}, .pinned = {pin}});
  }
  return scene;
}

Scene withPinsMoved(Scene scene, const PinGroup& group, const Cloth& cloth, Vec3d pivot, const Matrix3& turn,
                    Vec3d way) {
  const std::vector<Vec3d> places = placesOf(group, scene, cloth);
  for (std::size_t i = 0; i < group.pins.size(); ++i) {
    const auto hand = std::ranges::find_if(scene.cloths[group.cloth].pinMotion, [&](const PinMotion& motion) {
      return isOfHands(motion) && motion.pinned[0] == group.pins[i];
    });
    if (hand == scene.cloths[group.cloth].pinMotion.end()) continue;
    const Vec3d position = pivot + rotate(turn, places[i] - pivot) + way;
    const Vec3d rotation = rotationVector(product(turn, rotationMatrix(hand->keys[0].rotation)));
    for (PinMotion::Key& key : hand->keys) {
      key.position = position;
      key.rotation = rotation;
    }
  }
  return scene;
}

Shared<Scene> withHandsOf(const Scene& other, const Shared<Scene>& scene) {
  Scene result = *scene;
  for (std::size_t i = 0; i < std::min(other.cloths.size(), result.cloths.size()); ++i) {
    const ClothSettings& from = other.cloths[i];
    ClothSettings& to = result.cloths[i];
    if (from.mesh != to.mesh || from.numWidthPoints != to.numWidthPoints ||
        from.numHeightPoints != to.numHeightPoints)
      continue;
    for (const PinMotion& motion : from.pinMotion) {
      if (!isOfHands(motion)) continue;
      const Pin& pin = motion.pinned[0];
      if (handOf(to, pin) != nullptr || isOnAPath(particlesOf(pin, to), to)) continue;
      if (std::ranges::find(to.pinned, pin) == to.pinned.end()) to.pinned.push_back(pin);
      to.pinMotion.push_back(motion);
    }
  }
  return result == *scene ? scene : Shared<Scene>(std::move(result));
}

}  // namespace clothsim

#include "session/action_checks.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "core/error.h"

namespace clothsim {
namespace {

constexpr double FARTHEST = 1e6;  // [m], [m/s]: beyond it binary32 cannot resolve a cloth

std::string text(double number) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%g", number);
  return digits;
}

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

// False for NaN.
bool isWithin(double x, double low, double high) { return low <= x && x <= high; }

void checkPlace(const char* what, Vec3d place) {
  for (const double x : {place.x, place.y, place.z})
    require(isWithin(x, -FARTHEST, FARTHEST),
            std::string(what) + ": expected coordinates from -1e6 to 1e6, found " + text(x));
}

void checkParticle(const char* what, std::uint32_t particle, const Cloth& cloth) {
  require(particle < cloth.particleCount(), std::string(what) + ": there is no particle " +
                                                std::to_string(particle) + ", expected 0 to " +
                                                std::to_string(cloth.particleCount() - 1));
}

class Checks {
 public:
  Checks(const Cloth& cloth, const Scene& scene) : cloth_(cloth), scene_(scene) {}

  void operator()(const EditScene&) const {}  // a Scene has been checked by its reader
  void operator()(const Release&) const {}
  void operator()(const Restart&) const {}
  void operator()(const SwitchBackend&) const {}  // the solver factory checks the name
  void operator()(const MoveHand& move) const { checkPlace("move_hand: target", move.target); }
  void operator()(const SetPin& pin) const { checkParticle("set_pin", pin.particle, cloth_); }
  void operator()(const Grab& grab) const {
    checkParticle("grab", grab.particle, cloth_);
    checkPlace("grab: target", grab.target);
    require(grab.strength > 0 && std::isfinite(grab.strength),
            "grab: strength: expected a number > 0, found " + text(grab.strength));
    require(isWithin(grab.radius, 0, FARTHEST),
            "grab: radius: expected 0 to 1e6, found " + text(grab.radius));
  }
  void operator()(const CutStroke& stroke) const {
    const std::size_t pieces = cloth_.pieces().size();
    require(stroke.piece < pieces, "cut: there is no cloth " + std::to_string(stroke.piece) +
                                       ", expected 0 to " + std::to_string(pieces - 1));
    require(!cloth_.pieces()[stroke.piece].isMesh, "cut: cloth " + std::to_string(stroke.piece) +
                                                       " is a mesh, expected a grid: meshes cannot be cut");
    for (const LatticePoint& point : {stroke.from, stroke.to})
      for (const double x : {point.column, point.row})
        require(isWithin(x, -FARTHEST, FARTHEST),
                "cut: expected columns and rows from -1e6 to 1e6, found " + text(x));
  }
  void operator()(const Blow& blow) const {
    checkPlace("blow: origin", blow.origin);
    checkPlace("blow: direction", blow.direction);
    require(isWithin(blow.speed, 0, 1000), "blow: speed: expected 0 to 1000, found " + text(blow.speed));
    if (blow.speed == 0) return;
    require(blow.direction != Vec3d{}, "blow: direction: expected any length but 0");
    require(isWithin(blow.radius, 1e-6, FARTHEST),
            "blow: radius: expected 1e-6 to 1e6, found " + text(blow.radius));
  }
  void operator()(const MoveCollider& move) const {
    checkCollider("move_collider", move.collider);
    checkPlace("move_collider: position", move.position);
  }
  void operator()(const TurnCollider& turn) const {
    checkCollider("turn_collider", turn.collider);
    const double angle = length(turn.turn);
    require(isWithin(angle, 0, 180 + 1e-9),
            "turn_collider: turn: expected 0 to 180 degrees, found " + text(angle));
  }

 private:
  void checkCollider(const char* what, std::size_t collider) const {
    const std::size_t colliders = scene_.colliders.size();
    require(collider < colliders, std::string(what) + ": there is no collider " + std::to_string(collider) +
                                      ", the scene has " + std::to_string(colliders));
  }

  const Cloth& cloth_;
  const Scene& scene_;
};

}  // namespace

void checkAction(const Action& action, const Cloth& cloth, const Scene& scene) {
  std::visit(Checks(cloth, scene), action);
}

}  // namespace clothsim

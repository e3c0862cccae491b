#include "render/pinned_cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cloth/pins.h"
#include "scene/pose.h"

namespace clothsim {
namespace {

constexpr double slack = 0.08;      // how far cloth hangs beyond its own length, at least, as l/L - 1
constexpr double mostStrain = 0.5;  // that is expected of a cloth without a limit
constexpr float swingKept = 0.85f;  // by cloth, which bends, of the angle to which a stiff sheet would swing
constexpr double turnAtOnce = 30;   // between two looks at a path [degrees]
constexpr int mostTurns = 24;       // looks between two keys
constexpr std::size_t mostTimes = 96;

constexpr float quarterTurn = 0.5f * std::numbers::pi_v<float>;

struct MovedPin {
  glm::vec3 place;
  Matrix3 turn = Pose{}.rotation;  // of its path
};

// The paths of a cloth's pins, and which pin follows which.
class Paths {
 public:
  Paths(const std::vector<ClothOutline::Pin>& pins, const ClothSettings& settings) : pins_(pins) {
    const std::size_t count = settings.pinMotion.size();
    if (count == 0) return;
    const std::vector<int> motions = pinMotionOfPoints(settings);
    centers_.resize(count);
    std::vector<double> counts(count);
    for (const ClothOutline::Pin& pin : pins) {
      pathOf_.push_back(pin.point < motions.size() ? motions[pin.point] : NO_MOTION);
      if (pathOf_.back() == NO_MOTION) continue;
      const auto path = static_cast<std::size_t>(pathOf_.back());
      centers_[path] = centers_[path] + Vec3d{pin.place.x, pin.place.y, pin.place.z};
      ++counts[path];
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (counts[i] > 0) centers_[i] = (1 / counts[i]) * centers_[i];
      motions_.push_back(pathAbout(settings.pinMotion[i], centers_[i]));
    }
  }

  [[nodiscard]] std::vector<double> times() const {
    std::vector<double> all;
    for (const Motion& motion : motions_) {
      const std::vector<double> times = timesAlong(motion);
      all.insert(all.end(), times.begin(), times.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::vector<double> some;
    const std::size_t step = all.size() / mostTimes + 1;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i % step == 0 || i + 1 == all.size()) some.push_back(all[i]);
    return some;
  }

  [[nodiscard]] std::vector<MovedPin> pinsAt(double time) const {
    std::vector<Pose> poses;
    for (const Motion& motion : motions_) poses.push_back(poseAt(motion, time));
    std::vector<MovedPin> moved;
    for (std::size_t i = 0; i < pins_.size(); ++i) {
      moved.push_back({pins_[i].place});
      if (motions_.empty() || pathOf_[i] == NO_MOTION) continue;
      const auto path = static_cast<std::size_t>(pathOf_[i]);
      const Vec3d place{pins_[i].place.x, pins_[i].place.y, pins_[i].place.z};
      moved.back().turn = poses[path].rotation;
      moved.back().place = toGlm(poses[path].position + rotate(poses[path].rotation, place - centers_[path]));
    }
    return moved;
  }

 private:
  const std::vector<ClothOutline::Pin>& pins_;
  std::vector<int> pathOf_;  // of each pin
  std::vector<Vec3d> centers_;
  std::vector<Motion> motions_;
};

std::vector<std::size_t> nearestPins(const std::vector<glm::vec3>& points,
                                     const std::vector<ClothOutline::Pin>& pins) {
  std::vector<std::size_t> nearest(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 1; k < pins.size(); ++k)
      if (glm::distance(pins[k].place, points[i]) < glm::distance(pins[nearest[i]].place, points[i]))
        nearest[i] = k;
  return nearest;
}

// A point of the cloth as the end of a pendulum.
struct Pendulum {
  glm::vec3 top;
  float length;
  float angle = 0;     // from straight down at the start [rad]
  glm::vec3 aside{0};  // horizontal unit vector to which it begins; zero: it hangs
  [[nodiscard]] glm::vec3 at(float angleNow, glm::vec3 down, glm::vec3 direction) const {
    return top + length * (std::cos(angleNow) * down + std::sin(angleNow) * direction);
  }
};

class HangingCloth {
 public:
  HangingCloth(const ClothOutline::GridPoints& piece, const ClothSettings& settings, const Scene& scene,
               const Bounds& rest)
      : piece_(piece), settings_(settings), scene_(scene), restSize_(rest.size()) {
    gravity_ = glm::length(toGlm(scene.gravity));
    down_ = gravity_ > 0 ? toGlm(scene.gravity) / gravity_ : glm::vec3(0);
    for (const ClothOutline::Pin& pin : piece.pins) pinsAtRest_.add(pin.place);
    stretch_ = static_cast<float>(1 + expectedStrain());
  }

  // Each point stays within reach of its pin. Along the axes on which pins hold the sheet apart it stays
  // where it is, or follows the pins to each other; along the others it swings.
  void lookAt(const std::vector<MovedPin>& pins) {
    Bounds now;
    for (const MovedPin& pin : pins) now.add(pin.place);
    const glm::vec3 before = pinsAtRest_.size(), size = now.size();
    for (int axis = 0; axis < 3; ++axis) {
      pinnedAxes_[axis] =
          size[axis] > 0.5f * restSize_[axis] || before[axis] > 0.5f * restSize_[axis] ? 1.0f : 0.0f;
      closer_[axis] = before[axis] > 1e-6f ? std::min(1.0f, size[axis] / before[axis]) : 1.0f;
    }
  }

  [[nodiscard]] Pendulum pendulum(glm::vec3 point, std::size_t nearest,
                                  const std::vector<MovedPin>& pins) const {
    const MovedPin& pin = pins[nearest];
    const glm::vec3 apart = point - piece_.pins[nearest].place;
    const glm::vec3 offset = toGlm(rotate(pin.turn, {apart.x, apart.y, apart.z}));
    const glm::vec3 across = offset - glm::dot(offset, down_) * down_;
    const glm::vec3 fromTop = pinnedAxes_ * closer_ * across;
    const float reach = stretch_ * glm::length(offset);
    Pendulum p{.top = pin.place + fromTop,
               .length = std::sqrt(std::max(0.0f, reach * reach - glm::dot(fromTop, fromTop)))};
    // No pin lets it hang farther away than the cloth between them is long.
    for (std::size_t k = 0; k < pins.size(); ++k) {
      const glm::vec3 toTop = p.top - pins[k].place;
      const float below = glm::dot(toTop, down_), beside2 = glm::dot(toTop, toTop) - below * below;
      const float length = stretch_ * glm::distance(point, piece_.pins[k].place);
      if (length * length > beside2)
        p.length = std::clamp(std::sqrt(length * length - beside2) - below, 0.0f, p.length);
    }
    const glm::vec3 aside = across - pinnedAxes_ * across;
    if (glm::length(aside) > 1e-3f * reach) {
      p.aside = glm::normalize(aside);
      p.angle = std::atan2(glm::length(aside), glm::dot(offset, down_));
    }
    return p;
  }

  // What is left of an angle when it has swung to the other side.
  [[nodiscard]] float swungBy(float angle, float length) const {
    // CS184's is percent a step; implicit steps take its 2700 steps a second.
    const double stepRate = isImplicit(scene_.solver.integrator) ? 2700 : 1 / stepLength(scene_.solver);
    const double rate = settings_.material ? settings_.material->damping : settings_.damping / 100 * stepRate;
    const double half = std::numbers::pi * std::sqrt(2.0 * length / (3 * std::max(1e-6f, gravity_)));
    return swingKept * angle * static_cast<float>(std::exp(-0.5 * rate * half));
  }

  // To where the wind lifts cloth that hangs [rad].
  [[nodiscard]] float windAngle() const {
    if (!scene_.wind) return 0;
    const Wind& wind = *scene_.wind;
    const double speed = std::sqrt(dot(wind.velocity, wind.velocity)) + 2 * std::abs(wind.gust.strength);
    const double area = settings_.width * settings_.height;
    const double density = settings_.material ? settings_.material->density
                           : settings_.mass   ? *settings_.mass / area
                                              : settings_.density;
    const double push = 0.5 * wind.airDensity * wind.drag * speed * speed;
    return static_cast<float>(std::atan2(push, density * std::max(1e-6, double{gravity_})));
  }
  [[nodiscard]] glm::vec3 downwind() const {
    if (!scene_.wind) return glm::vec3(0);
    const glm::vec3 velocity = toGlm(scene_.wind->velocity);
    const glm::vec3 across = velocity - glm::dot(velocity, down_) * down_;
    return glm::length(across) > 0 ? glm::normalize(across) : glm::vec3(0);
  }
  [[nodiscard]] glm::vec3 down() const { return down_; }
  [[nodiscard]] float gravity() const { return gravity_; }

  // Whether pins hold it all the way down, as a flag at a pole, which does not swing to the other side.
  [[nodiscard]] bool isAtAPole() const {
    return std::abs(glm::dot(pinsAtRest_.size(), down_)) > 0.5f * std::abs(glm::dot(restSize_, down_)) &&
           glm::dot(restSize_, glm::abs(down_)) > 0.1f * glm::length(restSize_);
  }

 private:
  // Of cloth that has fallen into its pins: twice that at rest, where half its weight hangs at its springs;
  // and twice as much where two corners carry it.
  [[nodiscard]] double expectedStrain() const {
    double strain = slack;
    if (settings_.ks || settings_.stiffnessReference) {
      const double spacing = settings_.width / std::max(1, settings_.numWidthPoints - 1);
      const double ks =
          settings_.ks ? *settings_.ks : *settings_.stiffnessReference * settings_.referenceLength / spacing;
      const double mass = settings_.mass.value_or(settings_.width * settings_.height * settings_.density);
      strain += 2 * 2 * 0.5 * mass * double{gravity_} / (ks * settings_.width);
    }
    return std::min(strain, scene_.solver.strainLimit ? slack / 4 + *scene_.solver.strainLimit : mostStrain);
  }

  const ClothOutline::GridPoints& piece_;
  const ClothSettings& settings_;
  const Scene& scene_;
  glm::vec3 restSize_, down_{0}, pinnedAxes_{0}, closer_{1};
  float gravity_ = 0, stretch_ = 1;
  Bounds pinsAtRest_;
};

// From where it begins through the lowest place to the other side, and where the wind holds it.
void addSwing(const HangingCloth& cloth, const Pendulum& p, Stage& stage) {
  const glm::vec3 down = cloth.down();
  if (p.angle > 0) {
    const float there = cloth.swungBy(std::min(p.angle, 2 * quarterTurn - 0.3f), p.length);
    for (const float part : {0.75f, 0.5f, 0.25f})
      stage.passing.push_back(p.at(part * p.angle, down, p.aside));
    if (!cloth.isAtAPole())
      for (const float part : {0.5f, 1.0f}) stage.passing.push_back(p.at(part * there, down, -p.aside));
  }
  if (const float lifted = cloth.windAngle(); lifted > 0)
    for (const float part : {0.5f, 1.0f})
      stage.passing.push_back(p.at(part * lifted, down, cloth.downwind()));
}

}  // namespace

std::vector<double> timesAlong(const Motion& motion) {
  std::vector<double> times;
  for (std::size_t i = 0; i < motion.keys.size(); ++i) {
    times.push_back(motion.keys[i].t);
    if (i + 1 == motion.keys.size()) break;
    const Vec3d turn = motion.keys[i + 1].rotation - motion.keys[i].rotation;
    const double turns = std::min<double>(mostTurns, std::sqrt(dot(turn, turn)) / turnAtOnce);
    for (int part = 1; part < turns; ++part)
      times.push_back(motion.keys[i].t + part / std::ceil(turns) * (motion.keys[i + 1].t - motion.keys[i].t));
  }
  return times;
}

void addPinnedCloth(const ClothOutline::GridPoints& piece, const ClothSettings& settings, const Scene& scene,
                    const Bounds& rest, Stage& stage) {
  const Paths paths(piece.pins, settings);
  HangingCloth cloth(piece, settings, scene, rest);
  const glm::vec3 down = cloth.down();
  const std::vector<double> times = paths.times();
  const auto addAt = [&](const std::vector<MovedPin>& pins, const std::vector<glm::vec3>& points,
                         const std::vector<std::size_t>& nearest, bool swings) {
    cloth.lookAt(pins);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const MovedPin& pin = pins[nearest[i]];
      const Pendulum p = cloth.pendulum(points[i], nearest[i], pins);
      stage.staying.push_back(p.at(0, down, {}));
      if (swings) addSwing(cloth, p, stage);
      stage.reach.add(pin.place - glm::vec3(p.length));
      stage.reach.add(pin.place + glm::vec3(p.length, 0.3f * p.length, p.length));
    }
  };
  const std::vector<MovedPin> first = paths.pinsAt(0);
  addAt(first, piece.points, nearestPins(piece.points, piece.pins), false);
  const std::vector<std::size_t> nearest = nearestPins(piece.coarse, piece.pins);
  addAt(first, piece.coarse, nearest, true);
  for (const double time : times) {
    const std::vector<MovedPin> pins = paths.pinsAt(time);
    for (const MovedPin& pin : pins) stage.staying.push_back(pin.place);
    addAt(pins, piece.coarse, nearest, true);
  }
}

}  // namespace clothsim

#include "python/collider_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clothsim {
namespace {

constexpr double ROUNDING = 1e-6;  // of times, as part of a step

}  // namespace

Scene ColliderWays::sent(Scene scene, const ColliderMove& move, double from, double until) {
  const auto isOfIt = [&](const Way& way) { return way.move.collider == move.collider; };
  Way way{move, scene.colliders[move.collider], from, until};
  // What is moved and turned at once does both on one way.
  const auto found = std::ranges::find_if(ways_, isOfIt);
  if (found != ways_.end() && found->from == from && found->until == until) {
    way.before = found->before;
    if (!way.move.position) way.move.position = found->move.position;
    if (found->move.turn) way.move.turn = product(way.move.turn.value_or(identityMatrix), *found->move.turn);
    scene.colliders[move.collider] = way.before;
  }
  std::erase_if(ways_, isOfIt);
  ways_.push_back(way);
  return withColliderOnItsWay(std::move(scene), way.move, from, until);
}

std::optional<Scene> ColliderWays::arrived(const Scene& scene, double now, double stepLength) {
  std::optional<Scene> arrived;
  std::erase_if(ways_, [&](const Way& way) {
    if (way.until > now + ROUNDING * stepLength) return false;
    const std::size_t place = way.move.collider;
    if (place >= scene.colliders.size()) return true;
    Scene rest = arrived.value_or(scene);
    Scene before = rest;
    before.colliders[place] = way.before;
    // Where there is more to it than the way, it stays where that has left it.
    const bool isAsSent = withColliderOnItsWay(before, way.move, way.from, way.until).colliders[place] ==
                          scene.colliders[place];
    arrived = isAsSent && !moves(way.before) ? withColliderMoved(std::move(before), way.move, way.until)
                                             : withColliderAtRest(std::move(rest), place, way.until);
    return true;
  });
  return arrived;
}

std::int64_t ColliderWays::stepsLeft(double now, double stepLength) const {
  auto least = static_cast<double>(std::numeric_limits<std::int32_t>::max());
  for (const Way& way : ways_) least = std::min(least, std::ceil((way.until - now) / stepLength - ROUNDING));
  return std::max(std::int64_t{1}, static_cast<std::int64_t>(least));
}

}  // namespace clothsim

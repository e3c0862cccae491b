// Colliders that Python has sent on their way. Each begins and ends as a move in the viewer's session does
// (session/session.h), so that a move within a frame gives the bits of its recording.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/moved_collider.h"
#include "scene/scene.h"

namespace clothsim {

class ColliderWays {
 public:
  // The scene in which the collider goes from where it is at time `from` [s] until `until`. It leaves any
  // path.
  [[nodiscard]] Scene sent(Scene scene, const ColliderMove& move, double from, double until);
  // The scene in which those that have arrived at time `now` [s] rest; none where nobody has.
  [[nodiscard]] std::optional<Scene> arrived(const Scene& scene, double now, double stepLength);
  // So many steps are left until the next one arrives; more than 0 once arrived() was asked.
  [[nodiscard]] std::int64_t stepsLeft(double now, double stepLength) const;
  void clear() { ways_.clear(); }

 private:
  struct Way {
    ColliderMove move;
    Collider before;     // as it was when it was sent
    double from, until;  // [s]
  };
  std::vector<Way> ways_;  // one a collider at most
};

}  // namespace clothsim

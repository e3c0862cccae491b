// The resistance of still air to each particle, -a |v| v with a = air_resistance, as in CS171.
#pragma once

#include "scene/put.h"

namespace clothsim {

struct AirResistance {
  template <class Scene>
  [[nodiscard]] static bool acts(const Scene& scene) {
    return scene.airResistance > 0;
  }
  template <class Scene, class Params>
  static void pack(const Scene& scene, Params& params) {
    put(params.airResistance, scene.airResistance);
  }
};

}  // namespace clothsim

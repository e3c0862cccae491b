// Points that pull or push. At distance r < R from an attractor of radius R, a particle is accelerated
// towards it by c S q (1 - q^2)^2, q = r / R, c = 25 sqrt(5) / 16: most, S, at r = R / sqrt(5), and nothing
// at the point itself and from R on. It is the slope of the potential c S R (1 - (1 - q^2)^3) / 6 of a unit
// mass, whose shape is that of the kernel "poly6" (Mueller, Charypar, Gross, "Particle-based fluid simulation
// for interactive applications", 2003): smooth everywhere.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/exact_math.h"
#include "core/vec.h"
#include "scene/put.h"
#include "shared/step_params.h"

namespace clothsim {

template <class Owner>
struct Field;  // scene/field.h

struct Attractor {
  Vec3d position{0, 0, 0};  // [m]
  double strength = 10;     // S, the largest acceleration towards it; negative: away from it [m/s^2]
  double radius = 0.5;      // R [m]
  friend bool operator==(const Attractor&, const Attractor&) = default;
  [[nodiscard]] static std::span<const Field<Attractor>> fields();
};

struct Attractors {
  template <class Scene>
  [[nodiscard]] static bool acts(const Scene& scene) {
    return !scene.attractors.empty();
  }
  template <class Scene, class Params>
  static void pack(const Scene& scene, Params& params) {
    params.attractorCount = static_cast<std::uint32_t>(scene.attractors.size());
    for (std::size_t i = 0; i < scene.attractors.size(); ++i) {
      const Attractor& attractor = scene.attractors[i];
      auto& packed = params.attractors[i];
      put(packed.x, attractor.position.x);
      put(packed.y, attractor.position.y);
      put(packed.z, attractor.position.z);
      put(packed.pull, 25 * std::sqrt(5) / 16 * attractor.strength / attractor.radius);
      put(packed.inverseRadiusSquared, 1 / (attractor.radius * attractor.radius));
      for (auto* number : {&packed.x, &packed.y, &packed.z}) *number = canonical(*number);
    }
  }
};

}  // namespace clothsim

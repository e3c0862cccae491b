#pragma once

#include <optional>
#include <span>

#include "core/vec.h"

namespace clothsim {

template <class Owner>
struct Field;  // scene/field.h

// How a collider is drawn.
struct SolidLook {
  std::optional<Vec3d> color;  // sRGB 0 to 1; none: porcelain, of a plane that of the stage's ground
  double gloss = 0.5;          // 0: matte as plaster, 1: as lacquer
  friend bool operator==(const SolidLook&, const SolidLook&) = default;

  [[nodiscard]] static std::span<const Field<SolidLook>> fields();
};

}  // namespace clothsim

#include "scene/colliders/solid_look.h"

#include <array>

#include "scene/field.h"

namespace clothsim {

std::span<const Field<SolidLook>> SolidLook::fields() {
  constexpr Limits part{.low = 0, .high = 1};
  static const std::array fields{
      field("color", &SolidLook::color, "Colour of this collider.")
          .in("sRGB")
          .within(part)
          .as(Format::color)
          .byDefault("porcelain; of a plane that of the stage's ground"),
      field("gloss", &SolidLook::gloss, "Gloss of this collider: 0 is matte as plaster, 1 is lacquer.")
          .within(part),
  };
  return fields;
}

}  // namespace clothsim

// The entries of the table of scene keys for seams.
#include <array>

#include "scene_io/field_table.h"

namespace clothsim {

template <>
std::span<const Field<SeamSide>> fieldsOf<SeamSide>() {
  static const std::array fields{
      field("cloth", &SeamSide::cloth, "Which of the cloths a side of a seam is of, from 0.")
          .within({.low = 0, .high = 9999})
          .required()
          .rebuilds(),
      field("points", &SeamSide::points,
            "The points that are sewn, as in `pinned`; on a grid a border (`top` of a lying cloth is row 0), "
            "or lines.")
          .required()
          .rebuilds(),
      field("reverse", &SeamSide::reverse, "Sew from the last point of this side to the first.").rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<Seam>> fieldsOf<Seam>() {
  static const std::array fields{
      field("a", &Seam::a, "One side of a seam.").required().rebuilds(),
      field("b", &Seam::b, "The other side; of the same cloth or of another.").required().rebuilds(),
      field("time", &Seam::time, "Time over which the seam closes, from the start on.")
          .in("s")
          .within(notNegative)
          .usually(0, 2),
      field("stiffness", &Seam::stiffness, "Of the spring between two points that are sewn together.")
          .in("N/m")
          .within(positive)
          .usually(1, 10000)
          .byDefault("that of the stiffest spring of both cloths")
          .rebuilds(),
  };
  return fields;
}

}  // namespace clothsim

// The entries of the table of scene keys for pins, their motions, and parts of another stiffness.
#include <array>

#include "scene_io/field_table.h"

namespace clothsim {

template <>
std::span<const Field<GridRange>> fieldsOf<GridRange>() {
  static const std::array fields{
      field("from", &GridRange::from,
            "First [column, row] of a block of points; row 0 is the bottom of a standing cloth.")
          .required()
          .rebuilds(),
      field("to", &GridRange::to, "Last [column, row], inclusive.").required().rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<VertexPin>> fieldsOf<VertexPin>() {
  static const std::array fields{
      field("vertex", &VertexPin::vertex, "Index of a mesh vertex, from 0.")
          .within(notNegative)
          .required()
          .rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<Region>> fieldsOf<Region>() {
  static const std::array fields{
      field("from", &Region::from, "Lowest corner of a box.").in("m").required().rebuilds(),
      field("to", &Region::to, "Highest corner of a box.").in("m").required().rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<RegionPin>> fieldsOf<RegionPin>() {
  static const std::array fields{
      field("region", &RegionPin::region, "A box; all mesh vertices inside it at the start are meant.")
          .required()
          .rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<GroupPin>> fieldsOf<GroupPin>() {
  static const std::array fields{
      field("group", &GroupPin::group, "Name of a group (g) of mesh faces; all its vertices are meant.")
          .required()
          .rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<PaintedPin>> fieldsOf<PaintedPin>() {
  static const std::array fields{
      field("painted", &PaintedPin::painted,
            "Vertices by the colours of the mesh file (v x y z r g b), painted on black: pins hold those "
            "of more than 0.5.")
          .required()
          .rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<StiffnessPart>> fieldsOf<StiffnessPart>() {
  static const std::array fields{
      field(
          "points", &StiffnessPart::points,
          "Vertices of the part, as in `pinned`; of painted ones the colour says how far the factors count.")
          .required()
          .rebuilds(),
      field(
          "stretch", &StiffnessPart::stretch,
          "Factor on what resists stretch and shear: of edges or triangles whose vertices all belong to it.")
          .within({.low = 1e-6, .high = 1e6})
          .usually(0.1, 10)
          .rebuilds(),
      field("bend", &StiffnessPart::bend,
            "Factor on what resists bending: across edges whose ends both belong to it.")
          .within({.low = 0, .high = 1e6})
          .usually(0, 100)
          .rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<PinMotion>> fieldsOf<PinMotion>() {
  static const std::array fields{
      field("keys", &PinMotion::keys, "Keys along the path; another number of them is live if none is free.")
          .byDefault("none: the pins stay, or follow a collider"),
      field("loop", &PinMotion::loop, "Repeat after the last key; otherwise stop there."),
      field("interpolation", &PinMotion::interpolation, "Between keys: linear, or cubic, without kinks."),
      field("collider", &PinMotion::collider,
            "Instead of keys: the collider that the pins move with, from 0.")
          .within({.low = 0, .high = 9999})
          .byDefault("none"),
      field("release", &PinMotion::release, "Time from which on these pins hold nothing.")
          .in("s")
          .within(positive)
          .byDefault("never")
          .rebuilds(),
      field("pinned", &PinMotion::pinned,
            "The pins that follow this path, of those of the cloth; live if no path of the cloth lets go.")
          .byDefault("all pins of the cloth"),
  };
  return fields;
}

template <>
std::span<const Field<PinMotion::Key>> fieldsOf<PinMotion::Key>() {
  using K = PinMotion::Key;
  static const std::array fields{
      field("t", &K::t, "Time of the key, later than the one before.").in("s").within(notNegative).required(),
      field("position", &K::position, "Position of the centre of these pins at that time.")
          .in("m")
          .byDefault("the mean of their start positions"),
      field("rotation", &K::rotation, "Rotation about that centre: axis times angle; may exceed 360.")
          .in("degrees"),
      field("free", &K::free,
            "Let go from here to the next key; a later key takes hold again, as a hand does.")
          .rebuilds(),
  };
  return fields;
}

}  // namespace clothsim

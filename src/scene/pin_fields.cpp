// The part of the table of scene keys that tells of pins and their motions.
#include <array>

#include "scene/field_table.h"

namespace clothsim {

namespace {

constexpr Limits notNegative{.low = 0};

template <class Owner, class T>
Field<Owner> field(std::string_view key, T Owner::*member, std::string_view help) {
  return {key, member, help};
}

}  // namespace

template <>
std::span<const Field<GridRange>> fieldsOf<GridRange>() {
  static const std::array fields{
      field("from", &GridRange::from, "First [column, row] of a block of points.").required().rebuilds(),
      field("to", &GridRange::to, "Last [column, row], pinned too.").required().rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<VertexPin>> fieldsOf<VertexPin>() {
  static const std::array fields{
      field("vertex", &VertexPin::vertex, "Number of a mesh's vertex, from 0.")
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
      field("region", &RegionPin::region,
            "A box that holds vertices of a mesh, as it is placed at the start.")
          .required()
          .rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<GroupPin>> fieldsOf<GroupPin>() {
  static const std::array fields{
      field("group", &GroupPin::group, "Name of a group (g) of a mesh's faces, of which all vertices count.")
          .required()
          .rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<PinMotion>> fieldsOf<PinMotion>() {
  static const std::array fields{
      field("keys", &PinMotion::keys, "Places along the path; straight lines in between.").required(),
      field("loop", &PinMotion::loop, "Begin again after the last key; otherwise stop there."),
      field("pinned", &PinMotion::pinned, "The pins that follow this path, some of the cloth's own.")
          .byDefault("all pins of the cloth"),
  };
  return fields;
}

template <>
std::span<const Field<PinMotion::Key>> fieldsOf<PinMotion::Key>() {
  using K = PinMotion::Key;
  static const std::array fields{
      field("t", &K::t, "Time of the key, later than the one before.").in("s").within(notNegative).required(),
      field("position", &K::position, "Where the centre of these pins is then.")
          .in("m")
          .byDefault("the mean of their start positions"),
      field("rotation", &K::rotation, "Turn about that centre: axis times angle; may exceed 360.")
          .in("degrees"),
  };
  return fields;
}

}  // namespace clothsim

// The tables of all structs of a scene. JSON reading and writing, --set, describe and the panels of the
// viewer walk over them. The codecs (codec.h) know how a type looks in JSON.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "scene/budget.h"
#include "scene/field.h"
#include "scene/scene.h"

namespace clothsim {

// "> 0", "0 to 1", "" for any.
[[nodiscard]] std::string limitsText(const Limits& limits);
[[nodiscard]] bool within(const Limits& limits, double value);

// The ends of a slider for the field: what is usual, else its limits, else ten times its value `now`.
[[nodiscard]] Usual sliderRange(const FieldTraits& traits, double now);

template <>
struct MemberOf<Scene> {
  using Type = MemberAmong<Scene, std::vector<ClothSettings>, std::vector<Seam>, std::vector<Collider>,
                           std::vector<Attractor>, std::optional<Wind>, SolverSettings, CameraSettings,
                           RenderSettings, std::optional<Expect>>;
};
template <>
struct MemberOf<ClothSettings> {
  using Type = MemberAmong<ClothSettings, Orientation, std::vector<StiffnessPart>, std::vector<Pin>,
                           std::vector<PinMotion>, std::optional<Material>, std::optional<Vec3d>, ClothLook>;
};
template <>
struct MemberOf<ClothLook> {
  using Type = MemberAmong<ClothLook, std::optional<Vec3d>, std::optional<std::string>>;
};
template <>
struct MemberOf<PaintedPin> {
  using Type = MemberAmong<PaintedPin, Paint>;
};
template <>
struct MemberOf<StiffnessPart> {
  using Type = MemberAmong<StiffnessPart, std::vector<Pin>>;
};
template <>
struct MemberOf<SeamSide> {
  using Type = MemberAmong<SeamSide, std::vector<Pin>>;
};
template <>
struct MemberOf<Seam> {
  using Type = MemberAmong<Seam, SeamSide>;
};
template <>
struct MemberOf<RegionPin> {
  using Type = MemberAmong<RegionPin, Region>;
};
template <>
struct MemberOf<Motion> {
  using Type = MemberAmong<Motion, std::vector<Motion::Key>, Interpolation>;
};
template <>
struct MemberOf<PinMotion> {
  using Type = MemberAmong<PinMotion, std::vector<Pin>, std::vector<PinMotion::Key>, Interpolation>;
};
template <>
struct MemberOf<PinMotion::Key> {
  using Type = MemberAmong<PinMotion::Key, std::optional<Vec3d>>;
};
template <>
struct MemberOf<Wind> {
  using Type = MemberAmong<Wind, Gust>;
};
template <>
struct MemberOf<SolverSettings> {
  using Type = MemberAmong<SolverSettings, Integrator, SelfCollision, FrictionLaw, AutoCount>;
};
template <>
struct MemberOf<CameraSettings> {
  using Type = MemberAmong<CameraSettings, std::optional<Vec3d>>;
};
template <>
struct MemberOf<RenderSettings> {
  using Type = MemberAmong<RenderSettings, std::optional<Vec3d>>;
};
template <>
struct MemberOf<Expect> {
  using Type = MemberAmong<Expect, std::optional<Range>, std::optional<Vec3d>>;
};
// The table of a struct; a type that has one is a JSON object.
template <class Owner>
[[nodiscard]] std::span<const Field<Owner>> fieldsOf() = delete;

// Of what knows its own.
template <class Owner>
requires requires { Owner::fields(); }
[[nodiscard]] std::span<const Field<Owner>> fieldsOf() { return Owner::fields(); }

template <>
std::span<const Field<Scene>> fieldsOf<Scene>();
template <>
std::span<const Field<ClothSettings>> fieldsOf<ClothSettings>();
template <>
std::span<const Field<ClothLook>> fieldsOf<ClothLook>();
template <>
std::span<const Field<Material>> fieldsOf<Material>();
template <>
std::span<const Field<GridRange>> fieldsOf<GridRange>();
template <>
std::span<const Field<VertexPin>> fieldsOf<VertexPin>();
template <>
std::span<const Field<Region>> fieldsOf<Region>();
template <>
std::span<const Field<RegionPin>> fieldsOf<RegionPin>();
template <>
std::span<const Field<GroupPin>> fieldsOf<GroupPin>();
template <>
std::span<const Field<PaintedPin>> fieldsOf<PaintedPin>();
template <>
std::span<const Field<StiffnessPart>> fieldsOf<StiffnessPart>();
template <>
std::span<const Field<Motion>> fieldsOf<Motion>();
template <>
std::span<const Field<Motion::Key>> fieldsOf<Motion::Key>();
template <>
std::span<const Field<PinMotion>> fieldsOf<PinMotion>();
template <>
std::span<const Field<PinMotion::Key>> fieldsOf<PinMotion::Key>();
template <>
std::span<const Field<SeamSide>> fieldsOf<SeamSide>();
template <>
std::span<const Field<Seam>> fieldsOf<Seam>();
template <>
std::span<const Field<Wind>> fieldsOf<Wind>();
template <>
std::span<const Field<Gust>> fieldsOf<Gust>();
template <>
std::span<const Field<SolverSettings>> fieldsOf<SolverSettings>();
template <>
std::span<const Field<CameraSettings>> fieldsOf<CameraSettings>();
template <>
std::span<const Field<RenderSettings>> fieldsOf<RenderSettings>();
template <>
std::span<const Field<Expect>> fieldsOf<Expect>();

template <class T>
concept HasFields = requires {
  fieldsOf<T>();
};

}  // namespace clothsim

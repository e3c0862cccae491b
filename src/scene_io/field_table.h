// One entry a scene key: everything that is known about it apart from the value. JSON reading and writing,
// --set, describe and the panels of the viewer walk over these tables. The codecs (codec.h) know how a type
// looks in JSON.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "scene/budget.h"
#include "scene/scene.h"

namespace clothsim {

// The range of a number. In a vector it holds for each component.
struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool lowOpen = false;  // low itself is not allowed
  bool nonZero = false;  // a vector other than [0, 0, 0]
};

// Where a slider begins and ends: what is commonly used. Typed numbers may go as far as the limits.
struct Usual {
  double low = 0, high = 0;  // both 0: not known
};

// "> 0", "0 to 1", "" for any.
[[nodiscard]] std::string limitsText(const Limits& limits);

// How a value is written where its C++ type leaves a choice.
enum class Format { plain, color, orFalse };

// When a change takes effect: in the next step, or by building the cloth anew.
enum class Change { live, rebuild };

// Whether a key must be there (and is always written), is always written, or is left out at its default.
enum class Presence { optional, written, required };

struct FieldTraits {
  std::string_view key;
  std::string_view help;
  std::string_view unit{};
  Limits limits{};
  Change change = Change::live;
  Format format = Format::plain;
  Presence presence = Presence::optional;
  std::string_view defaultText{};               // where the default depends on the scene
  std::span<const std::string_view> choices{};  // what a string may be; empty: anything
  Usual usual{};
};

// The ends of a slider for the field: what is usual, else its limits, else ten times its value `now`.
[[nodiscard]] Usual sliderRange(const FieldTraits& traits, double now);

// The types that members of a struct may have: these, and those that its owner adds. (With one list for all
// owners each walk over a table would be compiled for types that the table does not have.)
template <class Owner, class... More>
using MemberAmong = std::variant<bool Owner::*, int Owner::*, double Owner::*, std::string Owner::*,
                                 Vec3d Owner::*, std::optional<double> Owner::*, More Owner::*...>;
template <class Owner>
struct MemberOf {
  using Type = MemberAmong<Owner, GridPoint, Orientation, std::optional<Motion>>;
};
template <>
struct MemberOf<Scene> {
  using Type = MemberAmong<Scene, std::vector<ClothSettings>, std::vector<Collider>, std::optional<Wind>,
                           SolverSettings, CameraSettings, RenderSettings, std::optional<Expect>>;
};
template <>
struct MemberOf<ClothSettings> {
  using Type = MemberAmong<ClothSettings, Orientation, std::vector<Pin>, std::vector<PinMotion>,
                           std::optional<Material>, std::optional<Vec3d>>;
};
template <>
struct MemberOf<RegionPin> {
  using Type = MemberAmong<RegionPin, Region>;
};
template <>
struct MemberOf<Motion> {
  using Type = MemberAmong<Motion, std::vector<Motion::Key>>;
};
template <>
struct MemberOf<PinMotion> {
  using Type = MemberAmong<PinMotion, std::vector<Pin>, std::vector<PinMotion::Key>>;
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
template <class Owner>
using Member = typename MemberOf<Owner>::Type;

template <class Owner>
struct Field : FieldTraits {
  Member<Owner> member;

  Field(std::string_view key_, Member<Owner> member_, std::string_view help_)
      : FieldTraits{.key = key_, .help = help_}, member(member_) {}

  // For the tables: each returns the field with one trait more.
  Field in(std::string_view u) const {
    return with([&](Field& f) { f.unit = u; });
  }
  Field within(Limits l) const {
    return with([&](Field& f) { f.limits = l; });
  }
  Field usually(double low, double high) const {
    return with([&](Field& f) { f.usual = {low, high}; });
  }
  Field as(Format kind) const {
    return with([&](Field& f) { f.format = kind; });
  }
  Field required() const {
    return with([](Field& f) { f.presence = Presence::required; });
  }
  Field alwaysWritten() const {
    return with([](Field& f) { f.presence = Presence::written; });
  }
  Field byDefault(std::string_view text) const {
    return with([&](Field& f) { f.defaultText = text; });
  }
  Field oneOf(std::span<const std::string_view> words) const {
    return with([&](Field& f) { f.choices = words; });
  }
  Field rebuilds() const {
    return with([](Field& f) { f.change = Change::rebuild; });
  }

 private:
  template <class Edit>
  Field with(Edit edit) const {
    Field copy = *this;
    edit(copy);
    return copy;
  }
};

// The table of a struct; a type that has one is a JSON object.
template <class Owner>
[[nodiscard]] std::span<const Field<Owner>> fieldsOf() = delete;

template <>
std::span<const Field<Scene>> fieldsOf<Scene>();
template <>
std::span<const Field<ClothSettings>> fieldsOf<ClothSettings>();
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
std::span<const Field<Sphere>> fieldsOf<Sphere>();
template <>
std::span<const Field<Plane>> fieldsOf<Plane>();
template <>
std::span<const Field<Capsule>> fieldsOf<Capsule>();
template <>
std::span<const Field<Box>> fieldsOf<Box>();
template <>
std::span<const Field<Torus>> fieldsOf<Torus>();
template <>
std::span<const Field<MeshCollider>> fieldsOf<MeshCollider>();
template <>
std::span<const Field<Motion>> fieldsOf<Motion>();
template <>
std::span<const Field<Motion::Key>> fieldsOf<Motion::Key>();
template <>
std::span<const Field<PinMotion>> fieldsOf<PinMotion>();
template <>
std::span<const Field<PinMotion::Key>> fieldsOf<PinMotion::Key>();
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

// Scenes with `ks` get CS184's limiter and self-collision unless they say otherwise, scenes with a material
// Coulomb's friction and the implicit integrator in as many steps as it needs.
[[nodiscard]] SolverSettings solverDefaults(bool usesKs, bool usesMaterial);
// Whether some cloth follows CS184's model. A cloth with neither constant does: the reader gives it
// defaultKs.
[[nodiscard]] bool usesKs(const Scene& scene);

}  // namespace clothsim

// One entry a scene key: everything that is known about it apart from the value. Tables of entries are made
// from this; who reads, writes and draws them is above (scene_io, viewer).
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/vec.h"
#include "scene/colliders/solid_look.h"
#include "scene/motion.h"

namespace clothsim {

struct GridPoint;
enum class Orientation;

// What a number may be. In a vector it holds for each component, in a list of objects for their count.
struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool lowOpen = false;  // low itself is not allowed
  bool nonZero = false;  // a vector other than [0, 0, 0]
};

inline constexpr Limits positive{.low = 0, .lowOpen = true};
inline constexpr Limits notNegative{.low = 0};

// Where a slider begins and ends: what is commonly used. Typed numbers may go as far as the limits.
struct Usual {
  double low = 0, high = 0;  // both 0: nothing is said
};

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

// What a member may be: one of these types, or of those that its owner has besides. (One list for all owners
// would have each walk over a table compiled for types that the table does not have.)
template <class Owner, class... More>
using MemberAmong = std::variant<bool Owner::*, int Owner::*, double Owner::*, std::string Owner::*,
                                 Vec3d Owner::*, std::optional<double> Owner::*, More Owner::*...>;
template <class Owner>
struct MemberOf {
  using Type = MemberAmong<Owner, GridPoint, Orientation, std::optional<Motion>, SolidLook>;
};
template <>
struct MemberOf<SolidLook> {
  using Type = MemberAmong<SolidLook, std::optional<Vec3d>>;
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

// An entry of a table, with nothing yet but its name and what it means.
template <class Owner, class T>
[[nodiscard]] Field<Owner> field(std::string_view key, T Owner::*member, std::string_view help) {
  return {key, member, help};
}

}  // namespace clothsim

// How each type of the field table looks in JSON: readValue, writeValue and typeName, one overload a type. A
// type with a table of its own is an object, and these functions walk over its table.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "scene_io/field_table.h"
#include "scene_io/json_tree.h"

namespace clothsim {

// --- Values. Readers throw JsonComplaint and leave `target` as it was or half read.
void readValue(const JsonNode& node, const FieldTraits& traits, bool& target);
void readValue(const JsonNode& node, const FieldTraits& traits, int& target);
void readValue(const JsonNode& node, const FieldTraits& traits, double& target);
void readValue(const JsonNode& node, const FieldTraits& traits, std::string& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Vec3d& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Orientation& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Integrator& target);
// `true` becomes `averaged` over a default of `averaged`, else `robust`.
void readValue(const JsonNode& node, const FieldTraits& traits, SelfCollision& target);
void readValue(const JsonNode& node, const FieldTraits& traits, FrictionLaw& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Interpolation& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Paint& target);
void readValue(const JsonNode& node, const FieldTraits& traits, GridPoint& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Range& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Pin& target);
void readValue(const JsonNode& node, const FieldTraits& traits, Collider& target);
void readValue(const JsonNode& node, const FieldTraits& traits, std::vector<PinMotion>& target);
void readValue(const JsonNode& node, const FieldTraits& traits, std::optional<double>& target);
void readValue(const JsonNode& node, const FieldTraits& traits, AutoCount& target);
// An object, read over what is there, or the name of a preset.
void readValue(const JsonNode& node, const FieldTraits& traits, std::optional<Material>& target);

[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, bool value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, int value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, double value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const std::string& value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, Vec3d value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, Orientation value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, Integrator value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, SelfCollision value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, FrictionLaw value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, Interpolation value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, Paint value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, GridPoint value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const Range& value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const Pin& value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const Collider& value);
// A single motion of all pins is an object, without a list around it.
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const std::vector<PinMotion>& values);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const std::optional<double>& value);
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const std::optional<Material>& value);
[[nodiscard]] JsonPointer spelledOut(const Material& material);  // also where it is a preset
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const AutoCount& value);

// What describe says of a type.
[[nodiscard]] std::string typeName(const FieldTraits& traits, const bool&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const int&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const double&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const std::string&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Vec3d&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Orientation&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Integrator&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const SelfCollision&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const FrictionLaw&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Interpolation&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Paint&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const GridPoint&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Range&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Pin&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const Collider&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const std::vector<PinMotion>&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const std::optional<double>&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const AutoCount&);
[[nodiscard]] std::string typeName(const FieldTraits& traits, const std::optional<Material>&);

// "sphere, plane, ...": what a collider's type may be.
[[nodiscard]] std::string colliderTypes();

// --- After all keys of an object were read, finishReading() checks them against each other and fills in what
// follows from others. After they were written, finishWriting() removes what a reader would fill in again.
template <class T>
void finishReading(const JsonNode&, T&) {}
template <>
void finishReading(const JsonNode& node, ClothSettings& cloth);
template <>
void finishReading(const JsonNode& node, GridRange& range);
template <>
void finishReading(const JsonNode& node, Region& region);
template <>
void finishReading(const JsonNode& node, StiffnessPart& part);
template <>
void finishReading(const JsonNode& node, Motion& motion);
template <>
void finishReading(const JsonNode& node, PinMotion& motion);

// Keys of a motion without a position stay at the collider's own place.
void completeMotion(const JsonNode& collider, std::optional<Motion>& motion, Vec3d place);
// @param found  the value of the misfit's key, which may be a default
[[noreturn]] void complainOfMisfit(const JsonNode& collider, const Misfit& misfit, const JsonNode& found);
template <WrittenShape Shape>
void finishReading(const JsonNode& node, Shape& shape) {
  completeMotion(node, shape.motion, shape.place());
  if constexpr (requires { shape.finishReading(IsGiven{}); }) {
    const auto misfit = shape.finishReading([&](std::string_view key) { return node.find(key) != nullptr; });
    if (!misfit) return;
    for (const Field<Shape>& field : shape.fields())
      if (field.key == misfit->key)
        std::visit([&](auto pointer) { complainOfMisfit(node, *misfit, *writeValue(field, shape.*pointer)); },
                   field.member);
  }
}

template <class T>
void finishWriting(JsonNode&, const T&) {}
void omitOwnPlace(JsonNode& collider, const std::optional<Motion>& motion, Vec3d place);
template <WrittenShape Shape>
void finishWriting(JsonNode& node, const Shape& shape) {
  omitOwnPlace(node, shape.motion, shape.place());
}

// --- Objects
void expectObject(const JsonNode& node);
[[noreturn]] void complainUnknownKey(const JsonNode& member, const std::vector<std::string>& known);
[[noreturn]] void complainMissingKey(const JsonNode& object, const FieldTraits& missing);

template <class Owner>
[[nodiscard]] std::vector<std::string> keysOf() {
  std::vector<std::string> keys;
  for (const Field<Owner>& field : fieldsOf<Owner>()) keys.emplace_back(field.key);
  return keys;
}

// Reads the object over the values that `target` has. `alsoKnown`: keys that somebody else reads.
template <class Owner>
void readObject(const JsonNode& node, Owner& target, const std::vector<std::string>& alsoKnown = {}) {
  expectObject(node);
  std::vector<std::string> known = keysOf<Owner>();
  known.insert(known.end(), alsoKnown.begin(), alsoKnown.end());
  for (const auto& member : node.children) {
    if (isComment(member->key)) continue;
    if (std::find(known.begin(), known.end(), member->key) == known.end()) complainUnknownKey(*member, known);
  }
  for (const Field<Owner>& field : fieldsOf<Owner>()) {
    const JsonNode* member = node.find(field.key);
    if (member != nullptr)
      std::visit([&](auto pointer) { readValue(*member, field, target.*pointer); }, field.member);
    else if (field.presence == Presence::required)
      complainMissingKey(node, field);
  }
  finishReading(node, target);
}

// Whether two values are written alike: -0 is not 0, and one "auto" is as good as another.
template <class T>
[[nodiscard]] bool sameWritten(const T& a, const T& b) {
  return a == b;
}
[[nodiscard]] inline bool sameWritten(const double& a, const double& b) {
  return a == b && std::signbit(a) == std::signbit(b);
}
[[nodiscard]] inline bool sameWritten(const Vec3d& a, const Vec3d& b) {
  return sameWritten(a.x, b.x) && sameWritten(a.y, b.y) && sameWritten(a.z, b.z);
}
[[nodiscard]] inline bool sameWritten(const AutoCount& a, const AutoCount& b) {
  return a == b || (a.automatic && b.automatic);
}
template <class T>
[[nodiscard]] bool sameWritten(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || sameWritten(*a, *b));
}

// Writes what differs from `defaults`.
template <class Owner>
[[nodiscard]] JsonPointer writeObject(const Owner& value, const Owner& defaults) {
  JsonPointer node = makeObject();
  for (const Field<Owner>& field : fieldsOf<Owner>()) {
    std::visit(
        [&](auto pointer) {
          using T = std::remove_cvref_t<decltype(value.*pointer)>;
          const bool isOptional = field.presence == Presence::optional;
          if constexpr (HasFields<T>) {
            JsonPointer members = writeObject(value.*pointer, defaults.*pointer);
            if (isOptional && members->children.empty()) return;
            node->append(std::string(field.key), std::move(members));
          } else {
            if (isOptional && sameWritten(value.*pointer, defaults.*pointer)) return;
            node->append(std::string(field.key), writeValue(field, value.*pointer));
          }
        },
        field.member);
  }
  finishWriting(*node, value);
  return node;
}

template <HasFields T>
void readValue(const JsonNode& node, const FieldTraits&, T& target) {
  readObject(node, target);
}
template <HasFields T>
[[nodiscard]] JsonPointer writeValue(const FieldTraits&, const T& value) {
  return writeObject(value, T{});
}
template <HasFields T>
[[nodiscard]] std::string typeName(const FieldTraits&, const T&) {
  return "object";
}

// --- Optional values and lists of what is above
template <class T>
void readValue(const JsonNode& node, const FieldTraits& traits, std::optional<T>& target) {
  T value{};
  readValue(node, traits, value);
  target = std::move(value);
}
// The caller leaves absent values out.
template <class T>
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const std::optional<T>& value) {
  return writeValue(traits, value.value());
}
template <class T>
[[nodiscard]] std::string typeName(const FieldTraits& traits, const std::optional<T>&) {
  return typeName(traits, T{});
}

template <class T>
void readValue(const JsonNode& node, const FieldTraits& traits, std::vector<T>& target) {
  if (node.kind != JsonKind::list) complainExpected(node, "a " + typeName(traits, target));
  if (static_cast<double>(node.children.size()) > traits.limits.high)
    complain(node, "expected a list of at most " + formatNumber(traits.limits.high) +
                       " entries, found a list of " + std::to_string(node.children.size()));
  target.clear();
  for (const auto& child : node.children) {
    T value{};
    readValue(*child, traits, value);
    target.push_back(std::move(value));
  }
}
template <class T>
[[nodiscard]] JsonPointer writeValue(const FieldTraits& traits, const std::vector<T>& values) {
  JsonPointer list = makeList();
  for (const T& value : values) list->append("", writeValue(traits, value));
  return list;
}
template <class T>
[[nodiscard]] std::string typeName(const FieldTraits& traits, const std::vector<T>&) {
  const std::string element = typeName(traits, T{});
  return "list of " + (element == "object" ? "objects" : element);
}

}  // namespace clothsim

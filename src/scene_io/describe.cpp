// The field table as text, for `clothsim describe` and the reference documentation.
#include "scene_io/describe.h"

#include <algorithm>
#include <utility>

#include "scene_io/codec.h"

namespace clothsim {

namespace {

using Infos = std::vector<FieldInfo>;

// An entry for what is not a member of a struct.
FieldInfo entry(std::string path, std::string type, std::string defaultValue, std::string help, bool live) {
  return {std::move(path), std::move(type), "", "", std::move(defaultValue), std::move(help), live};
}

FieldInfo infoOf(const FieldTraits& field, const std::string& path, std::string type,
                 std::string defaultValue) {
  return {.path = path,
          .type = std::move(type),
          .unit = std::string(field.unit),
          .range = limitsText(field.limits),
          .defaultValue = std::move(defaultValue),
          .help = std::string(field.help),
          .live = field.change == Change::live};
}

template <class T>
std::string defaultText(const FieldTraits& traits, const T& value) {
  if (!traits.defaultText.empty()) return std::string(traits.defaultText);
  if (traits.presence == Presence::required) return "required";
  if constexpr (HasFields<T>)
    return "";
  else
    return formatJsonLine(*writeValue(traits, value));
}
template <class T>
std::string defaultText(const FieldTraits& traits, const std::optional<T>& value) {
  if (!traits.defaultText.empty()) return std::string(traits.defaultText);
  return value ? defaultText(traits, *value) : "none";
}

template <class Owner>
void describeObject(const std::string& prefix, Infos& infos);

// What lies inside a value, if it has a table.
template <class T>
void describeInside(const std::string& path, const T&, Infos& infos) {
  if constexpr (HasFields<T>) describeObject<T>(path + ".", infos);
}
template <class T>
void describeInside(const std::string& path, const std::optional<T>&, Infos& infos) {
  describeInside(path, T{}, infos);
}
template <class T>
void describeInside(const std::string& path, const std::vector<T>&, Infos& infos) {
  describeInside(path + "[]", T{}, infos);
}
void describeInside(const std::string&, const std::vector<ClothSettings>&, Infos& infos) {
  infos.push_back(entry("cloth", "object", "", "The cloth, as in CS184; cloth.x is cloths.0.x.", false));
  describeObject<ClothSettings>("cloth.", infos);
}
void describeInside(const std::string& path, const GridRange&, Infos& infos) {
  describeObject<GridRange>(path + ".", infos);
}
void describeInside(const std::string& path, const Region&, Infos& infos) {
  describeObject<Region>(path + ".", infos);
}
void describeInside(const std::string& path, const std::vector<Pin>&, Infos& infos) {
  describeInside(path + "[]", GridRange{}, infos);
  describeObject<VertexPin>(path + "[].", infos);
  describeObject<RegionPin>(path + "[].", infos);
  describeObject<GroupPin>(path + "[].", infos);
  describeObject<PaintedPin>(path + "[].", infos);
}
void describeInside(const std::string& path, const std::vector<Collider>&, Infos& infos) {
  infos.push_back(
      entry(path + "[].type", "one of " + colliderTypes(), "required", "Shape of the collider.", true));
  for (const Collider& collider : defaultColliders())
    std::visit(
        [&](const auto& shape) { describeObject<std::remove_cvref_t<decltype(shape)>>(path + "[].", infos); },
        collider);
  infos.push_back(
      entry("plane", "object", "none",
            "A plane collider, as in CS184; cloth on it never quite rests, as each touch lifts it by 0.1 mm.",
            true));
  infos.push_back(entry("sphere", "object", "none", "A sphere collider, as in CS184.", true));
}

template <class Owner>
void describeObject(const std::string& prefix, Infos& infos) {
  const Owner defaults{};
  for (const Field<Owner>& field : fieldsOf<Owner>()) {
    const std::string path = prefix + std::string(field.key);
    // Colliders share keys.
    if (std::any_of(infos.begin(), infos.end(), [&](const FieldInfo& info) { return info.path == path; }))
      continue;
    std::visit(
        [&](auto pointer) {
          const auto& value = defaults.*pointer;
          infos.push_back(infoOf(field, path, typeName(field, value), defaultText(field, value)));
          describeInside(path, value, infos);
        },
        field.member);
  }
}

}  // namespace

std::vector<FieldInfo> describeFields() {
  Infos infos;
  describeObject<Scene>("", infos);
  return infos;
}

}  // namespace clothsim

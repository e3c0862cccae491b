// The field table as text, for `clothsim describe` and the reference documentation.
#include "scene_io/describe.h"

#include <algorithm>
#include <map>
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

// A row of a table: key, type with unit and range, default, help.
std::string markdownRow(const FieldInfo& info, const std::string& key) {
  std::string value = info.type;
  if (!info.unit.empty()) value += " [" + info.unit + "]";
  if (!info.range.empty()) value += ", " + info.range;
  if (info.live) value += "; live";
  std::string row = "| `" + key + "` | " + value + " | " + info.defaultValue + " | ";
  for (const char c : info.help) row += c == '|' ? "\\|" : std::string(1, c);
  row += " |\n";
  return row;
}

}  // namespace

std::vector<FieldInfo> describeFields() {
  Infos infos;
  describeObject<Scene>("", infos);
  return infos;
}

std::vector<FieldInfo> describeShape(std::string_view type) {
  Infos infos;
  for (const Collider& collider : defaultColliders())
    if (typeOf(collider) == type)
      std::visit(
          [&](const auto& shape) {
            describeObject<std::remove_cvref_t<decltype(shape)>>(std::string(type) + ".", infos);
          },
          collider);
  return infos;
}

std::string fieldsAsMarkdown() {
  std::string page =
      "# Scene files, key by key\n\n"
      "A scene file is one JSON object. `clothsim describe KEY` prints the same; this page is made by\n"
      "`clothsim describe --markdown > docs/scene-format.md`. `[]` is one object of a list: in `--set` its "
      "number\n"
      "stands there, as `colliders.0.radius`. A key that is *live* acts from the next step on; a change of "
      "any\n"
      "other makes the cloth anew. Objects that occur in several places have their table where they come "
      "first.\n";
  const auto parentOf = [](const std::string& path) { return path.substr(0, path.find_last_of('.') + 1); };
  std::map<std::string, std::string> written;  // the rows of a group, which is one object's keys: its path
  const auto write = [&](const Infos& infos, const std::string& heading) {
    std::vector<std::string> parents;
    for (const FieldInfo& info : infos) {
      std::string parent = info.path.find('.') == std::string::npos ? "" : parentOf(info.path);
      if (std::ranges::find(parents, parent) == parents.end()) parents.push_back(std::move(parent));
    }
    for (const std::string& parent : parents) {
      std::string rows;
      for (const FieldInfo& info : infos)
        if (parentOf(info.path) == parent) rows += markdownRow(info, info.path.substr(parent.size()));
      const std::string path = parent.substr(0, parent.empty() ? 0 : parent.size() - 1);
      const auto [first, isNew] = written.emplace(rows, path);
      const auto lastName = [](const std::string& of) { return of.substr(of.find_last_of('.') + 1); };
      if (!isNew && lastName(first->second) == lastName(path)) continue;
      page += "\n" + (path.empty() ? heading : "## `" + path + "`") + "\n\n" +
              (isNew ? "| key | value | default | |\n|---|---|---|---|\n" + rows
                     : "The keys of `" + first->second + "`.\n");
    }
  };
  Infos infos = describeFields();
  std::erase_if(infos, [](const FieldInfo& info) {
    return info.path.starts_with("colliders[].") && info.path != "colliders[].type";
  });
  write(infos, "## The scene");
  page += "\nThe other keys of a collider are those of its type:\n";
  for (const Collider& collider : defaultColliders()) write(describeShape(typeOf(collider)), "");
  return page;
}

}  // namespace clothsim

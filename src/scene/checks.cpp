// What must hold between the keys of an object, and complaints about keys.
#include <algorithm>

#include "core/nearest.h"
#include "scene/codec.h"
#include "scene/fields.h"

namespace clothsim {

namespace {

std::string gridText(const ClothSettings& cloth) {
  return "a column from 0 to " + std::to_string(cloth.numWidthPoints - 1) + " and a row from 0 to " +
         std::to_string(cloth.numHeightPoints - 1);
}

void checkOnGrid(const JsonNode& node, GridPoint point, const ClothSettings& cloth) {
  const bool inside = point.column >= 0 && point.column < cloth.numWidthPoints && point.row >= 0 &&
                      point.row < cloth.numHeightPoints;
  if (!inside)
    complain(node,
             "expected [column, row] on the grid, " + gridText(cloth) + ", found " + formatJsonLine(node));
}

void checkPins(const JsonNode& cloth, const ClothSettings& settings) {
  const JsonNode* pins = cloth.find("pinned");
  for (std::size_t i = 0; i < settings.pinned.size(); ++i) {
    const JsonNode& node = *pins->children[i];
    if (const auto* point = std::get_if<GridPoint>(&settings.pinned[i])) checkOnGrid(node, *point, settings);
    if (const auto* range = std::get_if<GridRange>(&settings.pinned[i])) {
      checkOnGrid(*node.find("from"), range->from, settings);
      checkOnGrid(*node.find("to"), range->to, settings);
    }
  }
}

// Keys of a motion without a position stay at the collider's own place.
void settleMotion(const JsonNode& collider, std::optional<Motion>& motion, Vec3d place) {
  if (!motion) return;
  const JsonNode& keys = *collider.find("motion")->find("keys");
  for (std::size_t i = 0; i < motion->keys.size(); ++i)
    if (keys.children[i]->find("position") == nullptr) motion->keys[i].position = place;
}

void leaveOutOwnPlace(JsonNode& collider, const std::optional<Motion>& motion, Vec3d place) {
  if (!motion) return;
  JsonNode& keys = *collider.find("motion")->find("keys");
  for (std::size_t i = 0; i < motion->keys.size(); ++i)
    if (motion->keys[i].position == place)
      std::erase_if(keys.children[i]->children, [](const auto& member) { return member->key == "position"; });
}

// Where else in the scene the key would be right: "strain_limit" written into a cloth.
std::string placeOfKey(const std::string& key) {
  for (const FieldInfo& field : describeFields())
    if (field.path.ends_with("." + key)) return field.path;
  return "";
}

}  // namespace

template <>
void settle(const JsonNode& node, ClothSettings& cloth) {
  if (cloth.ks && cloth.stiffnessReference)
    complain(
        *node.find("stiffness_reference"),
        "found both ks and stiffness_reference, expected one of them: ks is CS184's stiffness of a spring, "
        "stiffness_reference CS171's");
  if (!cloth.ks && !cloth.stiffnessReference) cloth.ks = defaultKs;
  checkPins(node, cloth);
}

template <>
void settle(const JsonNode& node, GridRange& range) {
  if (range.from.column > range.to.column || range.from.row > range.to.row)
    complain(node, "expected \"from\" at most \"to\" in column and in row, found " + formatJsonLine(node));
}

template <>
void settle(const JsonNode& node, Motion& motion) {
  const JsonNode& keys = *node.find("keys");
  if (motion.keys.empty())
    complain(keys, "expected at least one key {t, position, rotation}, found an empty list");
  for (std::size_t i = 1; i < motion.keys.size(); ++i)
    if (motion.keys[i].t <= motion.keys[i - 1].t)
      complainExpected(*keys.children[i]->find("t"),
                       "a time later than the key before, > " + formatNumber(motion.keys[i - 1].t));
  if (motion.loop && motion.keys.back().t <= 0)
    complain(*keys.children.back()->find("t"), "expected a number > 0 in the last key of a loop, found 0");
}

template <>
void settle(const JsonNode& node, Sphere& sphere) {
  settleMotion(node, sphere.motion, sphere.origin);
}
template <>
void settle(const JsonNode& node, Plane& plane) {
  settleMotion(node, plane.motion, plane.point);
}
template <>
void leaveOut(JsonNode& node, const Sphere& sphere) {
  leaveOutOwnPlace(node, sphere.motion, sphere.origin);
}
template <>
void leaveOut(JsonNode& node, const Plane& plane) {
  leaveOutOwnPlace(node, plane.motion, plane.point);
}

void expectObject(const JsonNode& node) {
  if (node.kind != JsonKind::object) complainExpected(node, "an object {...}");
}

void complainUnknownKey(const JsonNode& member, const std::vector<std::string>& known) {
  std::string advice = didYouMean(member.key, known);
  if (advice.empty()) {
    const std::string place = placeOfKey(member.key);
    if (!place.empty()) advice = "; it belongs to " + place;
  }
  if (advice.empty()) {
    for (const std::string& key : known) advice += (advice.empty() ? "; known here: " : ", ") + key;
  }
  complain(member, "unknown key" + advice);
}

void complainMissingKey(const JsonNode& object, const FieldTraits& missing) {
  complain(object, "the key \"" + std::string(missing.key) + "\" is missing: " + std::string(missing.help));
}

}  // namespace clothsim

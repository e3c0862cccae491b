// Checks what must hold between the keys of an object, and complains about wrong keys.
#include <algorithm>

#include "cloth/material.h"
#include "cloth/pins.h"
#include "core/nearest.h"
#include "scene/budget.h"
#include "scene_io/codec.h"
#include "scene_io/describe.h"
#include "scene_io/scene_tree.h"

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

void checkPinList(const JsonNode* list, const std::vector<Pin>& pins, const ClothSettings& settings) {
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const JsonNode& node = *list->children[i];
    if (isMeshPin(pins[i]) != settings.isMesh())
      complain(
          node,
          settings.isMesh()
              ? "expected a pin of a mesh, {\"vertex\": number}, {\"region\": {from, to}}, {\"group\": "
                "name} or {\"painted\": \"red\"}, found " +
                    formatJsonLine(node)
              : "expected a pin of a grid, since the cloth has no \"mesh\", found " + formatJsonLine(node));
    if (const auto* point = std::get_if<GridPoint>(&pins[i])) checkOnGrid(node, *point, settings);
    if (const auto* range = std::get_if<GridRange>(&pins[i])) {
      checkOnGrid(*node.find("from"), range->from, settings);
      checkOnGrid(*node.find("to"), range->to, settings);
    }
  }
}

// `owner`: the cloth or the motion that has the key "pinned".
void checkPins(const JsonNode& owner, const std::vector<Pin>& pins, const ClothSettings& settings) {
  checkPinList(owner.find("pinned"), pins, settings);
}

// On a grid all springs of a kind are alike.
void checkStiffnessMap(const JsonNode& node, const ClothSettings& cloth) {
  const JsonNode* map = node.find("stiffness_map");
  if (map == nullptr || cloth.stiffnessMap.empty()) return;
  if (!cloth.isMesh())
    complain(
        *map,
        "found a stiffness_map of a grid, expected one of a mesh: a grid is alike everywhere. Write it as a "
        "mesh, with clothsim run --frames 0 --save cloth.obj, and name that file as \"mesh\"");
  for (std::size_t i = 0; i < cloth.stiffnessMap.size(); ++i)
    checkPinList(map->children[i]->find("points"), cloth.stiffnessMap[i].points, cloth);
}

void checkSide(const JsonNode& node, const SeamSide& side, const std::vector<ClothSettings>& cloths) {
  if (side.cloth >= static_cast<int>(cloths.size()))
    complain(*node.find("cloth"), "expected one of the " + std::to_string(cloths.size()) +
                                      " cloths, counted from 0, found " + std::to_string(side.cloth));
  const JsonNode& list = *node.find("points");
  const ClothSettings& cloth = cloths[static_cast<std::size_t>(side.cloth)];
  if (side.points.empty()) complain(list, "expected points to sew, found an empty list");
  checkPinList(&list, side.points, cloth);
  for (std::size_t i = 0; !cloth.isMesh() && i < side.points.size(); ++i) {
    const GridRange line = pointsOf(side.points[i], cloth);
    if (line.from.column != line.to.column && line.from.row != line.to.row)
      complain(*list.children[i], "expected points of one row or one column, found a block");
  }
}

// Each motion must move pins of the cloth that no other motion moves.
void checkPinMotions(const JsonNode& cloth, const ClothSettings& settings) {
  const double points =
      settings.isMesh() ? 0 : static_cast<double>(settings.numWidthPoints) * settings.numHeightPoints;
  const bool isTooLarge = points > mostParticles || points * BYTES_A_PARTICLE > machineMemory();
  if (settings.pinMotion.empty() || isTooLarge) return;  // Too large a grid has its own complaint.
  const JsonNode& motions = *cloth.find("pin_motion");
  const auto nodeOf = [&](std::size_t i) -> const JsonNode& {
    return motions.kind == JsonKind::list ? *motions.children[i] : motions;
  };
  if (settings.pinned.empty())
    complain(motions, "expected pins to move, found none: the cloth's key \"pinned\" names no point");
  for (std::size_t i = 0; i < settings.pinMotion.size(); ++i)
    checkPins(nodeOf(i), settings.pinMotion[i].pinned, settings);
  if (settings.isMesh()) return;  // The place of its file is known later, so that Cloth checks this.
  const auto conflict = findPinConflict(settings);
  if (!conflict) return;
  const JsonNode& motion = nodeOf(conflict->motion);
  const JsonNode* pins = motion.find("pinned");
  const JsonNode& place = pins == nullptr ? motion : *pins->children[conflict->pin];
  if (!conflict->otherMotion)
    complain(place, "expected only pins of the cloth, found " + conflict->point +
                        ", which the cloth's key \"pinned\" does not name");
  complain(place, "expected each pin in one motion, found " + conflict->point + " in pin_motion." +
                      std::to_string(*conflict->otherMotion) + ", too" +
                      (pins == nullptr ? "; a motion without the key \"pinned\" moves all pins" : ""));
}

// Of a motion of either kind.
template <class Keys>
void checkKeys(const JsonNode& motion, const Keys& keys, bool loop) {
  const JsonNode& list = *motion.find("keys");
  if (keys.empty()) complain(list, "expected at least one key {t, position, rotation}, found an empty list");
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].t <= keys[i - 1].t)
      complainExpected(*list.children[i]->find("t"),
                       "a time later than the key before, > " + formatNumber(keys[i - 1].t));
  if (loop && keys.back().t <= 0)
    complain(*list.children.back()->find("t"), "expected a number > 0 in the last key of a loop, found 0");
}

// Refuses keys that a material replaces, and cells so oblong that a spring would need a negative constant.
void checkMaterial(const JsonNode& node, const ClothSettings& cloth) {
  for (const char* key : {"ks", "stiffness_reference", "density", "mass", "damping", "thickness"})
    if (const JsonNode* given = node.find(key))
      complain(*given, std::string("found both ") + key +
                           " and material, expected one of them: a material tells " +
                           "mass, stiffness, damping and thickness");
  if (cloth.isMesh()) return;
  const LatticeStiffness k = latticeStiffness(*cloth.material, cloth.width / (cloth.numWidthPoints - 1),
                                              cloth.height / (cloth.numHeightPoints - 1));
  if (k.alongRow <= 0 || k.alongColumn <= 0)
    complain(*node.find("material"),
             "no springs on a lattice with cells of this shape make this material: the cells are too oblong, "
             "or shear "
             "is too large beside stretch; choose num_width_points and num_height_points for square cells");
}

// Refuses keys of what a mesh takes from its file.
void checkMesh(const JsonNode& node, const ClothSettings& cloth) {
  if (!cloth.isMesh()) {
    if (const JsonNode* given = node.find("mesh")) complainExpected(*given, "the name of an OBJ file");
    if (const JsonNode* given = node.find("scale"); given != nullptr && cloth.scale != 1)
      complain(*given, "only a cloth with the key \"mesh\" has a scale; a grid has width and height");
    return;
  }
  for (const char* key :
       {"width", "height", "num_width_points", "num_height_points", "orientation", "enable_shearing"})
    if (const JsonNode* given = node.find(key))
      complain(*given, std::string("found both ") + key + " and mesh, expected one of them: " + key +
                           " belongs to a grid; a mesh has its shape from its file and is placed by scale, "
                           "rotation and position");
  if (!cloth.material) return;
  if (const JsonNode* given = node.find("material")->find("bend_warp"))
    complain(*given, "a mesh bends alike in all directions: only grids have a warp that bends otherwise");
}

// Where else in the scene the key would be right: "strain_limit" written into a cloth.
std::string placeOfKey(const std::string& key) {
  std::string shortest;
  for (const FieldInfo& field : describeFields())
    if (field.path.ends_with("." + key) && (shortest.empty() || field.path.size() < shortest.size()))
      shortest = field.path;
  return shortest;
}

}  // namespace

template <>
void finishReading(const JsonNode& node, ClothSettings& cloth) {
  if (cloth.ks && cloth.stiffnessReference)
    complain(
        *node.find("stiffness_reference"),
        "found both ks and stiffness_reference, expected one of them: ks is CS184's stiffness of a spring, "
        "stiffness_reference CS171's");
  if (const JsonNode* density = node.find("density"); density != nullptr && cloth.mass)
    complain(*density, "found both density and mass, expected one of them: mass is that of the whole cloth");
  if (cloth.material)
    checkMaterial(node, cloth);
  else if (!cloth.ks && !cloth.stiffnessReference)
    cloth.ks = defaultKs;
  checkMesh(node, cloth);
  checkStiffnessMap(node, cloth);
  checkPins(node, cloth.pinned, cloth);
  checkPinMotions(node, cloth);
}

void checkSeams(const JsonNode& root, const Scene& scene) {
  for (std::size_t i = 0; i < scene.seams.size(); ++i) {
    const JsonNode& seam = *root.find("seams")->children[i];
    checkSide(*seam.find("a"), scene.seams[i].a, scene.cloths);
    checkSide(*seam.find("b"), scene.seams[i].b, scene.cloths);
    if (scene.seams[i].a == scene.seams[i].b)
      complain(*seam.find("b"), "expected another border than that of a, found the same");
  }
}

template <>
void finishReading(const JsonNode& node, GridRange& range) {
  if (range.from.column > range.to.column || range.from.row > range.to.row)
    complain(node, "expected \"from\" at most \"to\" in column and in row, found " + formatJsonLine(node));
}

template <>
void finishReading(const JsonNode& node, Region& region) {
  if (region.from.x > region.to.x || region.from.y > region.to.y || region.from.z > region.to.z)
    complain(node, "expected \"from\" at most \"to\" in x, y and z, found " + formatJsonLine(node));
}

template <>
void finishReading(const JsonNode& node, StiffnessPart& part) {
  if (part.points.empty()) complain(*node.find("points"), "expected at least one entry, found an empty list");
  if (node.find("stretch") == nullptr && node.find("bend") == nullptr)
    complain(node, "expected a factor, \"stretch\", \"bend\" or both, found none");
}

template <>
void finishReading(const JsonNode& node, Motion& motion) {
  checkKeys(node, motion.keys, motion.loop);
}

template <>
void finishReading(const JsonNode& node, PinMotion& motion) {
  const bool follows = motion.collider != NO_BODY;
  if (follows && node.find("keys") != nullptr)
    complain(*node.find("collider"), "found both keys and collider, expected one of them");
  if (node.find("keys") != nullptr)
    checkKeys(node, motion.keys, motion.loop);
  else if (!follows && !motion.release)
    complain(node, "the key \"keys\" is missing: a path, or \"collider\" or \"release\" instead");
  if (const JsonNode* pins = node.find("pinned"); pins != nullptr && motion.pinned.empty())
    complain(*pins, "expected at least one pin, found an empty list; leave the key out to move all pins");
}

void completeMotion(const JsonNode& collider, std::optional<Motion>& motion, Vec3d place) {
  if (!motion) return;
  const JsonNode& keys = *collider.find("motion")->find("keys");
  for (std::size_t i = 0; i < motion->keys.size(); ++i)
    if (keys.children[i]->find("position") == nullptr) motion->keys[i].position = place;
}

void complainOfMisfit(const JsonNode& collider, const Misfit& misfit, const JsonNode& found) {
  const JsonNode* given = collider.find(misfit.key);
  complain(given != nullptr ? *given : collider, "expected " + std::string(misfit.expected) +
                                                     (misfit.limit ? formatNumber(*misfit.limit) : "") +
                                                     ", found " + formatJsonLine(found));
}

void omitOwnPlace(JsonNode& collider, const std::optional<Motion>& motion, Vec3d place) {
  if (!motion) return;
  JsonNode& keys = *collider.find("motion")->find("keys");
  for (std::size_t i = 0; i < motion->keys.size(); ++i)
    if (sameWritten(motion->keys[i].position, place))
      std::erase_if(keys.children[i]->children, [](const auto& member) { return member->key == "position"; });
}

void expectObject(const JsonNode& node) {
  if (node.kind != JsonKind::object) complainExpected(node, "an object {...}");
}

void complainUnknownKey(const JsonNode& member, const std::vector<std::string>& known) {
  std::string advice = didYouMean(member.key, known);
  if (advice.empty()) {
    const std::string place = placeOfKey(member.key);
    const JsonNode* type = member.parent == nullptr ? nullptr : member.parent->find("type");
    if (!place.empty() && !(place.starts_with("colliders[].") && type != nullptr))
      advice = "; it belongs to " + place;
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

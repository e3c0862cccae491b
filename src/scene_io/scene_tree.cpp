// The scene's own rules on top of the field table: CS184's single objects, defaults that follow the model,
// limits that concern all cloths together.
#include "scene_io/scene_tree.h"

#include <algorithm>

#include "cloth/material.h"
#include "cloth/material_look.h"
#include "scene_io/codec.h"
#include "scene_io/solver_defaults.h"

namespace clothsim {

namespace {

// Puts `member` of the root at `place` of the list, which is made if there is none. The member keeps the root
// as parent.
void moveIntoList(JsonNode& root, std::string_view key, std::string_view listKey, std::size_t place) {
  const auto at = std::find_if(root.children.begin(), root.children.end(),
                               [&](const auto& child) { return child->key == key; });
  JsonPointer member = std::move(*at);
  root.children.erase(at);
  JsonNode* list = root.find(listKey);
  if (list == nullptr) {
    list = &root.append(std::string(listKey), makeList());
    list->line = member->line;
  }
  list->children.insert(list->children.begin() + static_cast<std::ptrdiff_t>(place), std::move(member));
}

void gatherCollider(JsonNode& root, const std::string& type) {
  JsonNode* member = root.find(type);
  if (member == nullptr) return;
  expectObject(*member);
  if (const JsonNode* given = member->find("type"))
    complain(*given, "unknown key; only entries of the list \"colliders\" have a type");
  if (const JsonNode* list = root.find("colliders"); list != nullptr && list->kind != JsonKind::list)
    complainExpected(*list, "a list of colliders");
  member->append("type", makeString(type));
  moveIntoList(root, type, "colliders", 0);
}

// Known before the cloths are read, so that the solver's keys are read over the right defaults.
SolverSettings defaultsFor(const JsonNode& root) {
  bool ks = false, material = false;
  if (const JsonNode* cloths = root.find("cloths"))
    for (const auto& cloth : cloths->children) {
      const bool hasMaterial = cloth->find("material") != nullptr;
      material |= hasMaterial;
      ks |= !hasMaterial && cloth->find("stiffness_reference") == nullptr;
    }
  return solverDefaults(ks, material);
}

// Once the material is known: the keys of `render` once more, over the look of the material.
void readOverLook(const JsonNode& root, Scene& scene) {
  if (scene.cloths.empty()) return;
  scene.render = usualLook(scene);
  if (const JsonNode* render = root.find("render")) readObject(*render, scene.render);
}

// Once the integrator is known: contact that nobody asked for by name gives way to explicit steps.
void keepUsualSelfCollision(const JsonNode& root, Scene& scene) {
  const JsonNode* solver = root.find("solver");
  const JsonNode* asked = solver == nullptr ? nullptr : solver->find("self_collision");
  const bool isNamed = asked != nullptr && asked->kind == JsonKind::string;
  if (!isNamed && scene.solver.selfCollision == SelfCollision::contact)
    scene.solver.selfCollision =
        usualSelfCollision(usesKs(scene), usesMaterial(scene), scene.solver.integrator);
}

// First of all checks: in a file of a later version, other complaints would mislead.
void checkSchema(const JsonNode& root) {
  const JsonNode* schema = root.find("schema");
  const std::string known = Scene{}.schema;
  if (schema != nullptr && schema->text.starts_with("clothsim-recording/"))
    complain(*schema, "expected a scene, found a recording; clothsim run --replay takes it");
  if (schema != nullptr && schema->kind == JsonKind::string && schema->text != known)
    complain(*schema, "unknown version " + foundText(*schema) +
                          " of the scene format; this program reads \"" + known + "\"");
}

void checkCloths(const JsonNode& root, const std::vector<ClothSettings>& cloths) {
  const JsonNode& list = *root.find("cloths");
  if (cloths.empty()) complain(list, "expected at least one cloth, found an empty list");
  double particles = 0;
  for (std::size_t i = 0; i < cloths.size(); ++i) {
    if (cloths[i].isMesh()) continue;  // Its particles are counted when its file is read.
    particles += static_cast<double>(cloths[i].numWidthPoints) * cloths[i].numHeightPoints;
    if (particles > mostParticles)
      complain(*list.children[i], "expected at most " + formatNumber(mostParticles) +
                                      " particles in all cloths together, found " + formatNumber(particles));
  }
}

// Under CS184's law friction is a part of the motion, so that it cannot exceed 1.
void checkFriction(const JsonNode& root, const Scene& scene) {
  if (scene.solver.frictionLaw != FrictionLaw::cs184) return;
  for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
    const double friction = std::visit([](const auto& shape) { return shape.friction; }, scene.colliders[i]);
    if (friction <= 1) continue;
    complain(*root.find("colliders")->children[i]->find("friction"),
             "expected a number from 0 to 1, found " + formatNumber(friction) +
                 "; larger ones are Coulomb's coefficient and need \"friction_law\": \"coulomb\" in solver");
  }
}

// Contact of the surface is a part of the implicit step.
void checkSelfCollision(const JsonNode& root, const Scene& scene) {
  if (scene.solver.selfCollision != SelfCollision::contact || isImplicit(scene.solver.integrator)) return;
  complain(*root.find("solver")->find("self_collision"),
           std::string("\"contact\" needs implicit steps, found the integrator \"") +
               integratorName(scene.solver.integrator) +
               "\"; set solver.integrator to \"implicit\" or \"bdf2\", or self_collision to \"robust\"");
}

// What the limit holds does not tear.
void checkTearing(const JsonNode& root, const Scene& scene) {
  const std::optional<double> limit = scene.solver.strainLimit;
  for (std::size_t i = 0; limit && i < scene.cloths.size(); ++i) {
    const std::optional<double> tears = scene.cloths[i].tearStrain;
    if (!tears || *tears < *limit) continue;
    complain(*root.find("cloths")->children[i]->find("tear_strain"),
             "nothing tears at " + formatNumber(*tears) +
                 ", because solver.strain_limit keeps springs below " + formatNumber(*limit) +
                 "; set it to false, or tear_strain below it");
  }
}

// Pins that move with a collider.
void checkFollowed(const JsonNode& root, const Scene& scene) {
  for (std::size_t i = 0; i < scene.cloths.size(); ++i)
    for (const PinMotion& motion : scene.cloths[i].pinMotion)
      if (motion.collider >= static_cast<int>(scene.colliders.size()))
        complain(*root.find("cloths")->children[i]->find("pin_motion"),
                 "pins move with collider " + std::to_string(motion.collider) + ", but the scene has " +
                     std::to_string(scene.colliders.size()) + ", counted from 0");
}

}  // namespace

void gatherLists(JsonNode& root) {
  expectObject(root);
  if (const JsonNode* cloth = root.find("cloth")) {
    if (root.find("cloths") != nullptr)
      complain(*cloth, "found both \"cloth\" and \"cloths\", expected one of them");
    expectObject(*cloth);
    moveIntoList(root, "cloth", "cloths", 0);
  }
  gatherCollider(root, "sphere");
  gatherCollider(root, "plane");  // is put before the sphere
}

Scene readScene(const JsonNode& root) {
  checkSchema(root);
  Scene scene;
  scene.solver = defaultsFor(root);
  readObject(root, scene, {"cloth", "plane", "sphere"});
  readOverLook(root, scene);
  keepUsualSelfCollision(root, scene);
  checkCloths(root, scene.cloths);
  checkFriction(root, scene);
  checkSelfCollision(root, scene);
  checkTearing(root, scene);
  checkFollowed(root, scene);
  checkSeams(root, scene);
  chooseCounts(scene);
  return scene;
}

JsonPointer writeScene(const Scene& scene) {
  Scene defaults;
  defaults.solver = solverDefaults(usesKs(scene), usesMaterial(scene));
  defaults.render = usualLook(scene);
  defaults.solver.selfCollision =
      usualSelfCollision(usesKs(scene), usesMaterial(scene), scene.solver.integrator);
  return writeObject(scene, defaults);
}

}  // namespace clothsim

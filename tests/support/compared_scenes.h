// The scenes that the two backends are compared on: each pass of a step takes part in one of them.
#pragma once

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/mesh_sheet.h"
#include "support/test_scenes.h"

namespace clothsim::test {

inline Scene withWind(Scene scene) {
  scene.wind = Wind{.velocity = {1, 0, 3}, .gust = {.strength = 1, .frequency = 2, .seed = 3}, .lift = 0.5};
  scene.airResistance = 1e-3;
  return scene;
}

// One that pulls, one that pushes and overlaps with it, one of which nothing is felt.
inline Scene withAttractors(Scene scene) {
  scene.attractors = {{.position = {0.3, 0.6, 0.2}, .strength = 30, .radius = 0.6},
                      {.position = {0.7, 0.5, -0.1}, .strength = -20, .radius = 0.5},
                      {.position = {9, 9, 9}, .strength = 5, .radius = 1}};
  return scene;
}

inline Scene withLimiter(Scene scene) {
  scene.solver.strainLimit = 0.1;
  return scene;
}

// A sphere that flies and turns through the sheet's place, a resting one, a floor and a wall.
inline Scene withColliders(Scene scene) {
  Motion motion;
  motion.keys = {{0, {0.5, 0.5, -0.3}, {0, 0, 0}}, {0.1, {0.5, 0.5, 0.1}, {0, 90, 0}}};
  scene.colliders = {
      Sphere{.origin = {0.5, 0.5, -0.3}, .radius = 0.2, .friction = 0.3, .motion = motion},
      Plane{.point = {0, 0.02, 0}, .normal = {0, 1, 0}, .friction = 0.5, .motion = std::nullopt},
      Sphere{.origin = {0.2, 0.8, 0.1}, .radius = 0.15, .friction = 0.9, .motion = std::nullopt},
      Plane{.point = {0, 0, 0.3}, .normal = {0.1, 0, -1}, .friction = 0.1, .motion = std::nullopt}};
  return scene;
}

inline Motion flyingPast(Vec3d from, Vec3d to) {
  Motion motion;
  motion.keys = {{0, from, {0, 0, 0}}, {0.1, to, {30, 90, -50}}};
  return motion;
}

// Every shape that has a frame of its own, resting in the sheet's way and flying through it.
inline Scene withShapes(Scene scene, FrictionLaw law) {
  scene.solver.frictionLaw = law;
  scene.colliders = {
      Capsule{.origin = {0.3, 0.5, 0.07}, .axis = {1, 1, 0.2}, .length = 0.3, .radius = 0.08},
      Box{.origin = {0.8, 0.3, 0.1}, .size = {0.3, 0.2, 0.15}, .rotation = {20, 30, 5}, .friction = 0.3},
      Torus{.origin = {0.5, 0.2, -0.1}, .axis = {0.1, 0.3, 1}, .radius = 0.15, .tubeRadius = 0.05},
      Capsule{.origin = {0.7, 0.7, 0.3},
              .axis = {1, 0, 0},
              .length = 0.2,
              .radius = 0.05,
              .friction = 0,
              .motion = flyingPast({0.7, 0.7, 0.3}, {0.7, 0.6, -0.3})},
      Box{.origin = {0.3, 0.8, -0.5},
          .size = {0.2, 0.3, 0.02},
          .rounding = 0,
          .friction = 1,
          .motion = flyingPast({0.3, 0.8, -0.5}, {0.3, 0.7, 0.5})},
      Torus{.origin = {0.5, 0.5, 0.5},
            .radius = 0.2,
            .tubeRadius = 0.03,
            .friction = 0.8,
            .motion = flyingPast({0.5, 0.5, 0.5}, {0.5, 0.5, -0.5})},
      Cylinder{.origin = {0.1, 0.2, 0.1}, .axis = {1, 0.3, 0}, .height = 0.3, .radius = 0.1},
      Cylinder{.origin = {0.8, 0.5, 0.4},
               .axis = {0.1, 1, 0},
               .height = 0.4,
               .radius = 0.07,
               .friction = 0.6,
               .motion = flyingPast({0.8, 0.5, 0.4}, {0.8, 0.6, -0.4})},
      Cone{.origin = {0.6, 0.2, 0.15}, .axis = {0, 0.2, -1}, .height = 0.3, .radius = 0.12},
      Cone{.origin = {0.2, 0.6, 0.4},
           .axis = {0.1, -1, 0},
           .height = 0.3,
           .radius = 0.04,
           .topRadius = 0.1,
           .friction = 0.6,
           .motion = flyingPast({0.2, 0.6, 0.4}, {0.3, 0.6, -0.4})},
      Plane{.point = {0, 0.02, 0}, .normal = {0.1, 1, 0}, .friction = 0.4, .motion = std::nullopt}};
  return scene;
}

// Two of them, so that the second one's samples do not begin at 0; one flies.
inline Scene withMeshes(Scene scene) {
  scene.colliders = {MeshCollider{.file = "assets/meshes/pawn.obj",
                                  .origin = {0.3, 0.4, 0.05},
                                  .rotation = {10, 0, 100},
                                  .scale = 0.4,
                                  .cells = 24},
                     MeshCollider{.file = "assets/meshes/pawn.obj",
                                  .origin = {0.6, 0.2, -0.3},
                                  .scale = 0.5,
                                  .cells = 31,
                                  .friction = 0.9,
                                  .motion = flyingPast({0.6, 0.2, -0.3}, {0.6, 0.4, 0.3})}};
  return scene;
}

inline Scene withCoulomb(Scene scene) {
  scene.solver.frictionLaw = FrictionLaw::coulomb;
  return scene;
}

// Steps so long that particles get past colliders within one.
inline Scene inLongSteps(Scene scene) {
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  scene.cloths[0].ks = 5;  // too weak to carry the sheet: it falls almost freely
  scene.solver.maxStrain = 1e6;
  return scene;
}

inline Scene vertical(Scene scene) {
  const int last = scene.cloths[0].numHeightPoints - 1;
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].pinned = {GridPoint{0, last}, GridPoint{scene.cloths[0].numWidthPoints - 1, last}};
  return scene;
}

// CS171's springs, from two corners, under symplectic Euler.
inline Scene stiffnessReferenceScene(int n) {
  Scene scene = sheetScene(n);
  scene.cloths[0].ks.reset();
  scene.cloths[0].stiffnessReference = 40;
  scene.cloths[0].enableBending = false;
  scene.cloths[0].mass = 1;
  scene.cloths[0].damping = 0;
  scene.cloths[0].rotation = {60, 0, 0};
  scene.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{n - 1, 0}};
  scene.airResistance = 1e-3;
  scene.solver.integrator = Integrator::euler;
  return scene;
}

// Cotton held in a clamp, so that every rule of bending takes part.
inline Scene materialScene(int n) {
  Scene scene = sheetScene(n);
  scene.cloths[0].ks.reset();
  scene.cloths[0].material = Material{.stretch = 300, .bend = 1e-4};
  scene.cloths[0].pinned = {GridRange{{0, 0}, {n - 1, 1}}};
  return scene;
}

inline Scene twoCloths(Scene scene) {
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].numWidthPoints = 7;
  scene.cloths[1].orientation = Orientation::horizontal;
  scene.cloths[1].pinned.clear();
  scene.cloths[1].damping = 1;
  return scene;
}

// Their borders are sewn together, and the left and the right border of the first one.
inline Scene withSeams(Scene scene) {
  Seam between, tube;
  between.a = {0, {GridSide::bottom}};
  between.b = {1, {GridSide::top}, true};
  between.time = 0.05;
  tube.a = {0, {GridSide::left}};
  tube.b = {0, {GridSide::right}};
  tube.time = 0.3;
  tube.stiffness = 700;
  scene.seams = {between, tube};
  return scene;
}

// The left column turns in a loop, the right one flies and turns, a point of the lower row goes straight and
// is free for a while; the upper corners stay.
inline Scene withPinMotion(Scene scene) {
  ClothSettings& cloth = scene.cloths[0];
  const int right = cloth.numWidthPoints - 1, last = cloth.numHeightPoints - 1, middle = right / 2;
  const GridRange leftPins{{0, 0}, {0, last - 1}}, rightPins{{right, 0}, {right, last - 1}};
  cloth.pinned = {GridPoint{0, last}, GridPoint{right, last}, leftPins, rightPins, GridPoint{middle, 0}};
  PinMotion turning, flying, straight;
  turning.keys = {{.t = 0, .position = std::nullopt, .rotation = {}},
                  {.t = 0.08, .position = std::nullopt, .rotation = {30, 200, -50}}};
  turning.loop = true;
  turning.pinned = {leftPins};
  flying.keys = {{.t = 0.01, .position = std::nullopt, .rotation = {}},
                 {.t = 0.1, .position = Vec3d{0.7, 0.6, 0.4}, .rotation = {0, 90, 0}},
                 {.t = 0.15, .position = Vec3d{0.9, 0.5, 0.1}, .rotation = {0, 90, 90}}};
  flying.interpolation = Interpolation::cubic;
  flying.release = 0.12;
  flying.pinned = {rightPins};
  straight.keys = {{.t = 0, .position = std::nullopt, .rotation = {}},
                   {.t = 0.01, .position = std::nullopt, .rotation = {}, .free = true},
                   {.t = 0.03, .position = Vec3d{0.5, 0.1, 0.2}, .rotation = {}},
                   {.t = 0.3, .position = Vec3d{0.5, 0.3, 0.8}, .rotation = {}}};
  straight.pinned = {GridPoint{middle, 0}};
  cloth.pinMotion = {turning, flying, straight};
  return scene;
}

// Each cloth with motions of its own.
inline Scene twoClothsWithPinMotion(Scene scene) {
  scene = twoCloths(withPinMotion(scene));
  ClothSettings& second = scene.cloths[1];
  second.pinned = {GridSide::top, GridPoint{3, second.numHeightPoints - 1}};
  second.pinMotion.resize(1);
  second.pinMotion[0].pinned = {GridPoint{3, second.numHeightPoints - 1}};
  return scene;
}

// A sheet that falls on a tight one just below it: contacts everywhere, a twentieth of a second later.
inline Scene layeredSheets(int n, SelfCollision mode) {
  Scene scene = withLimiter(sheetScene(n));
  scene.solver.selfCollision = mode;
  scene.cloths[0].thickness = 0.49 / (n - 1);
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[0].pinned = {GridSide::top, GridSide::bottom};
  scene.cloths[1].position = {0.03, 1.4 / (n - 1), 0.02};
  scene.cloths[1].rotation = {0, 9, 0};
  return scene;
}

// Thicker than its spacing: neighbours know each other by their place, and have more candidates than they
// remember.
inline Scene thick(Scene scene) {
  for (ClothSettings& cloth : scene.cloths) cloth.thickness *= 5;
  return scene;
}

// A mesh that hangs from a bar which swings and turns, in the wind, over a ball, and folds over a second one.
inline Scene meshWithEverything(int n, SelfCollision mode) {
  Scene scene = withLimiter(withWind(meshScene({.columns = n, .rows = n, .edge = 1.0 / n, .disorder = 0.2})));
  ClothSettings& cloth = scene.cloths[0];
  cloth.rotation = {-70, 0, 0};
  cloth.position = {0, 0.4, 0.5};
  cloth.thickness = 1.2 / n;
  cloth.pinned = {GroupPin{"top"}, VertexPin{0}};
  cloth.stiffnessMap = {{{GroupPin{"bottom"}}, 2, 3}};
  PinMotion motion;
  motion.keys = {{.t = 0, .position = std::nullopt, .rotation = {}},
                 {.t = 0.2, .position = Vec3d{0.6, 0.8, 0.3}, .rotation = {40, 30, 0}}};
  motion.pinned = {GroupPin{"top"}};
  cloth.pinMotion = {motion};
  scene.colliders = {Sphere{.origin = {0.5, 0.35, 0.1}, .radius = 0.2, .motion = std::nullopt}};
  scene.solver.selfCollision = mode;
  scene.cloths.push_back(cloth);
  scene.cloths[1].position = {0.1, 0.45, 0.5};
  scene.cloths[1].pinMotion.clear();
  scene.cloths.push_back(sheetScene(n / 2).cloths[0]);
  scene.cloths[2].ks = 200;
  return scene;
}

// Of a material, so that it has a membrane, and bends over hinges.
inline Scene meshOfMaterial(int n) {
  Scene scene = withWind(meshScene({.columns = n, .rows = n, .edge = 1.0 / n, .disorder = 0.2}));
  scene.cloths[0].ks.reset();
  scene.cloths[0].material = Material{.stretch = 100, .stretchWarp = 150, .shear = 20, .bend = 1e-4};
  scene.cloths[0].shrink = 0.02;
  scene.cloths[0].stiffnessMap = {{{GroupPin{"bottom"}}, 3, 5}, {{GroupPin{"middle"}}, 0.5, 0}};
  scene.cloths[0].pinned = {GroupPin{"top"}};
  scene.cloths[0].rotation = {-60, 10, 0};
  return scene;
}

// Pulled apart by its weight and what moves its pins, in triangles that fall on each other.
inline Scene tornMesh(int n) {
  Scene scene = meshOfMaterial(n);
  scene.cloths[0].stiffnessMap.clear();
  scene.cloths[0].tearStrain = 0.012;
  return scene;
}

// Blown up from below, shrunk, of two kinds of threads, and torn from its pins.
inline Scene garment(int n) {
  Scene scene = vertical(materialScene(n));
  ClothSettings& cloth = scene.cloths[0];
  cloth.material->stretchWarp = 2 * cloth.material->stretch;
  cloth.material->bendWarp = 0.5 * cloth.material->bend;
  cloth.pressure = 2;
  cloth.shrink = 0.1;
  cloth.tearStrain = 0.02;
  return scene;
}

// In implicit steps, as few and as short iterations as still pass through everything.
inline Scene implicitly(Scene scene) {
  scene.solver.integrator = Integrator::implicit;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  scene.solver.newtonSteps = 2;
  scene.solver.cgIterations = 3;
  return scene;
}

// As solved as lets most of these steps be of second order.
inline Scene inSecondOrder(Scene scene) {
  scene = implicitly(std::move(scene));
  scene.solver.integrator = Integrator::bdf2;
  scene.solver.newtonSteps = 3;
  scene.solver.tolerance = 0.5;
  return scene;
}

// On legs that walk, and on another body whose shapes end soon and that a motion turns besides.
inline Scene withBodies(Scene scene) {
  MeshCollider walk{
      .file = "assets/meshes/walk/walk_%02d.obj", .origin = {0.4, 0.52, 0.2}, .scale = 0.6, .cells = 24};
  walk.shapes = 5;
  walk.shapesPerSecond = 60;
  MeshCollider other = walk;
  other.origin = {0.8, 0.86, 0.45};
  other.rotation = {80, 0, 0};
  other.shapesPerSecond = 30;
  other.motion = Motion{.keys = {{0, other.origin, {}}, {0.2, {0.7, 0.91, 0.45}, {0, 90, 0}}}};
  scene.colliders = {walk, other};
  return scene;
}

struct NamedScene {
  std::string name;
  Scene scene;
};

inline std::vector<NamedScene> comparedScenes(int n) {
  return {{"pinned", vertical(sheetScene(n))},
          {"falling flat", sheetScene(n)},
          {"limiter", withLimiter(vertical(sheetScene(n)))},
          {"wind and attractors", withAttractors(withWind(vertical(sheetScene(n))))},
          {"colliders", withColliders(vertical(sheetScene(n)))},
          {"shapes", withShapes(vertical(sheetScene(n)), FrictionLaw::cs184)},
          {"shapes, coulomb", withShapes(withLimiter(vertical(sheetScene(n))), FrictionLaw::coulomb)},
          {"spheres and planes, coulomb", withCoulomb(withColliders(vertical(sheetScene(n))))},
          {"meshes", withMeshes(vertical(sheetScene(n)))},
          {"meshes in long steps, coulomb", inLongSteps(withCoulomb(withMeshes(vertical(sheetScene(n)))))},
          {"bodies", withBodies(sheetScene(n))},
          {"bodies in long steps, coulomb", inLongSteps(withCoulomb(withBodies(sheetScene(n))))},
          {"long steps", inLongSteps(withColliders(vertical(sheetScene(n))))},
          {"shapes in long steps", inLongSteps(withShapes(vertical(sheetScene(n)), FrictionLaw::cs184))},
          {"everything", withWind(withColliders(withLimiter(vertical(sheetScene(n)))))},
          {"stiffness reference", stiffnessReferenceScene(n)},
          {"material", materialScene(n)},
          {"material with everything", withWind(withColliders(withLimiter(vertical(materialScene(n)))))},
          {"garment", garment(n)},
          {"averaged self-collision", layeredSheets(n, SelfCollision::averaged)},
          {"robust self-collision", withWind(withColliders(layeredSheets(n, SelfCollision::robust)))},
          {"thick averaged self-collision", thick(layeredSheets(n / 2, SelfCollision::averaged))},
          {"thick robust self-collision", thick(layeredSheets(n / 2, SelfCollision::robust))},
          {"pins that move through other cloth", withPinMotion(layeredSheets(n, SelfCollision::robust))},
          {"two cloths", twoCloths(withLimiter(withWind(vertical(sheetScene(n)))))},
          {"seams", withSeams(twoCloths(withLimiter(withWind(vertical(sheetScene(n))))))},
          {"seams and robust self-collision", withSeams(layeredSheets(n, SelfCollision::robust))},
          {"mesh with everything", meshWithEverything(n / 2, SelfCollision::robust)},
          {"mesh with everything, averaged", meshWithEverything(n / 2, SelfCollision::averaged)},
          {"mesh of a material with attractors", withAttractors(meshOfMaterial(n / 2))},
          {"pin motion", withPinMotion(vertical(sheetScene(n)))},
          {"everything with pin motion",
           withPinMotion(withWind(withColliders(withLimiter(vertical(sheetScene(n))))))},
          {"two cloths with pin motion", twoClothsWithPinMotion(withLimiter(vertical(sheetScene(n))))}};
}

// Those of them in which most comes together, for what has shaders of its own: llvmpipe takes longer to
// compile than to run them.
inline std::vector<NamedScene> fullestScenes(int n) {
  const std::set<std::string> names{"shapes, coulomb",
                                    "meshes in long steps, coulomb",
                                    "bodies",
                                    "stiffness reference",
                                    "material with everything",
                                    "garment",
                                    "thick averaged self-collision",
                                    "pins that move through other cloth",
                                    "seams and robust self-collision",
                                    "mesh with everything",
                                    "mesh of a material with attractors",
                                    "everything with pin motion",
                                    "two cloths with pin motion"};
  std::vector<NamedScene> scenes = comparedScenes(n);
  std::erase_if(scenes, [&](const NamedScene& scene) { return !names.contains(scene.name); });
  if (scenes.size() != names.size())
    throw std::logic_error("fullestScenes() names a scene that is not compared");
  return scenes;
}

// The same for implicit steps. They cost dozens of explicit ones, and what is fused or not is no question to
// them.
inline std::vector<NamedScene> implicitScenes(int n) {
  return {
      {"implicit", implicitly(vertical(sheetScene(n)))},
      {"implicit, a material with everything",
       implicitly(withAttractors(withWind(withColliders(withLimiter(vertical(materialScene(n)))))))},
      {"implicit, bodies", implicitly(withCoulomb(withBodies(materialScene(n))))},
      {"implicit, robust self-collision and pin motion",
       implicitly(withPinMotion(layeredSheets(n, SelfCollision::robust)))},
      {"implicit, seams and a rest length table",
       implicitly(withSeams(twoCloths(withLimiter(withWind(vertical(sheetScene(n)))))))},
      {"bdf2, seams of a material",
       inSecondOrder(withSeams(twoCloths(withAttractors(vertical(materialScene(n))))))},
      {"implicit, a mesh with everything", implicitly(meshWithEverything(n / 2, SelfCollision::averaged))},
      {"bdf2, a material with everything",
       inSecondOrder(withAttractors(withWind(withColliders(withLimiter(vertical(materialScene(n)))))))},
      {"bdf2, a mesh of a material with attractors",
       inSecondOrder(withAttractors(withLimiter(meshOfMaterial(n / 2))))}};
}

inline Scene everythingScene(int n) { return withWind(withColliders(withLimiter(vertical(sheetScene(n))))); }

}  // namespace clothsim::test

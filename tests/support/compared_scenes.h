// The scenes that the two backends are compared on: each pass of a step takes part in one of them.
#pragma once

#include <string>
#include <vector>

#include "support/test_scenes.h"

namespace clothsim::test {

inline Scene withWind(Scene scene) {
  scene.wind = Wind{.velocity = {1, 0, 3}, .gust = {.strength = 1, .frequency = 2, .seed = 3}, .lift = 0.5};
  scene.airResistance = 1e-3;
  return scene;
}

inline Scene withLimiter(Scene scene) {
  scene.solver.strainLimit = 0.1;
  return scene;
}

// A sphere that flies and turns through the sheet's place, a resting one, a floor and a wall.
inline Scene withColliders(Scene scene) {
  Motion motion;
  motion.keys = {{0, {0.5, 0.5, -0.3}, {0, 0, 0}}, {0.2, {0.5, 0.5, 0.1}, {0, 90, 0}}};
  scene.colliders = {
      Sphere{.origin = {0.5, 0.5, -0.3}, .radius = 0.2, .friction = 0.3, .motion = motion},
      Plane{.point = {0, 0.02, 0}, .normal = {0, 1, 0}, .friction = 0.5, .motion = std::nullopt},
      Sphere{.origin = {0.2, 0.8, 0.1}, .radius = 0.15, .friction = 0.9, .motion = std::nullopt},
      Plane{.point = {0, 0, 0.3}, .normal = {0.1, 0, -1}, .friction = 0.1, .motion = std::nullopt}};
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

inline Scene twoCloths(Scene scene) {
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].numWidthPoints = 7;
  scene.cloths[1].orientation = Orientation::horizontal;
  scene.cloths[1].pinned.clear();
  scene.cloths[1].damping = 1;
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
          {"wind", withWind(vertical(sheetScene(n)))},
          {"colliders", withColliders(vertical(sheetScene(n)))},
          {"everything", withWind(withColliders(withLimiter(vertical(sheetScene(n)))))},
          {"stiffness reference", stiffnessReferenceScene(n)},
          {"two cloths", twoCloths(withLimiter(withWind(vertical(sheetScene(n)))))}};
}

}  // namespace clothsim::test

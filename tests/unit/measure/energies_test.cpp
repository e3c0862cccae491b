#include "measure/energies.h"

#include <gtest/gtest.h>

#include "measure/energy_watch.h"
#include "solver/solver.h"
#include "support/scene_text.h"

namespace clothsim {
namespace {

// A horizontal sheet of 3 x 3 points, 1 m wide, one kilogram.
Scene sheet() {
  Scene scene;
  ClothSettings& cloth = scene.cloths[0];
  cloth.numWidthPoints = cloth.numHeightPoints = 3;
  cloth.mass = 1;
  cloth.ks = 100;
  return scene;
}

Energies energiesOf(const Scene& scene, const State& state, const Cuts& cuts = {}) {
  const Cloth cloth(scene);
  return energies(cloth, cloth.springs(), scene, cuts, state);
}

TEST(Energies, OfTheStartAreZero) {
  const Scene scene = sheet();
  const Energies start = energiesOf(scene, initialState(Cloth(scene), scene));
  EXPECT_NEAR(start.total(), 0, 1e-9);
  EXPECT_NEAR(start.maxStrain, 0, 1e-6);
}

TEST(Energies, OfALiftedSheetAreMassTimesGravityTimesHeight) {
  const Scene scene = sheet();
  State state = initialState(Cloth(scene), scene);
  for (Particle4& x : state.positions) x.y += 2;
  const Energies lifted = energiesOf(scene, state);
  EXPECT_NEAR(lifted.gravity, 1 * 9.8 * 2, 1e-5);
  EXPECT_NEAR(lifted.springs, 0, 1e-6);
}

TEST(Energies, OfAMovingSheetAreHalfItsMassTimesSpeedSquared) {
  const Scene scene = sheet();
  State state = initialState(Cloth(scene), scene);
  for (Particle4& v : state.velocities) v.z = 3;
  EXPECT_NEAR(energiesOf(scene, state).kinetic, 0.5 * 1 * 9, 1e-5);
}

TEST(Energies, OfAStretchedSheetAreThoseOfItsSprings) {
  Scene scene = sheet();
  scene.cloths[0].enableShearing = scene.cloths[0].enableBending = false;
  State state = initialState(Cloth(scene), scene);
  for (Particle4& x : state.positions) x.x *= 1.2f;
  // Six springs along x, 0.5 m at rest: 1/2 k (0.1 m)^2 each.
  const Energies stretched = energiesOf(scene, state);
  EXPECT_NEAR(stretched.springs, 6 * 0.5 * 100 * 0.01, 1e-5);
  EXPECT_NEAR(stretched.maxStrain, 0.2, 1e-6);
}

TEST(Energies, DoNotCountSpringsThatAreCut) {
  const Scene scene = sheet();
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  for (std::size_t i = 0; i < 9; ++i)
    if (i % 3 == 2) state.positions[i].x += 5;  // the right column flies away
  Cuts cuts;
  ASSERT_TRUE(cutAlong(cuts, cloth, 0, {1.5, -1}, {1.5, 3}));
  EXPECT_NEAR(energiesOf(scene, state, cuts).springs, 0, 1e-6);
  EXPECT_NEAR(energiesOf(scene, state, cuts).maxStrain, 0, 1e-6);
  EXPECT_GT(energiesOf(scene, state).maxStrain, 5);
}

TEST(FactsOfAParticle, AreThoseOfItsMostStrainedSpringWithItsSign) {
  const Scene scene = sheet();
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  state.positions[8].x -= 0.1f;  // the corner: its spring to the left is 0.4 m instead of 0.5 m
  state.velocities[8].z = 3;
  const std::vector<Spring> springs = cloth.springs();
  const ParticleFacts corner = factsOf(8, cloth, springs, {}, state);
  EXPECT_NEAR(corner.strain, -0.2, 1e-5);
  EXPECT_NEAR(corner.force, -10, 1e-3) << "100 N/m and 0.1 m";
  EXPECT_NEAR(corner.speed, 3, 1e-6);
  EXPECT_NEAR(factsOf(0, cloth, springs, {}, state).strain, 0, 1e-5);
  Cuts cuts;
  ASSERT_TRUE(cutAlong(cuts, cloth, 0, {1.5, -1}, {1.5, 3}));
  EXPECT_GT(factsOf(8, cloth, springs, cuts, state).strain, -0.2) << "the spring to the left is cut";
}

// A sheet of 1 kg at a height of 0.3 m less than it began with has 2.9 J to move with.
TEST(EnergyWatch, SeesWhatFallingHasNotGiven) {
  const Scene scene =
      test::sceneOf(R"({"cloth": {"num_width_points": 9, "num_height_points": 9, "ks": 100, "density": 1}})");
  const Cloth cloth(scene);
  const State start = initialState(cloth, scene);
  State fallen = start;
  for (Particle4& x : fallen.positions) x.y -= 0.3f;
  EnergyWatch watch(cloth, scene, start);
  watch.add(1, cloth, fallen, 2.9);
  EXPECT_FALSE(watch.gain());
  watch.add(2, cloth, fallen, 6);
  watch.add(3, cloth, fallen, 7);
  ASSERT_TRUE(watch.gain());
  EXPECT_EQ(watch.gain()->frame, 2);
  EXPECT_EQ(watch.gain()->kinetic, 7);
  EXPECT_NEAR(watch.gain()->fallen, 0.3 * 9.8, 0.01);

  Scene windy = scene;
  windy.wind.emplace();
  EnergyWatch driven(cloth, windy, start);
  driven.add(1, cloth, fallen, 100);
  EXPECT_FALSE(driven.gain()) << "the wind may have given it";
}

}  // namespace
}  // namespace clothsim

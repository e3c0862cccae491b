// Hands on the cloth, on the CPU: what is held, pinned, cut and blown at does what a person expects.
#include "solver/interaction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/measure.h"
#include "measure/measure_contacts.h"
#include "solver/cpu/cpu_solver.h"
#include "support/compared_scenes.h"
#include "support/grabs.h"

namespace clothsim {
namespace {

double distance(Vec3d a, Vec3d b) { return std::sqrt(dot(a - b, a - b)); }
Vec3d placeIn(const State& state, std::uint32_t particle) {
  const Particle4& x = state.positions[particle];
  return Vec3f{x.x, x.y, x.z}.cast<double>();
}

// 9 x 9 points hanging from two corners; column, row.
class InteractionTest : public testing::Test {
 protected:
  Scene scene_ = test::vertical(test::sheetScene(9));
  static constexpr std::uint32_t low = 4;  // the middle of the lower edge
};

TEST_F(InteractionTest, BringsTheHeldParticleToItsTargetAtAnyStrength) {
  for (const double strength : {1e4, 1e12, 1e300}) {
    for (const int steps : {1, 30}) {
      Scene scene = scene_;
      scene.solver.simulationSteps = steps;
      scene.cloths[0].ks = steps == 1 ? 50 : 5000;
      const Cloth cloth(scene);
      CpuSolver<float> solver(cloth, scene);
      const Vec3d target{0.5, 0.3, 0.4};
      solver.setInteraction(test::grabTo(solver, cloth, scene, low, target, strength));
      solver.step(90 * steps);
      EXPECT_EQ(solver.divergence(), std::nullopt) << strength << ", " << steps;
      // A soft hand gives way: it needs g / w^2 at least.
      EXPECT_LT(distance(placeIn(solver.state(), low), target), strength > 1e6 ? 1e-5 : 0.15)
          << strength << ", " << steps;
    }
  }
}

TEST_F(InteractionTest, OfNoStrengthDoesNothingToSpeakOf) {
  const Cloth cloth(scene_);
  CpuSolver<float> held(cloth, scene_), free(cloth, scene_);
  held.setInteraction(test::grabTo(held, cloth, scene_, low, {0.5, 0.3, 1}, 1e-12));
  held.step(300);
  free.step(300);
  EXPECT_LT(distance(placeIn(held.state(), low), placeIn(free.state(), low)), 1e-6);
}

// x = (1 + w t) exp(-w t) from the goal, for a particle that nothing else moves.
TEST_F(InteractionTest, IsCriticallyDamped) {
  const Scene scene = test::springScene(1, 1e-9, 1, 1e-5, Integrator::euler);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  constexpr double w = 10, t = 0.2;
  Interaction interaction = test::grabTo(solver, cloth, scene, 1, {0, 0, 0}, w * w);
  const Vec3d start = interaction.grab->from;
  interaction.grab->from = interaction.grab->to = start + Vec3d{0.2, 0, 0};
  solver.setInteraction(interaction);
  solver.step(20'000);
  EXPECT_NEAR(0.2 - solver.position(1).x, 0.2 * (1 + w * t) * std::exp(-w * t), 0.2 * 2e-4);
}

TEST_F(InteractionTest, IsNotLeftBehindByAHandInMotion) {
  const Scene scene = test::springScene(1, 1e-9, 1, 1e-3, Integrator::euler);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  Interaction interaction = test::grabTo(solver, cloth, scene, 1, {0, 0, 0}, 1e4);
  interaction.grab->to = interaction.grab->from + Vec3d{1, 0, 0};
  interaction.grab->steps = 1000;
  solver.setInteraction(interaction);
  solver.step(500);
  EXPECT_NEAR(solver.position(1).x, 0.5, 1e-3);
}

TEST_F(InteractionTest, TakesTheNeighboursAlongEverSofterWithTheDistance) {
  const Cloth cloth(scene_);
  CpuSolver<float> solver(cloth, scene_);
  const Interaction interaction = test::grabTo(solver, cloth, scene_, 4 * 9 + 4, {0.5, 0.5, 0.3}, 1e4, 0.3);
  EXPECT_EQ(interaction.grab->columns, 5u);
  EXPECT_EQ(interaction.grab->rows, 5u);
  const auto& points = *interaction.grab->points;
  EXPECT_EQ(points[12].weight, 1);
  EXPECT_EQ(points[12].offset, Vec3f());
  EXPECT_GT(points[13].weight, points[14].weight);
  EXPECT_EQ(points[0].weight, 0) << "beyond the radius";
  EXPECT_NEAR(points[13].offset.x, 0.125, 1e-6);
  CpuSolver<float> alone(cloth, scene_);
  alone.setInteraction(test::grabTo(alone, cloth, scene_, 4 * 9 + 4, {0.5, 0.5, 0.3}, 1e4, 0));
  solver.setInteraction(interaction);
  solver.step(60);
  alone.step(60);
  EXPECT_GT(solver.position(4 * 9 + 5).z, alone.position(4 * 9 + 5).z + 0.02f);
}

TEST_F(InteractionTest, IsNeverFasterThanAHand) {
  const Cloth cloth(scene_);
  CpuSolver<float> solver(cloth, scene_);
  Interaction interaction = test::grabTo(solver, cloth, scene_, low, {0.5, -40, 0}, 1e12);
  interaction.grab->steps = 1;
  solver.setInteraction(interaction);
  solver.step(1);
  const Vec3f v = solver.velocity(low);
  EXPECT_NEAR(std::sqrt(dot(v, v)), 30, 1e-3);
}

TEST_F(InteractionTest, CannotMoveAPin) {
  const Cloth cloth(scene_);
  CpuSolver<float> solver(cloth, scene_);
  const std::uint32_t pin = 8 * 9;
  const Vec3f before = solver.position(pin);
  solver.setInteraction(test::grabTo(solver, cloth, scene_, pin, {3, 3, 3}, 1e6, 0.3));
  solver.step(30);
  EXPECT_EQ(solver.position(pin), before);
}

TEST_F(InteractionTest, LeavesTheLastWordToColliders) {
  Scene scene = scene_;
  scene.colliders = {
      Sphere{.origin = {0.5, 0.2, 0.5}, .radius = 0.2, .friction = 0.5, .motion = std::nullopt}};
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.setInteraction(test::grabTo(solver, cloth, scene, low, {0.5, 0.2, 0.5}, 1e12));
  solver.step(300);
  EXPECT_GE(distance(placeIn(solver.state(), low), {0.5, 0.2, 0.5}), 0.2 - 1e-6);
}

TEST_F(InteractionTest, PinsAParticleWhereItIsAndGivesTheMassBack) {
  const Cloth cloth(scene_);
  CpuSolver<float> solver(cloth, scene_);
  solver.step(60);
  const Vec3f place = solver.position(low);
  solver.setPin(low, true);
  solver.step(60);
  EXPECT_EQ(solver.position(low), place);
  const State pinned = solver.state();
  EXPECT_EQ(pinned.positions[low].w, 0);
  CpuSolver<float> other(cloth, scene_);
  other.setState(pinned);
  for (CpuSolver<float>* each : {&solver, &other}) {
    each->setPin(low, false);
    each->setPin(8 * 9, false);  // of the scene
    each->step(60);
  }
  EXPECT_EQ(stateHash(solver.state()), stateHash(other.state()));
  EXPECT_EQ(solver.state().positions[low].w, pinned.positions[low + 1].w);
  EXPECT_LT(solver.position(low).y, place.y);
  EXPECT_LT(solver.position(8 * 9).y, 0.999f) << "falls";
}

TEST_F(InteractionTest, TakesPinsOffTheirPathForGood) {
  Scene scene = test::withPinMotion(scene_);
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const std::uint32_t onPath = 3 * 9;  // of the left column
  solver.step(60);
  const Vec3f place = solver.position(onPath);
  solver.setPin(onPath, false);
  solver.setPin(onPath, true);
  const State state = solver.state();
  CpuSolver<float> other(cloth, scene);
  other.setState(state);
  for (CpuSolver<float>* each : {&solver, &other}) {
    each->step(60);
    EXPECT_EQ(each->position(onPath), place);
    each->configure(scene);  // a live edit of something else
    each->step(10);
    EXPECT_EQ(each->position(onPath), place);
  }
  EXPECT_NE(solver.position(9 * 4), test::placeOf(state, 9 * 4)) << "its neighbour goes on";
}

// The lower part of a sheet cut from side to side: free fall.
TEST_F(InteractionTest, LetsWhatIsCutOffFallFreely) {
  for (const bool limited : {false, true}) {
    Scene scene = limited ? test::withLimiter(scene_) : scene_;
    scene.cloths[0].damping = 0;
    const Cloth cloth(scene);
    CpuSolver<float> solver(cloth, scene);
    solver.setCuts(test::cutAcross(cloth, 4.5));
    solver.step(900);
    const State state = solver.state();
    const Measures measures = measure(cloth, scene, state);
    const double h = stepLength(scene.solver);
    double fallen = 0;
    for (std::uint32_t i = 0; i < 45; ++i) fallen += (cloth.positions()[i].y - placeIn(state, i).y) / 45;
    EXPECT_NEAR(fallen, 0.5 * 9.8 * 900 * h * 900 * h, 2e-3) << limited;
    EXPECT_GT(state.positions[8 * 9 + 4].y, 0.7f) << "the rest hangs on";
    EXPECT_LT(measures.maxStrain, 1.0) << "what is cut does not count";
    EXPECT_EQ(solver.divergence(), std::nullopt) << "nor is it watched";
  }
}

// Forces on a torn, crumpled sheet against a sum over the list of what is left.
TEST_F(InteractionTest, FeelsNoForceOfCutSprings) {
  const Cloth cloth(scene_);
  CpuSolver<double> solver(cloth, scene_);
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    const Vec3d x = solver.position(i);
    solver.setPosition(
        i, x + Vec3d{0.01 * std::sin(3.0 * i), 0.02 * std::cos(5.0 * i), 0.03 * std::sin(7.0 * i)});
  }
  const Cuts cuts = test::someCuts(cloth);
  solver.setCuts(cuts);
  std::vector<Vec3d> expected(cloth.particleCount());
  int cut = 0;
  for (const Spring& spring : cloth.springs()) {
    if (isCut(cuts, spring.a, static_cast<SpringSlot>(spring.number % SPRING_SLOTS))) {
      ++cut;
      continue;
    }
    const Vec3d d = solver.position(spring.b) - solver.position(spring.a);
    const double length = std::sqrt(dot(d, d));
    const double rest = cloth.hasRestLengthTable()
                            ? distance(cloth.positions()[spring.a], cloth.positions()[spring.b])
                            : spring.restLength;
    const Vec3d force = (spring.stiffness * (length - rest) / length) * d;
    expected[spring.a] = expected[spring.a] + force;
    expected[spring.b] = expected[spring.b] - force;
  }
  EXPECT_GT(cut, 20);
  const std::vector<Vec3d> forces = solver.forces();
  for (std::uint32_t i = 0; i < forces.size(); ++i) EXPECT_LT(distance(forces[i], expected[i]), 1e-3) << i;
}

// Air moves triangles, not holes: a cloth all of whose triangles are gone feels none.
TEST_F(InteractionTest, FeelsNoAirWhereTrianglesAreGone) {
  Scene scene = test::withWind(scene_);
  scene.airResistance = 0;
  for (bool* kind :
       {&scene.cloths[0].enableStructural, &scene.cloths[0].enableShearing, &scene.cloths[0].enableBending})
    *kind = false;
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  const std::vector<Vec3d> whole = solver.forces();
  solver.setCuts(test::cutAcross(cloth, 3.5));
  const std::vector<Vec3d> torn = solver.forces();
  const auto length = [](Vec3d v) { return std::sqrt(dot(v, v)); };
  EXPECT_EQ(torn[1 * 9 + 4], whole[1 * 9 + 4]) << "away from the cut nothing changes";
  EXPECT_NEAR(length(torn[3 * 9 + 4]) / length(whole[3 * 9 + 4]), 0.5, 0.05) << "three triangles of six";
  solver.setCuts(Cuts(cloth.particleCount(), 63));
  for (const Vec3d force : solver.forces()) EXPECT_EQ(force, Vec3d());
}

// Both edges of a cut that is closed by hand: neighbours across it are non-adjacent particles now.
TEST_F(InteractionTest, KeepsTheTwoEdgesOfACutApart) {
  Scene scene = test::withLimiter(scene_);
  scene.solver.selfCollision = SelfCollision::robust;
  scene.gravity = {0, 0, 0};
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  state.cuts = test::cutAcross(cloth, 4.5);
  // The lower part comes up at the upper one, edge to edge.
  for (std::uint32_t i = 0; i < 45; ++i) state.velocities[i].y = 0.5f;
  CpuSolver<float> solver(cloth, scene);
  solver.setState(state);
  solver.step(600);
  double nearest = 1;
  const State met = solver.state();
  for (std::uint32_t c = 0; c < 9; ++c)
    nearest = std::min(nearest, distance(placeIn(met, 4 * 9 + c), placeIn(met, 5 * 9 + c)));
  EXPECT_GT(nearest, 0.8 * 0.125);
  EXPECT_EQ(measureContacts(cloth, scene, met, 0.1).overlaps, 0u);
}

// Faster than robust self-collision can see: the numbers of a run say so.
TEST_F(InteractionTest, IsCountedWhenItIsTooFastForContacts) {
  Scene scene = test::layeredSheets(9, SelfCollision::robust);
  scene.solver.simulationSteps = 5;
  const Cloth cloth(scene);
  CpuSolver<float> calm(cloth, scene), hasty(cloth, scene);
  hasty.setInteraction(test::grabTo(hasty, cloth, scene, 81 + 40, {0.5, -3, 0.5}, 1e9));
  calm.step(20);
  hasty.step(20);
  EXPECT_EQ(calm.contactCounts().fastSteps, 0u);
  EXPECT_GT(hasty.contactCounts().fastSteps, 0u);
}

TEST_F(InteractionTest, BlowsInFrontOfItsOriginAndNowhereElse) {
  Scene scene = scene_;
  scene.gravity = {0, 0, 0};
  const Cloth cloth(scene);
  for (const double side : {1.0, -1.0}) {
    CpuSolver<double> solver(cloth, scene);
    Interaction interaction;
    interaction.jet = Jet{{0.5, 0.5, -1}, {0, 0, side}, 10, 0.3};
    solver.setInteraction(interaction);
    const std::vector<Vec3d> forces = solver.forces();
    EXPECT_EQ(forces[0], Vec3d()) << "out of the jet";
    const bool inFront = side > 0;
    EXPECT_EQ(forces[4 * 9 + 4].z > 0.5, inFront);
    EXPECT_EQ(forces[4 * 9 + 4] == Vec3d(), !inFront);
    interaction.jet = Jet{{0.5, 0.5, -10}, {0, 0, 2}, 10, 3};
    solver.setInteraction(interaction);
    // Nearly even: rho C_d / 2 A v^2 of a cell, 0.6 * 1.2 * 0.125^2 * 100 N.
    EXPECT_NEAR(solver.forces()[4 * 9 + 4].z, 1.125, 0.01);
  }
}

TEST_F(InteractionTest, BlowsOnTopOfTheWind) {
  Scene scene = test::withWind(scene_);
  const Cloth cloth(scene);
  CpuSolver<double> solver(cloth, scene);
  const std::vector<Vec3d> before = solver.forces();
  Interaction interaction;
  interaction.jet = Jet{{0.5, 0.5, -1}, {0, 0, 1}, 10, 0.3};
  solver.setInteraction(interaction);
  const std::vector<Vec3d> with = solver.forces();
  EXPECT_EQ(with[0], before[0]);
  EXPECT_GT(with[4 * 9 + 4].z, 2 * before[4 * 9 + 4].z);
}

TEST_F(InteractionTest, GoesOnFromASnapshotToTheBit) {
  const Scene scene = test::withPinMotion(test::withWind(scene_));
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  solver.step(50);
  solver.setPin(low, true);
  solver.setCuts(test::someCuts(cloth));
  solver.step(50);
  std::unique_ptr<Snapshot> snapshot = solver.snapshot(nullptr);
  EXPECT_EQ(snapshot->bytes(), 81 * 7 * sizeof(float)) << "without cuts and pins";
  solver.setPin(low, false);
  solver.setCuts({});
  solver.step(70);
  CpuSolver<float> other(cloth, scene);
  std::vector<std::uint64_t> hashes;
  for (CpuSolver<float>* each : {&solver, &other}) {
    each->restore(*snapshot);
    EXPECT_EQ(each->stepIndex(), 100u);
    EXPECT_EQ(each->cuts(), test::someCuts(cloth));
    each->step(70);
    hashes.push_back(stateHash(each->state()));
  }
  CpuSolver<float> fromState(cloth, scene);
  fromState.setState(snapshot->state());
  fromState.step(70);
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], stateHash(fromState.state()));
}

}  // namespace
}  // namespace clothsim

// The order of a step, and what passes may share a sweep.
#include "solver/step_list.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "solver/cpu/cpu_solver.h"
#include "support/compared_scenes.h"
#include "support/test_scenes.h"

namespace clothsim {
namespace {

// The names of the passes in order; a run of the same one once.
std::string order(const PassList& list) {
  std::string names, last;
  for (const PassCall& call : list.passes) {
    const std::string name = nameOf(call.pass);
    if (name != last) names += (names.empty() ? "" : ", ") + name;
    last = name;
  }
  return names;
}

Scene sheet() { return test::sheetScene(9); }
Scene implicitSheet() {
  Scene scene = sheet();
  scene.solver.integrator = Integrator::implicit;
  scene.solver.newtonSteps = 2;
  scene.solver.cgIterations = 3;
  return scene;
}
Scene withBall(Scene scene) {
  scene.colliders = {Sphere{}};
  return scene;
}
PassList stepOf(const Scene& scene) {
  const Cloth cloth(scene);
  return makeStep(scene, cloth, mostLevels(cloth, {}));
}

TEST(StepList, OfCs184CollidesAndLimitsAfterTheIntegration) {
  Scene scene = withBall(test::withLimiter(sheet()));
  EXPECT_EQ(order(stepOf(scene)), "forces, integrate, collide, limit, watch limit");
  scene.solver.selfCollision = SelfCollision::averaged;
  scene.cloths[0].thickness = 0.01;
  EXPECT_EQ(order(stepOf(scene)),
            "forces, integrate, check hash, build hash, find candidates, resolve contacts, collide, limit, "
            "watch limit");
}

TEST(StepList, LetsRobustContactsMoveParticlesAfterTheLimit) {
  Scene scene = withBall(test::withLimiter(sheet()));
  scene.solver.selfCollision = SelfCollision::robust;
  EXPECT_EQ(order(stepOf(scene)),
            "forces, integrate, limit, watch limit, collide, check hash, build hash, find candidates, "
            "resolve contacts, check motion, build hash, find candidates, clamp motion, collide");
}

TEST(StepList, RepeatsLimitsAndCollidersWhereACollidersTravels) {
  Scene scene = withBall(test::withLimiter(sheet()));
  Sphere sphere;
  sphere.motion = Motion{{{0, {0, 0, 0}, {}}, {1, {1, 0, 0}, {}}}, false};
  scene.colliders = {sphere};
  ASSERT_EQ(contactRounds(scene), 3);
  EXPECT_EQ(order(stepOf(scene)),
            "forces, integrate, collide, limit, watch limit, collide, limit, watch limit, collide, limit, "
            "watch limit, collide");
}

TEST(StepList, SolvesAnImplicitStepByNewtonAndConjugateGradients) {
  const PassList step = stepOf(implicitSheet());
  const std::string precondition = "restrict, solve coarsest, prolong, ",
                    iterate = "update direction, multiply, sum p.Hp, update solution, ",
                    again = iterate + precondition + "sum r.z, ",
                    newton = "elastic forces, linearize, " + precondition + "sum r.z, " + again + again +
                             iterate + "try lengths, sum energies, accept, measure update, ";
  EXPECT_EQ(order(step),
            "begin, find centers, coarsen, invert dense, " + newton + newton + "end, count step");
  ASSERT_EQ(step.loops.size(), 3u);
  EXPECT_EQ(step.loops[0].times, 2u) << "the last iteration needs no new direction";
  EXPECT_EQ(step.loops[1].times, 1u) << "the preconditioner is made before the first Newton step";
  EXPECT_EQ(step.loops[2].times, 2u);
  const std::string onABall = order(stepOf(withBall(implicitSheet())));
  EXPECT_NE(onABall.find("update solution, stop at planes, try lengths, "), std::string::npos) << onABall;
}

TEST(StepList, KeepsTheMatricesOfTheLevelsFromTheStepBefore) {
  const PassList step = stepOf(implicitSheet()), keeping = keepingLevels(step);
  const std::string made = order(step);
  EXPECT_TRUE(made.starts_with("begin, find centers, coarsen, invert dense, ")) << made;
  EXPECT_EQ(order(keeping), "begin, find centers, " + made.substr(made.find("elastic forces")));
  ASSERT_EQ(keeping.loops.size(), step.loops.size());
  for (std::size_t i = 0; i < step.loops.size(); ++i)
    EXPECT_EQ(keeping.passes[keeping.loops[i].first], step.passes[step.loops[i].first]);
}

// Each array that a pass reads is one of the state, or an earlier pass has written it.
TEST(StepList, ReadsNothingBeforeItIsWritten) {
  std::vector<Scene> scenes{sheet(), implicitSheet(), withBall(test::withLimiter(sheet())),
                            withBall(implicitSheet())};
  for (const SelfCollision mode : {SelfCollision::averaged, SelfCollision::robust}) {
    scenes.push_back(scenes[3]);
    scenes.back().solver.selfCollision = mode;
    scenes.back().cloths[0].thickness = 0.01;
  }
  scenes.push_back(scenes[3]);
  scenes.back().solver.selfCollision = SelfCollision::contact;
  for (const Scene& scene : scenes) {
    // Scalars, histories and elastic slips are kept from step to step. Wind and planes that are not there are
    // not read. The first direction ignores what was there. The first coarse level is not made of a finer
    // one. Contact reads safe positions once a step goes on from them, and of the pairs only those that it
    // found.
    Arrays known{Array::positions,  Array::velocities,    Array::hash,        Array::contactFlags,
                 Array::watch,      Array::airBlocks,     Array::planes,      Array::contactBlocks,
                 Array::directions, Array::coarseBlocks,  Array::centers,     Array::scalars,
                 Array::histories,  Array::safePositions, Array::keptMotions, Array::touching,
                 Array::pairForces, Array::elasticSlips,  Array::pairSlips};
    for (const PassCall& call : stepOf(scene).passes) {
      const PassTraits& traits = call.traits();
      for (int i = 0; i < ARRAY_COUNT; ++i) {
        const auto array = static_cast<Array>(i);
        const bool isRead = (traits.gathers | traits.reads).contains(array);
        EXPECT_TRUE(!isRead || known.contains(array)) << traits.name << " reads " << nameOf(array);
      }
      known = known | traits.writes;
    }
    EXPECT_TRUE(known.contains(Array::newPositions));
    EXPECT_TRUE(known.contains(Array::newVelocities));
  }
}

TEST(Sweep, TakesNeighbouringPassesThatLookAtTheirOwnRowOnly) {
  const PassList step = stepOf(withBall(test::withLimiter(sheet())));
  EXPECT_EQ(sweepLength(step.passes), 3u);
  EXPECT_EQ(nameOf(std::span(step.passes).first(3)), "forces, integrate, collide");
  EXPECT_EQ(sweepLength(std::span(step.passes).subspan(3)), 1u) << "colours of the limit";
}

TEST(Sweep, EndsBeforeAPassThatReadsItsNeighbours) {
  EXPECT_TRUE(canShareSweep(traitsOf(Pass::elasticForces), traitsOf(Pass::linearize)));
  EXPECT_TRUE(canShareSweep(traitsOf(Pass::accept), traitsOf(Pass::findPlanes)));
  EXPECT_FALSE(canShareSweep(traitsOf(Pass::findPlanes), traitsOf(Pass::coarsen)));
  EXPECT_FALSE(canShareSweep(traitsOf(Pass::accept), traitsOf(Pass::elasticForces))) << "iterates around it";
  EXPECT_FALSE(canShareSweep(traitsOf(Pass::updateDirection), traitsOf(Pass::multiply)));
  EXPECT_FALSE(canShareSweep(traitsOf(Pass::multiply), traitsOf(Pass::updateDirection)))
      << "other rows still read the old directions";
}

TEST(StepList, IsPrintedWithItsLoopsOnce) {
  Scene scene = implicitSheet();
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 3;
  std::string names, line;
  for (std::istringstream lines(describe(stepOf(scene))); std::getline(lines, line);)
    names += line.substr(0, line.find("  ", line.find_first_not_of(' '))) + "\n";
  EXPECT_EQ(names,
            "pass\nbegin\nfind centers, level 0\ncoarsen, level 0\ninvert dense\n"
            "elastic forces\nlinearize\nrestrict, level 0\nsolve coarsest\nprolong, level 0\nsum r.z\n"
            "2 x iteration:\n"
            "  update direction\n  multiply\n  sum p.Hp\n  update solution\n"
            "  restrict, level 0\n  solve coarsest\n  prolong, level 0\n  sum r.z\n"
            "update direction\nmultiply\nsum p.Hp\nupdate solution\n"
            "try lengths\nsum energies\naccept\nmeasure update\n"
            "1 x further Newton step:\n"
            "  elastic forces\n  linearize\n  restrict, level 0\n  solve coarsest\n  prolong, level 0\n"
            "  sum r.z\n"
            "  2 x iteration:\n"
            "    update direction\n    multiply\n    sum p.Hp\n    update solution\n"
            "    restrict, level 0\n    solve coarsest\n    prolong, level 0\n    sum r.z\n"
            "  update direction\n  multiply\n  sum p.Hp\n  update solution\n"
            "  try lengths\n  sum energies\n  accept\n  measure update\n"
            "end\ncount step\n");
}

// Where layer lies upon layer, linear systems that are cut short would keep a step from being solved.
TEST(StepList, TakesLongerSystemsInLateNewtonStepsUnlessTheUserSaysHowLong) {
  Scene scene = implicitSheet();
  scene.solver.newtonSteps = 14;
  const auto iterationsOf = [&](bool automatic) {
    scene.solver.cgIterations = 4;
    scene.solver.cgIterations.automatic = automatic;
    const PassList step = stepOf(scene);
    return std::ranges::count(step.passes, Pass::updateDirection, &PassCall::pass);
  };
  EXPECT_EQ(iterationsOf(false), 14 * 4);
  EXPECT_EQ(iterationsOf(true), 11 * 4 + 3 * 20);
}

TEST(StepList, KnowsHowFarAClosedGateReaches) {
  const PassList step = stepOf(implicitSheet());
  ASSERT_EQ(step.gateEnds.size(), step.passes.size());
  const auto gateOf = [&](std::size_t k) { return step.passes[k].traits().gate; };
  for (std::size_t k = 0; k < step.passes.size(); ++k) {
    std::size_t end = k + 1;
    while (end < step.passes.size() && gateOf(end) >= gateOf(k)) ++end;
    EXPECT_EQ(step.gateEnds[k], end) << k;
  }
  EXPECT_TRUE(
      std::ranges::any_of(step.passes, [](const PassCall& c) { return c.traits().gate == Gate::system; }));
}

TEST(StepList, NamesTheTimesOfTheCpu) {
  const Scene scene = withBall(test::withLimiter(test::vertical(test::sheetScene(16))));
  const Cloth cloth(scene);
  CpuSolver<float> solver(cloth, scene);
  const std::vector<PassTime> times = solver.timePasses(3);
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[0].name, "forces, integrate, collide");
  EXPECT_EQ(times[1].name, "limit");
  EXPECT_EQ(times[2].name, "watch limit");
  for (const PassTime& time : times) EXPECT_GT(time.seconds, 0) << time.name;
  EXPECT_EQ(solver.stepIndex(), 3u);
}

}  // namespace
}  // namespace clothsim

#include "cloth/material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "scene_io/scene_io.h"
#include "scene_io/solver_defaults.h"
#include "support/scene_text.h"

namespace clothsim {
namespace {

using test::sceneOf;

TEST(MaterialPreset, IsReadByNameAndWrittenInFull) {
  for (const std::string& name : materialPresetNames()) {
    const Scene scene = sceneOf(R"({"cloth": {"material": ")" + name + R"("}})");
    EXPECT_EQ(scene.cloths[0].material, materialPreset(name));
    EXPECT_FALSE(scene.cloths[0].ks) << "no second stiffness";
    EXPECT_EQ(sceneOf(formatScene(scene)), scene);
  }
}

TEST(Material, BringsCoulombsFrictionAndNoneOfCs184sRules) {
  const Scene scene = sceneOf(R"({"cloth": {"material": "silk"}})");
  EXPECT_EQ(scene.solver.frictionLaw, FrictionLaw::coulomb);
  EXPECT_FALSE(scene.solver.strainLimit);
}

TEST(Material, BringsSelfCollisionThatNothingCrosses) {
  const auto modeOf = [](const char* solver) {
    return sceneOf(std::string(R"({"cloth": {"material": "silk"}, "solver": )") + solver + "}")
        .solver.selfCollision;
  };
  EXPECT_EQ(modeOf("{}"), SelfCollision::contact);
  EXPECT_EQ(modeOf(R"({"integrator": "bdf2"})"), SelfCollision::contact);
  EXPECT_EQ(modeOf(R"({"integrator": "verlet"})"), SelfCollision::robust);
  EXPECT_EQ(modeOf(R"({"self_collision": true})"), SelfCollision::contact);
  EXPECT_EQ(modeOf(R"({"self_collision": true, "integrator": "verlet"})"), SelfCollision::robust);
  EXPECT_EQ(modeOf(R"({"self_collision": false})"), SelfCollision::off);
  Scene scene = sceneOf(R"({"cloth": {"material": "silk"}})");
  setSceneValue(scene, "solver.integrator=verlet");
  EXPECT_EQ(scene.solver.selfCollision, SelfCollision::robust);
  setIntegrator(scene, Integrator::bdf2);
  EXPECT_EQ(scene.solver.selfCollision, SelfCollision::contact);
  EXPECT_EQ(sceneOf(formatScene(scene)), scene);
  scene.solver.selfCollision = SelfCollision::off;
  setIntegrator(scene, Integrator::verlet);
  EXPECT_EQ(scene.solver.selfCollision, SelfCollision::off) << "as it was chosen";
}

TEST(Material, BringsContactToTheOtherClothsToo) {
  const Scene scene = sceneOf(R"({"cloths": [{"material": "silk"}, {"ks": 500}]})");
  EXPECT_EQ(scene.solver.selfCollision, SelfCollision::contact);
}

TEST(Material, BringsContactInsteadOfWhatExplicitStepsHad) {
  const auto modeWithSilk = [](const char* selfCollision) {
    Scene scene =
        sceneOf(std::string(R"({"cloth": {}, "solver": {"self_collision": )") + selfCollision + "}}");
    setSceneValue(scene, "cloth.material=silk");
    return scene.solver.selfCollision;
  };
  EXPECT_EQ(modeWithSilk(R"("robust")"), SelfCollision::contact);
  EXPECT_EQ(modeWithSilk(R"("averaged")"), SelfCollision::contact);
  EXPECT_EQ(modeWithSilk("false"), SelfCollision::off) << "as it was chosen";
}

TEST(Material, BringsTheImplicitIntegratorInAsManyStepsAsItNeeds) {
  const auto isImplicit = [](const Scene& scene) {
    return scene.solver.integrator == Integrator::implicit && scene.solver.simulationSteps.automatic &&
           scene.solver.simulationSteps == 3;
  };
  EXPECT_TRUE(isImplicit(sceneOf(R"({"cloth": {"material": "silk"}})")));
  Scene scene = sceneOf(R"({"cloth": {}, "solver": {"integrator": "euler", "simulation_steps": 7}})");
  setSceneValue(scene, "cloth.material=silk");
  EXPECT_TRUE(isImplicit(scene)) << "what was right for springs is not for silk";
  setSceneValue(scene, "solver.integrator=verlet");
  setSceneValue(scene, "cloth.material=denim");
  EXPECT_EQ(scene.solver.integrator, Integrator::verlet) << "chosen for a material";
  EXPECT_EQ(scene.solver.simulationSteps, stableSteps(scene));
  EXPECT_EQ(sceneOf(formatScene(scene)), scene);
  setSceneValue(scene, "solver.integrator=null");
  EXPECT_TRUE(isImplicit(scene));
  setSceneValue(scene, "cloth.material=null");
  EXPECT_EQ(scene.solver, sceneOf(R"({"cloth": {}})").solver);
}

TEST(Material, TakesStepsOfASixtiethWhereItIsTooStiffToBuckle) {
  const auto stepsOf = [](double bend) {
    Scene scene = sceneOf(R"({"cloth": {"material": "silk"}, "solver": {"frames_per_sec": 60}})");
    scene.cloths[0].material->bend = bend;
    scene.cloths[0].material->stretch = 3000;
    chooseCounts(scene);
    return scene.solver.simulationSteps.count;
  };
  const double density = materialPreset("silk")->density;
  EXPECT_NEAR(bucklingHeight({.density = 0.2, .bend = 0.2 * 9.81 / 7.8373}), 1, 1e-4);
  EXPECT_EQ(stepsOf(1.01 * density * 9.81 / 7.8373), 1) << "a sheet of 1 m";
  EXPECT_EQ(stepsOf(0.99 * density * 9.81 / 7.8373), 4) << "its folds may touch";
}

TEST(Material, TakesShorterStepsWhereSoundInItIsFast) {
  for (const std::string& fabric : materialPresetNames()) {
    Scene scene = sceneOf(R"({"cloth": {"material": "silk"}, "solver": {"frames_per_sec": 60}})");
    scene.cloths[0].material = materialPreset(fabric);
    chooseCounts(scene);
    EXPECT_EQ(scene.solver.simulationSteps.count, fabric == "paper" ? 8 : 4) << fabric;
    scene.solver.selfCollision = SelfCollision::off;
    chooseCounts(scene);
    EXPECT_EQ(scene.solver.simulationSteps.count, fabric == "paper" ? 8 : 2) << fabric;
    scene.cloths[0].width = scene.cloths[0].height = 0.01;
    chooseCounts(scene);
    EXPECT_EQ(scene.solver.simulationSteps.count, fabric == "paper"  ? 8
                                                  : fabric == "silk" ? 2
                                                                     : 1)
        << fabric << " that is too small to buckle";
  }
}

TEST(Material, ReplacesKsWhenItIsSet) {
  Scene scene = sceneOf(R"({"cloth": {"ks": 900, "damping": 1, "thickness": 0.02}})");
  setSceneValue(scene, "cloth.material=denim");
  EXPECT_EQ(scene.cloths[0].material, materialPreset("denim"));
  EXPECT_FALSE(scene.cloths[0].ks);
  setSceneValue(scene, "cloth.material.bend=2e-5");
  Material expected = *materialPreset("denim");
  expected.bend = 2e-5;
  EXPECT_EQ(scene.cloths[0].material, expected);
}

TEST(GiveMaterial, LeavesNothingThatAMaterialTells) {
  Scene scene = sceneOf(R"({"cloth": {"ks": 900, "mass": 2, "damping": 1, "thickness": 0.02}})");
  scene.cloths[0].density = 3;
  giveMaterial(scene.cloths[0], *materialPreset("wool"));
  EXPECT_EQ(sceneOf(formatScene(scene)).cloths, scene.cloths);
}

// On square cells (docs/physics.md): k_d = G, k_s = C11 - G; isotropic at k_s = 2 k_d with Y = 8/3 k_d.
TEST(LatticeStiffness, IsTheKnownOneOnSquares) {
  Material material;
  material.shear = 300;
  material.stretch = 8.0 / 3 * 300;
  const LatticeStiffness k = latticeStiffness(material, 0.01, 0.01);
  EXPECT_NEAR(k.diagonal, 300, 1e-9);
  EXPECT_NEAR(k.alongRow, 600, 1e-9);
  EXPECT_NEAR(k.alongColumn, 600, 1e-9);
  EXPECT_NEAR(k.bendAlongRow, material.bend / 1e-4, 1e-12);
}

// The energy of a cell under a small homogeneous strain is that of the sheet, whatever the cell's shape.
TEST(LatticeStiffness, GivesOblongCellsTheSameModuli) {
  const Material material{.stretch = 1000, .shear = 200};
  const double c11 = 0.5 * (1000 + std::sqrt(1e6 + 4 * 200.0 * 200));
  for (const auto& cell : {std::pair{0.01, 0.01}, {0.012, 0.01}, {0.01, 0.015}}) {
    const double dx = cell.first, dy = cell.second;
    const LatticeStiffness k = latticeStiffness(material, dx, dy);
    const auto energy = [&](double xx, double yy, double xy) {  // strains; per area
      const double l = std::hypot(dx, dy);
      const auto spring = [](double stiffness, double stretch) {
        return 0.5 * stiffness * stretch * stretch;
      };
      const double even = (xx * dx * dx + yy * dy * dy) / l, odd = 2 * xy * dx * dy / l;
      return (spring(k.alongRow, xx * dx) + spring(k.alongColumn, yy * dy) + spring(k.diagonal, even + odd) +
              spring(k.diagonal, even - odd)) /
             (dx * dy);
    };
    EXPECT_NEAR(energy(1e-3, 0, 0), 0.5 * c11 * 1e-6, 1e-12);
    EXPECT_NEAR(energy(0, 1e-3, 0), 0.5 * c11 * 1e-6, 1e-12);
    EXPECT_NEAR(energy(1e-3, 1e-3, 0), (c11 + 200) * 1e-6, 1e-12);
    EXPECT_NEAR(energy(0, 0, 1e-3), 2 * 200 * 1e-6, 1e-12);
  }
}

TEST(SimulationSteps, AreChosenWhenAuto) {
  Scene scene = sceneOf(
      R"({"cloth": {"material": "cotton"}, "solver": {"integrator": "verlet", "simulation_steps": "auto"}})");
  EXPECT_EQ(scene.solver.simulationSteps, stableSteps(scene));
  EXPECT_LE(stepLength(scene.solver), stableStep(scene));
  EXPECT_GT(stepLength(scene.solver) * scene.solver.simulationSteps / (scene.solver.simulationSteps - 1),
            stableStep(scene))
      << "no more than needed";
  EXPECT_EQ(sceneOf(formatScene(scene)).solver.simulationSteps, AutoCount(stableSteps(scene), true));
  const int before = scene.solver.simulationSteps;
  (void)changeResolution(scene, 100, 100, false);
  EXPECT_GT(scene.solver.simulationSteps, before);
  EXPECT_EQ(scene.solver.simulationSteps, stableSteps(scene));
  setSceneValue(scene, "solver.simulation_steps=7");
  EXPECT_EQ(scene.solver.simulationSteps, AutoCount(7));
}

// A cushion that fills with air would not be solved in the steps that its folds alone ask for.
TEST(SimulationSteps, AreAsShortAsAPressureAsksFor) {
  for (const char* cloth : {R"("width": 0.4, "height": 0.4, "num_width_points": 41, "num_height_points": 41)",
                            R"("mesh": "assets/meshes/cushion.obj")"}) {
    const auto steps = [&](double pressure, const char* integrator) {
      return sceneOf(std::string(R"({"cloth": {)") + cloth + R"(, "material": "cotton", "pressure": )" +
                     std::to_string(pressure) + R"(}, "solver": {"self_collision": false, "integrator": ")" +
                     integrator + "\"}}")
          .solver.simulationSteps.count;
    };
    const int without = steps(0, "implicit");
    EXPECT_EQ(steps(0.1, "implicit"), without) << cloth;
    EXPECT_GE(steps(60, "implicit"), 3 * without) << cloth;
    EXPECT_EQ(steps(-60, "implicit"), steps(60, "implicit")) << "which side it is on does not matter";
    EXPECT_NEAR(steps(960, "implicit"), 4 * steps(60, "implicit"), 3) << "as its square root";
    EXPECT_EQ(steps(60, "verlet"), steps(0, "verlet")) << "explicit steps are as short as is stable";
  }
}

TEST(CgIterations, GrowWithTheStepWhenAuto) {
  const auto iterations = [](int framesPerSec) {
    return sceneOf(R"({"cloth": {}, "solver": {"simulation_steps": 1, "frames_per_sec": )" +
                   std::to_string(framesPerSec) + "}}")
        .solver.cgIterations;
  };
  EXPECT_EQ(iterations(1000), AutoCount(20, true));
  EXPECT_EQ(iterations(120), AutoCount(40, true));
  EXPECT_EQ(iterations(100), AutoCount(48, true));
  EXPECT_EQ(iterations(20), AutoCount(60, true));
  EXPECT_EQ(iterations(5), AutoCount(60, true));
  Scene scene = sceneOf(R"({"cloth": {}, "solver": {"simulation_steps": 1, "frames_per_sec": 60}})");
  setSceneValue(scene, "solver.frames_per_sec=20");
  EXPECT_EQ(scene.solver.cgIterations, AutoCount(60, true));
  setSceneValue(scene, "solver.cg_iterations=7");
  EXPECT_EQ(scene.solver.cgIterations, AutoCount(7));
  setSceneValue(scene, "solver.cg_iterations=auto");
  EXPECT_EQ(scene.solver.cgIterations, AutoCount(60, true));
}

// What 20 iterations leave of the press of layers is noise that rubs.
TEST(CgIterations, AreMoreInShortStepsWhereClothMayTouch) {
  const auto iterations = [](const char* touches) {
    return sceneOf(std::string(R"({"cloth": {"material": "silk"}, "solver": {"self_collision": )") + touches +
                   "}}")
        .solver.cgIterations.count;
  };
  EXPECT_EQ(iterations(R"("contact")"), 40);
  EXPECT_LT(iterations("false"), 40);
}

TEST(ChangeResolution, LeavesAMaterialAndMultipliesItsSteps) {
  Scene scene =
      sceneOf(R"({"cloth": {"material": {"bend": 0}, "num_width_points": 11, "num_height_points": 11},
                  "solver": {"integrator": "verlet", "simulation_steps": 30}})");
  const Scene before = scene;
  (void)changeResolution(scene, 41, 41, false);
  EXPECT_EQ(scene.cloths[0].material, before.cloths[0].material);
  EXPECT_EQ(scene.solver.simulationSteps, 4 * before.solver.simulationSteps);
}

}  // namespace
}  // namespace clothsim

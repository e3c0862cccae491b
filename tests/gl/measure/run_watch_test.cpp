// What a run is warned of: the library's part here, the commands' further down.
#include "measure/run_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/files.h"
#include "scene_io/scene_io.h"
#include "solver/solver.h"
#include "support/process.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

using nlohmann::json;
using test::clothsim;
using test::CommandResult;
using test::jsonOf;

constexpr const char* SHEET =
    R"("width": 1, "height": 1, "num_width_points": 6, "num_height_points": 6, "ks": 500,
  "pinned": ["top"])";

std::vector<Warning> pathWarningsOf(const std::string& text, double time = 0) {
  const Scene scene = parseScene(text, "paths");
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  state.clock.originTime = time;
  return pathWarnings(cloth, scene, state);
}

Scene sceneOnPath(const std::string& keys, const char* more = "") {
  return parseScene(
      std::string(R"({"cloth": {)") + SHEET + R"(, "pin_motion": {"keys": [)" + keys + "]" + more + "}}}",
      "p");
}

std::vector<Warning> warningsOnPath(const std::string& keys, const char* more = "", double time = 0) {
  return pathWarningsOf(formatScene(sceneOnPath(keys, more)), time);
}

TEST(PathWarnings, TellHowFarAPathBeginsFromItsPins) {
  const auto far = warningsOnPath(R"({"t": 0, "position": [3.5, 1, 0]}, {"t": 1, "position": [4, 1, 0]})");
  ASSERT_EQ(far.size(), 1u);
  EXPECT_NE(far[0].text.find("cloth.pin_motion.0 is 3 m away from its pins"), std::string::npos)
      << far[0].text;
  EXPECT_TRUE(warningsOnPath(R"({"t": 0}, {"t": 1, "position": [4, 1, 0]})").empty());
  EXPECT_TRUE(warningsOnPath(R"({"t": 0, "position": [0.501, 1, 0]})").empty())
      << "a path written with three digits";
  // A state whose time is another than that of its pins.
  const auto late = warningsOnPath(R"({"t": 0}, {"t": 1, "position": [0.5, 3, 0]})", "", 0.5);
  ASSERT_EQ(late.size(), 1u);
  EXPECT_NE(late[0].text.find("1 m away from its pins at 0.5 s"), std::string::npos) << late[0].text;
}

TEST(PathWarnings, AreNotOfTheNoiseOfAStandingSheet) {
  EXPECT_TRUE(pathWarningsOf(std::string(R"({"cloth": {"orientation": 1, "pin_motion":
      {"keys": [{"t": 0, "position": [0.5, 1, 0]}]},)") +
                             SHEET + "}}")
                  .empty());
}

TEST(PathWarnings, SeePinsThatAreTurned) {
  const auto turned = warningsOnPath(R"({"t": 0, "rotation": [0, 0, 180]})");
  ASSERT_EQ(turned.size(), 1u);
  EXPECT_NE(turned[0].text.find("1 m away"), std::string::npos) << "the ends of the edge: " << turned[0].text;
}

TEST(PathWarnings, TellHowFarALoopJumps) {
  const auto jump = warningsOnPath(R"({"t": 0}, {"t": 2, "position": [0.5, 2, 0]})", R"(, "loop": true)");
  ASSERT_EQ(jump.size(), 1u);
  EXPECT_NE(jump[0].text.find("jumps by 1 m and 0 degrees"), std::string::npos) << jump[0].text;
  EXPECT_NE(jump[0].text.find("first at 2 s"), std::string::npos) << jump[0].text;
  EXPECT_TRUE(warningsOnPath(R"({"t": 0}, {"t": 2, "rotation": [0, 720, 0]})", R"(, "loop": true)").empty())
      << "whole turns end where they began";
  const auto ball =
      pathWarningsOf(std::string(R"({"cloth": {)") + SHEET + R"(}, "colliders": [{"type": "sphere"},
      {"type": "box", "motion": {"loop": true, "keys": [{"t": 0}, {"t": 1, "rotation": [0, 90, 0]}]}}]})");
  ASSERT_EQ(ball.size(), 1u);
  EXPECT_NE(ball[0].text.find("colliders.1.motion jumps by 0 m and 90 degrees"), std::string::npos)
      << ball[0].text;
}

TEST(RunWatch, NamesTheFirstFrameAndThePeakOfADoubtfulStrain) {
  Scene scene = parseScene(std::string(R"({"cloth": {)") + SHEET + "}}", "strain");
  scene.solver.selfCollision = SelfCollision::off;
  const Cloth cloth(scene);
  const State state = initialState(cloth, scene);
  RunWatch watch;
  watch.start(cloth, scene, state);
  int frame = 0;
  for (const double strain : {0.0, 0.99, 1.5, 7.0, 0.2}) watch.add(frame++, cloth, scene, state, strain, {});
  const auto warnings = watch.warnings(scene);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, "strain");
  EXPECT_EQ(warnings[0].frame, 2);
  EXPECT_NE(warnings[0].text.find("by up to 700 %"), std::string::npos) << warnings[0].text;
  EXPECT_NE(warnings[0].text.find("solver.simulation_steps (now 30)"), std::string::npos) << warnings[0].text;
}

TEST(RunWatch, AsksWhetherAStateThatBeginsTornApartIsOfAnotherScene) {
  const Scene scene = parseScene(std::string(R"({"cloth": {)") + SHEET + "}}", "torn");
  const Cloth cloth(scene);
  const State state = initialState(cloth, scene);
  RunWatch watch;
  watch.start(cloth, scene, state);
  watch.add(0, cloth, scene, state, 15, {});
  const auto warnings = watch.warnings(scene);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, "start");
  EXPECT_NE(warnings[0].text.find("of another scene or resolution?"), std::string::npos) << warnings[0].text;
}

// Springs hold lighter particles more stiffly. The strain limit keeps such cloth from blowing up, and it
// boils.
TEST(RunWatch, SaysThatStepsAreTooLongForSprings) {
  Scene scene = loadSceneByName("pinned2");
  EXPECT_FALSE(longStepsWarning(scene).has_value());
  scene.cloths[0].density = 1.5;
  const std::optional<Warning> warning = longStepsWarning(scene);
  ASSERT_TRUE(warning.has_value());
  EXPECT_EQ(warning->kind, "step");
  EXPECT_NE(warning->text.find("simulation_steps=56 (now 30)"), std::string::npos) << warning->text;
  scene.solver.simulationSteps = 56;
  EXPECT_FALSE(longStepsWarning(scene).has_value());
  scene.solver.simulationSteps = 1;
  scene.solver.integrator = Integrator::implicit;
  EXPECT_FALSE(longStepsWarning(scene).has_value());
}

TEST(RunWatch, SaysThatExplicitStepsLoseSlowMotionsFarFromTheOrigin) {
  const auto warningAt = [](double x, Integrator integrator) {
    Scene scene = parseScene(std::string(R"({"cloth": {)") + SHEET + "}}", "far");
    scene.solver.integrator = integrator;
    scene.cloths[0].position.x = x;
    return farFromOriginWarning(scene, initialState(Cloth(scene), scene));
  };
  EXPECT_FALSE(warningAt(5, Integrator::verlet));
  EXPECT_FALSE(warningAt(1000, Integrator::implicit)) << "which take velocities from displacements";
  const auto warning = warningAt(199, Integrator::verlet);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->text.find("begins 200 m from the origin"), std::string::npos) << warning->text;
  const auto solved = warningAt(1e4, Integrator::implicit);
  ASSERT_TRUE(solved);
  EXPECT_NE(solved->text.find("strains and contacts are wrong by that"), std::string::npos) << solved->text;
}

TEST(RunWatch, SaysThatLayersAreThinnerThanTheCloth) {
  const auto warningOf = [](const Scene& scene) { return thinLayersWarning(scene, Cloth(scene)); };
  const auto expectText = [&](const Scene& scene, const std::string& part) {
    const std::optional<Warning> warning = warningOf(scene);
    ASSERT_TRUE(warning.has_value());
    EXPECT_NE(warning->text.find(part), std::string::npos) << warning->text;
  };
  const std::string sheet =
      R"({"cloth": {"width": 0.1, "height": 0.1, "num_width_points": 101, "num_height_points": 51)";
  const Scene wool =
      parseScene(sheet + R"(, "material": "wool"}, "solver": {"integrator": "implicit"}})", "wool");
  expectText(wool, "layers meet at 0.5 mm instead of 0.8 mm at 5151 of 5151 particles");
  Scene coarse = wool;
  coarse.cloths[0].numWidthPoints = 41;
  EXPECT_FALSE(warningOf(coarse).has_value());

  Scene springs =
      parseScene(sheet + R"(, "thickness": 0.01}, "solver": {"self_collision": "averaged"}})", "springs");
  expectText(springs, "layers meet at 7 mm instead of 20 mm, 7 of the shortest spacings");
  springs.cloths[0].thickness = 0.003;
  EXPECT_FALSE(warningOf(springs).has_value());
}

TEST(RunWatch, TakesFabricsForStretchedSoonerThanSprings) {
  EXPECT_EQ(doubtfulStrain(parseScene(R"({"cloth": {"ks": 5}})", "springs")), 1);
  EXPECT_EQ(doubtfulStrain(parseScene(R"({"cloth": {"material": "silk"}})", "silk")), 0.5);
}

// A sheet under robust self-collision that is shaken too fast for its steps.
class DoubtfulRun : public testing::Test {
 protected:
  DoubtfulRun() {
    writeFileAtomically(folder_ / "shaken.json", std::string(R"({"cloth": {)") + SHEET + R"(, "damping": 0,
        "pin_motion": {"loop": true, "keys": [{"t": 0}, {"t": 0.05, "position": [0.5, 3, 3]}, {"t": 0.1}]}},
        "solver": {"self_collision": "robust", "strain_limit": false}})");
  }
  test::TemporaryFolder folder_;
  std::string scene_ = "-f " + (folder_ / "shaken.json").string() + " --frames 12 --backend cpu ";
};

TEST_F(DoubtfulRun, IsSaidByEveryCommandAndEndsWithExitCodeOneUnderStrict) {
  for (const std::string& command :
       {"run " + scene_, "render --size 32x32 --out " + (folder_ / "a.png").string() + " " + scene_,
        "sweep --size 32x32 --vary cloth.ks=500 --out " + (folder_ / "b.png").string() + " " + scene_}) {
    const CommandResult easy = clothsim(command), strict = clothsim(command + " --strict");
    EXPECT_EQ(easy.exitCode, 0) << easy.output;
    EXPECT_EQ(strict.exitCode, 1) << strict.output;
    EXPECT_NE(easy.output.find("a spring is stretched by 100 % or more"), std::string::npos) << easy.output;
    EXPECT_NE(easy.output.find("raise solver.simulation_steps (now 30)"), std::string::npos) << easy.output;
    EXPECT_NE(strict.output.find("--strict: the run ended with "), std::string::npos) << strict.output;
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a.png")) << "what was made is kept";
}

TEST_F(DoubtfulRun, NamesTheConditionOfContactThatFailed) {
  const json result = jsonOf("run --json " + scene_);
  ASSERT_EQ(result["contact_sound"], false);
  const json& failed = result["contact"]["failed"];
  EXPECT_TRUE(failed["condition"] == "fast_step" || failed["condition"] == "pairs_too_near") << failed;
  EXPECT_GT(failed["frame"], 0);
  const auto named = [](const json& warning) { return warning["kind"] == "contact"; };
  EXPECT_TRUE(std::any_of(result["warnings"].begin(), result["warnings"].end(), named)) << result["warnings"];
}

TEST_F(DoubtfulRun, SaysThatImplicitStepsKnowABetterContact) {
  const std::string implicitly = scene_ + "--set solver.integrator=implicit --set solver.simulation_steps=1 ";
  const std::string advice = "set solver.self_collision=contact, which implicit steps solve for";
  const CommandResult after = clothsim("run " + implicitly),
                      inside = clothsim("run " + implicitly + "--set solver.self_collision=contact");
  EXPECT_NE(after.output.find(advice), std::string::npos) << after.output;
  EXPECT_EQ(inside.output.find(advice), std::string::npos) << inside.output;
}

TEST(SoundRun, HasNoWarningsAndPassesUnderStrict) {
  const CommandResult run = test::runCommand(
      CLOTHSIM_PROGRAM
      " run -f pinned2 --resolution 12x12 --frames 5 --backend cpu --strict --json 2>/dev/null");
  EXPECT_EQ(run.exitCode, 0);
  const json result = json::parse(run.output);
  EXPECT_TRUE(result["warnings"].empty()) << result["warnings"];
}

TEST(UnsolvedRun, IsSaidByEveryCommandOnceAndEndsWithExitCodeOneUnderStrict) {
  const test::TemporaryFolder folder;
  const std::string scene =
      "-f pinned2 --resolution 12x12 --frames 30 --backend cpu --set solver.self_collision=false --set "
      "solver.integrator=implicit --set solver.simulation_steps=1 --set solver.newton_steps=1 ";
  for (const std::string& command :
       {"run " + scene, "render --size 32x32 --out " + (folder / "a.png").string() + " " + scene,
        "sweep --size 32x32 --vary cloth.ks=5000 --out " + (folder / "b.png").string() + " " + scene}) {
    const CommandResult easy = clothsim(command), strict = clothsim(command + " --strict");
    EXPECT_EQ(easy.exitCode, 0) << easy.output;
    EXPECT_EQ(strict.exitCode, 1) << strict.output;
    const std::string words = "of 30 steps (";
    const std::size_t found = easy.output.find(words);
    ASSERT_NE(found, std::string::npos) << easy.output;
    EXPECT_EQ(easy.output.find(words, found + 1), std::string::npos) << easy.output;
    EXPECT_NE(easy.output.find("raise solver.simulation_steps (now 1) or solver.newton_steps (now 1)"),
              std::string::npos)
        << easy.output;
  }
}

TEST(RestingState, DoesNotStartInsideTheColliderThatItLiesOn) {
  const test::TemporaryFolder folder;
  const std::string scene = "run -f sphere --resolution 20x20 --backend cpu ",
                    state = (folder / "a.state").string();
  ASSERT_EQ(clothsim(scene + "--frames 60 --save " + state).exitCode, 0);
  const CommandResult from = clothsim(scene + "--frames 0 --from " + state);
  EXPECT_EQ(from.exitCode, 0);
  EXPECT_EQ(from.output.find("inside a collider"), std::string::npos) << from.output;
}

// A change of the step length with --from once tore the cloth along to where its path was at the other time.
TEST(StateOfAPath, GoesOnAtItsTimeWithOtherSteps) {
  const test::TemporaryFolder folder;
  const std::string scene = "run -f twist --resolution 12x12 --backend cpu --json ",
                    state = (folder / "a.state").string();
  ASSERT_EQ(clothsim(scene + "--frames 30 --save " + state).exitCode, 0);
  const json result = jsonOf(scene + "--frames 1 --from " + state +
                             " --set solver.integrator=implicit --set solver.simulation_steps=5");
  EXPECT_LT(result["peak_strain"], 0.3) << result;
  EXPECT_TRUE(result["warnings"].empty()) << result["warnings"];
}

TEST(Interrupt, EndsALongFrameBetweenTwoSteps) {
  const test::TemporaryFolder folder;
  for (const char* backend : {"cpu", "gpu"}) {
    test::Process run(
        {CLOTHSIM_PROGRAM, "run", "-f", "pinned2", "--resolution", "32x32", "--frames", "1", "--backend",
         backend, "--set", "solver.simulation_steps=1000000", "--save", (folder / "never.state").string()},
        (folder / "log").string());
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    ASSERT_TRUE(run.running()) << readFile(folder / "log");
    run.send(SIGINT);
    EXPECT_EQ(run.waitFor(std::chrono::seconds(3)), 130) << backend;
    EXPECT_NE(readFile(folder / "log").find("interrupted"), std::string::npos) << readFile(folder / "log");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "never.state"));
}

}  // namespace
}  // namespace clothsim

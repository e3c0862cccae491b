// What a step and a frame ask of OpenGL, against a table that people read: report/data/gl_counts.csv. On
// hardware a dispatch costs as much as the arithmetic of a hundred thousand particles: one more is to be
// seen.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "core/files.h"
#include "gl/counted_calls.h"
#include "gl/framebuffer.h"
#include "gl/gl_test.h"
#include "gl/program.h"
#include "render/camera.h"
#include "simulation/gpu/simulation_renderer.h"
#include "simulation/gpu/solvers.h"
#include "solver/gpu/gpu_solver.h"
#include "support/compared_scenes.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

const fs::path table = fs::path(SOURCE_ROOT) / "report/data/gl_counts.csv";
constexpr const char* HEADER =
    "configuration,points,steps,drawn,dispatches,barriers,gl_calls,bytes_uploaded,bytes_read";

// Whole steps, of which passes behind closed gates are a part: how many that are depends on the cloth.
std::unique_ptr<Solver> makeForWholeSteps(const std::string&, const Shared<Cloth>& cloth,
                                          const Shared<Scene>& scene) {
  return std::make_unique<GpuSolver>(*cloth, scene, GpuOptions{.looksAtFlags = FlagLooks::never});
}

std::unique_ptr<Solver> makeAsOnHardware(const std::string&, const Shared<Cloth>& cloth,
                                         const Shared<Scene>& scene) {
  return std::make_unique<GpuSolver>(*cloth, scene,
                                     GpuOptions{.limitsInTiles = true, .looksAtFlags = FlagLooks::never});
}

struct Configuration {
  std::string name;
  int points;  // of N x N
  Scene scene;
  SolverFactory makeSolver = makeForWholeSteps;
};

Scene hanging(int n) { return test::vertical(test::sheetScene(n)); }

Scene inImplicitSteps(Scene scene, Integrator integrator = Integrator::implicit) {
  scene.solver.integrator = integrator;
  scene.solver.framesPerSec = 60;
  scene.solver.simulationSteps = 1;
  scene.solver.newtonSteps = 4;
  scene.solver.cgIterations = 10;
  return scene;
}

Scene withSelfCollision(Scene scene, SelfCollision mode) {
  scene.solver.selfCollision = mode;
  return scene;
}

Scene inContact(int n) {
  return withSelfCollision(inImplicitSteps(test::materialScene(n)), SelfCollision::contact);
}

// Those of the table, or those that are counted in a second. Counts depend on the size in two ways: levels of
// the preconditioner with more than 16,384 vertices take dispatches of their own, and contact has a level of
// boxes more for each four times as many triangles.
std::vector<Configuration> configurations(bool whole) {
  std::vector<Configuration> all;
  for (const int n : {128, 512, 1024}) {
    if (whole || n == 128) {
      all.push_back({"plain", n, hanging(n)});
      all.push_back({"limiter", n, test::withLimiter(hanging(n))});
      all.push_back({"robust", n, withSelfCollision(test::withLimiter(hanging(n)), SelfCollision::robust)});
      all.push_back({"implicit with contact", n, inContact(n)});
      all.push_back({"limiter, as on hardware", n, test::withLimiter(hanging(n)), makeAsOnHardware});
      all.push_back({"robust, as on hardware", n,
                     withSelfCollision(test::withLimiter(hanging(n)), SelfCollision::robust),
                     makeAsOnHardware});
    }
    if (whole || n <= 512) all.push_back({"implicit", n, inImplicitSteps(hanging(n))});
  }
  const auto addOne = [&](const std::string& name, const Scene& scene) { all.push_back({name, 64, scene}); };
  addOne("colliders, wind, attractors",
         test::withAttractors(test::withWind(test::withColliders(hanging(64)))));
  addOne("implicit with colliders", inImplicitSteps(test::withColliders(hanging(64))));
  addOne("bdf2, a material in wind",
         inImplicitSteps(test::withWind(test::materialScene(64)), Integrator::bdf2));
  addOne("implicit, two cloths", inImplicitSteps(test::twoCloths(hanging(64))));
  addOne("implicit, a mesh", inImplicitSteps(test::meshOfMaterial(64)));
  return all;
}

std::string row(const Configuration& of, int steps, bool drawn) {
  const test::GlCounts& counts = test::glCounts;
  std::ostringstream text;
  text << '"' << of.name << "\"," << of.points << ',' << steps << ',' << (drawn ? "yes" : "no") << ','
       << counts.dispatches() << ',' << counts.of("glMemoryBarrier") << ',' << counts.all() << ','
       << counts.uploadedBytes << ',' << counts.readBytes << '\n';
  return text.str();
}

// A row for a step, and one for a frame as `clothsim render` makes it: steps, the question whether they went
// well, a picture.
std::string rowsOf(const Configuration& configuration) {
  Simulation simulation(configuration.scene, "gpu", configuration.makeSolver);
  SimulationRenderer renderer(simulation, {});
  const Camera camera(simulation.scene(), simulation.cloth());
  const gl::Framebuffer target(
      "picture", {.width = 64, .height = 48, .color = GL_SRGB8_ALPHA8, .depth = GL_DEPTH_COMPONENT24});
  const auto frame = [&] {
    simulation.stepFrame();
    EXPECT_EQ(simulation.checkFrame(), std::nullopt) << configuration.name;
    renderer.draw(camera, target.name(), 64, 48);
  };
  const test::CountsOnly counting;
  frame();  // what is made once, is made here
  test::glCounts = {};
  const std::uint64_t before = gl::dispatchCount();
  simulation.solver().step(1);
  EXPECT_EQ(gl::dispatchCount() - before, test::glCounts.dispatches()) << "what bench prints";
  std::string rows = row(configuration, 1, false);
  test::glCounts = {};
  frame();
  return rows + row(configuration, simulation.scene().solver.simulationSteps, true);
}

std::set<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::set<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.insert(line);
  return lines;
}

// llvmpipe's storage blocks are too small for 1024 x 1024 points in implicit steps. What does not run, only
// has to be asked for: as of a driver with the limits of hardware.
class LimitsOfHardware {
 public:
  LimitsOfHardware() {
    original = glad_glGetInteger64v;
    glad_glGetInteger64v = [](GLenum name, GLint64* value) {
      original(name, value);
      if (name == GL_MAX_TEXTURE_BUFFER_SIZE) *value = GLint64{1} << 27;
      if (name == GL_MAX_SHADER_STORAGE_BLOCK_SIZE) *value = GLint64{1} << 31;
    };
  }
  ~LimitsOfHardware() { glad_glGetInteger64v = original; }
  LimitsOfHardware(const LimitsOfHardware&) = delete;
  LimitsOfHardware& operator=(const LimitsOfHardware&) = delete;

 private:
  static inline PFNGLGETINTEGER64VPROC original = nullptr;
};

using GlCountsTest = GlTest;

// After a change that is meant, tools/gl_counts writes the table anew, with all sizes.
TEST_F(GlCountsTest, OfAStepAndAFrameAreThoseOfTheTable) {
  const bool stores = std::getenv("CLOTHSIM_STORE_REFERENCES") != nullptr;
  const LimitsOfHardware hardware;
  std::string found = std::string(HEADER) + "\n";
  for (const Configuration& configuration : configurations(stores)) found += rowsOf(configuration);
  if (stores) writeFileAtomically(table, found);
  const std::set<std::string> expected = linesOf(readFile(table));
  for (const std::string& line : linesOf(found))
    EXPECT_TRUE(expected.contains(line)) << line << "\nis not in " << table.string();
}

// Without this a function that is new to the program would not be counted.
TEST(GlCounts, KnowEveryFunctionThatTheProgramCalls) {
  std::set<std::string> counted;
#define NAME_OF(function) counted.insert(#function);
  CALLED_GL_FUNCTIONS(NAME_OF)
#undef NAME_OF
  std::set<std::string> called;
  const std::regex call(R"(\b(gl[A-Z]\w*)\()");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE_ROOT) / "src")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = readFile(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), call), none; match != none; ++match)
      if ((*match)[1] != "glFunction") called.insert((*match)[1]);  // a function of headless_context.cpp
  }
  EXPECT_EQ(counted, called);
}

}  // namespace
}  // namespace clothsim

// The frame loop of the GPU backend neither reads back nor uploads positions, allocates, or compiles: counted
// at the calls.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>

#include "gl/framebuffer.h"
#include "gl/gl_test.h"
#include "gl/program.h"
#include "render/renderer.h"
#include "solver/gpu/gpu_solver.h"
#include "support/compared_scenes.h"

namespace clothsim {
namespace {

std::map<std::string, int> calls;
std::size_t uploadedBytes = 0;

// Puts a counter in front of a function pointer of the loader for as long as it lives.
template <auto& Pointer>
class Counted;

template <class Result, class... Arguments, Result (*&Pointer)(Arguments...)>
class Counted<Pointer> {
 public:
  explicit Counted(const char* name) {
    name_ = name;
    original_ = Pointer;
    Pointer = &count;
  }
  ~Counted() { Pointer = original_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  static Result count(Arguments... arguments) {
    ++calls[name_];
    if constexpr (std::is_same_v<Result (*)(Arguments...), PFNGLNAMEDBUFFERSUBDATAPROC>)
      uploadedBytes +=
          static_cast<std::size_t>(std::get<2>(std::tuple(arguments...)));  // (buffer, offset, size, data)
    return original_(arguments...);
  }
  static inline const char* name_ = nullptr;
  static inline Result (*original_)(Arguments...) = nullptr;
};

#define COUNTED(function) const Counted<glad_##function> counted_##function(#function)

using GlCallsTest = GlTest;

TEST_F(GlCallsTest, AFrameReadsNothingBackAndUploadsNoPositions) {
  std::vector<test::NamedScene> scenes = test::comparedScenes(40);
  scenes.push_back(test::implicitScenes(20)[1]);
  for (const auto& [name, scene] : scenes) {
    const Cloth cloth(scene);
    GpuSolver solver(cloth, scene);
    Renderer renderer(cloth, scene, {});
    const Camera camera(scene, cloth);
    const gl::Framebuffer target(
        "picture", {.width = 64, .height = 48, .color = GL_SRGB8_ALPHA8, .depth = GL_DEPTH_COMPONENT24});
    const auto frame = [&] {
      solver.step(8);
      renderer.draw(solver.positionsBuffer(), camera, 0.1, target.name(), 64, 48);
    };
    frame();  // what is made once, is made here

    calls.clear();
    uploadedBytes = 0;
    {
      COUNTED(glGetNamedBufferSubData);
      COUNTED(glMapNamedBufferRange);
      COUNTED(glMapBufferRange);
      COUNTED(glReadPixels);
      COUNTED(glGetTextureImage);
      COUNTED(glFinish);
      COUNTED(glCreateBuffers);
      COUNTED(glNamedBufferStorage);
      COUNTED(glCreateTextures);
      COUNTED(glCompileShader);
      COUNTED(glLinkProgram);
      COUNTED(glNamedBufferSubData);
      COUNTED(glDispatchCompute);
      for (int i = 0; i < 5; ++i) frame();
    }
    EXPECT_GT(calls["glDispatchCompute"], 40) << name << ": the counters work";
    for (const auto& [function, count] : calls) {
      if (function == "glDispatchCompute" || function == "glNamedBufferSubData") continue;
      EXPECT_EQ(count, 0) << name << ": " << function;
    }
    // Parameters, colliders and the camera go up; a single upload of the positions would be 25,600 bytes a
    // frame.
    std::size_t pinMotions = 0;
    for (const ClothSettings& settings : scene.cloths) pinMotions += settings.pinMotion.size();
    constexpr std::size_t slot = (sizeof(StepParams<float>) + 255) / 256 * 256;
    const std::size_t parameters = 5 * 8 *
                                   (scene.cloths.size() * slot +
                                    scene.colliders.size() * sizeof(ColliderParams<float>) + pinMotions * 64);
    EXPECT_LE(uploadedBytes, parameters + 5 * 4096) << name;
  }
}

// Puts a function that counts and does nothing else in the place of the one that dispatches.
class CountedDispatches {
 public:
  CountedDispatches() {
    calls["dispatches"] = 0;
    glad_glDispatchCompute = [](GLuint, GLuint, GLuint) { ++calls["dispatches"]; };
    glad_glDispatchComputeIndirect = [](GLintptr) { ++calls["dispatches"]; };
  }
  ~CountedDispatches() {
    glad_glDispatchCompute = dispatch_;
    glad_glDispatchComputeIndirect = dispatchIndirect_;
  }
  CountedDispatches(const CountedDispatches&) = delete;
  CountedDispatches& operator=(const CountedDispatches&) = delete;
  [[nodiscard]] int count() const { return calls["dispatches"]; }

 private:
  PFNGLDISPATCHCOMPUTEPROC dispatch_ = glad_glDispatchCompute;
  PFNGLDISPATCHCOMPUTEINDIRECTPROC dispatchIndirect_ = glad_glDispatchComputeIndirect;
};

int dispatchesOfAStep(const Scene& scene) {
  const Cloth cloth(scene);
  GpuSolver solver(cloth, scene);
  const std::uint64_t before = gl::dispatchCount();
  const CountedDispatches dispatches;
  solver.step(1);
  EXPECT_EQ(gl::dispatchCount() - before, static_cast<std::uint64_t>(dispatches.count()))
      << "what bench prints";
  return dispatches.count();
}

Scene asByDefault(Scene scene, Integrator integrator) {
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

// On hardware a dispatch costs as much as the arithmetic of a hundred thousand particles: one more is to be
// seen.
TEST_F(GlCallsTest, AStepTakesAsFewDispatchesAsItDid) {
  const auto sheet = [](int n) { return test::vertical(test::sheetScene(n)); };
  const auto implicit = [](const Scene& scene) { return asByDefault(scene, Integrator::implicit); };
  const struct {
    std::string name;
    Scene scene;
    int dispatches;
  } table[] = {
      {"plain", sheet(128), 1},
      {"limiter", test::withLimiter(sheet(128)), 14},
      {"robust", withSelfCollision(test::withLimiter(sheet(128)), SelfCollision::robust), 32},
      {"implicit 64", implicit(sheet(64)), 158},
      {"implicit 256", implicit(sheet(256)), 160},
      {"implicit 256, colliders", implicit(test::withColliders(sheet(256))), 165},
      {"bdf2 256, a material in wind",
       asByDefault(test::withWind(test::materialScene(256)), Integrator::bdf2), 161},
      {"implicit, two cloths", implicit(test::twoCloths(sheet(64))), 336},
      {"implicit, a mesh", implicit(test::meshOfMaterial(64)), 158},
  };
  for (const auto& [name, scene, dispatches] : table) EXPECT_EQ(dispatchesOfAStep(scene), dispatches) << name;
}

}  // namespace
}  // namespace clothsim

// The frame loop of the GPU backend neither reads back nor uploads positions, allocates, or compiles, and on
// hardware dispatches little that does nothing: counted at the calls.
#include <gtest/gtest.h>

#include "gl/counted_calls.h"
#include "gl/framebuffer.h"
#include "gl/gl_test.h"
#include "render/renderer.h"
#include "solver/gpu/gpu_solver.h"
#include "solver/tearing.h"
#include "support/compared_scenes.h"
#include "support/material_sheet.h"

namespace clothsim {
namespace {

using GlCallsTest = GlTest;

TEST_F(GlCallsTest, AFrameReadsNothingBackAndUploadsNoPositions) {
  std::vector<test::NamedScene> scenes = test::fullestScenes(40);
  scenes.push_back(test::implicitScenes(20)[1]);
  for (const auto& [name, scene] : scenes) {
    if (canTear(scene)) continue;  // its positions are read after each frame
    const Cloth cloth(scene);
    GpuSolver solver(cloth, scene, GpuOptions{.looksAtFlags = FlagLooks::whenReady});
    Renderer renderer(cloth, scene, {});
    const Camera camera(scene, cloth);
    const gl::Framebuffer target(
        "picture", {.width = 64, .height = 48, .color = GL_SRGB8_ALPHA8, .depth = GL_DEPTH_COMPONENT24});
    constexpr int frames = 3, steps = 4;
    const auto frame = [&] {
      solver.step(steps);
      renderer.draw(solver.positionsBuffer(), camera, 0.1, target.name(), 64, 48);
    };
    frame();  // what is made once, is made here

    test::glCounts = {};
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
      for (int i = 0; i < frames; ++i) frame();
    }
    EXPECT_GE(test::glCounts.of("glDispatchCompute"), 1u * frames * steps) << name << ": the counters work";
    for (const auto& [function, count] : test::glCounts.calls) {
      if (function == "glDispatchCompute" || function == "glNamedBufferSubData") continue;
      EXPECT_EQ(count, 0u) << name << ": " << function;
    }
    // Parameters, colliders and the camera go up; a single upload of the positions would be 25,600 bytes a
    // frame.
    std::size_t pinMotions = 0;
    for (const ClothSettings& settings : scene.cloths) pinMotions += settings.pinMotion.size();
    constexpr std::size_t slot = (sizeof(StepParams<float>) + 255) / 256 * 256;
    const std::size_t parameters = frames * steps *
                                   (scene.cloths.size() * slot +
                                    scene.colliders.size() * sizeof(ColliderParams<float>) + pinMotions * 64);
    EXPECT_LE(test::glCounts.uploadedBytes, parameters + frames * 4096) << name;
  }
}

TEST_F(GlCallsTest, AFrameInWhichClothTearsCompilesNothing) {
  Scene scene = test::garment(16);
  scene.solver.selfCollision = SelfCollision::averaged;
  const Cloth cloth(scene);
  GpuSolver solver(cloth, scene);
  solver.step(1);
  ASSERT_TRUE(solver.cuts().empty());
  test::glCounts = {};
  {
    COUNTED(glCompileShader);
    COUNTED(glDispatchCompute);
    solver.step(5 * scene.solver.simulationSteps);
  }
  EXPECT_FALSE(solver.cuts().empty()) << "nothing tore";
  EXPECT_GT(test::glCounts.of("glDispatchCompute"), 0u) << "the counters work";
  EXPECT_EQ(test::glCounts.of("glCompileShader"), 0u);
}

// As on hardware, with the settings that a user gets. Of a sheet that hangs in folds, and takes a few Newton
// steps, all but a sixtieth of what a step may take is left out, and nothing is waited for.
TEST_F(GlCallsTest, AStepLeavesOutWhatItIsKnownNotToNeed) {
  Scene scene = test::materialSheet(17, 17, 0.4, 0.4, *materialPreset("cotton"));
  scene.cloths[0].orientation = Orientation::vertical;
  scene.cloths[0].pinned = {GridPoint{0, 0}, GridPoint{16, 0}};
  scene.solver.selfCollision = SelfCollision::contact;
  scene.solver.integrator = Integrator::implicit;
  chooseCounts(scene);
  const Cloth cloth(scene);
  constexpr int steps = 2;
  const auto stepped = [&](FlagLooks looks) {
    GpuSolver solver(cloth, scene, GpuOptions{.looksAtFlags = looks});
    solver.step(1);
    test::glCounts = {};
    {
      COUNTED(glGetNamedBufferSubData);
      COUNTED(glFinish);
      COUNTED(glDispatchCompute);
      COUNTED(glDispatchComputeIndirect);
      solver.step(steps);
    }
    return std::pair{test::glCounts, stateHash(solver.state())};
  };
  const auto [all, hashOfAll] = stepped(FlagLooks::never);
  const auto [few, hashOfFew] = stepped(FlagLooks::whenReady);
  EXPECT_EQ(hashOfFew, hashOfAll);
  EXPECT_LT(few.dispatches(), all.dispatches() / 60);
  EXPECT_EQ(few.of("glGetNamedBufferSubData") + few.of("glFinish"), 0u);
}

}  // namespace
}  // namespace clothsim

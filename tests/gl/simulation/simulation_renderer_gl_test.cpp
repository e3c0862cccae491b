// Pictures of a simulation follow it: its state, scene, cloth and cuts.
#include "simulation/gpu/simulation_renderer.h"

#include "gl/gl_test.h"

namespace clothsim {
namespace {

using SimulationRendererTest = GlTest;

Scene smallSheet() {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 7;
  scene.render.shader = "diffuse";
  scene.camera.position = Vec3d{0.5, 2, 0.6};
  scene.camera.target = Vec3d{0.5, 1, 0.5};
  return scene;
}

// On the CPU, whose positions are uploaded: those of the GPU's solver are drawn where they are.
TEST_F(SimulationRendererTest, FollowsEveryChange) {
  Simulation simulation(smallSheet());
  const Camera camera(smallSheet(), simulation.cloth());
  const RenderOptions options{.samples = 1, .shadows = false};
  SimulationRenderer renderer(simulation, options);
  std::vector<std::vector<std::uint8_t>> pictures;
  const auto expectShown = [&](const char* change) {
    const Image picture = renderer.picture(camera, 48, 32);
    for (const auto& earlier : pictures) EXPECT_NE(picture.rgb, earlier) << change << " shows";
    pictures.push_back(picture.rgb);
  };
  expectShown("the start");

  State moved = simulation.state();  // the step stays what it is
  for (Particle4& x : moved.positions) x.x += 0.1f;
  simulation.setState(moved);
  expectShown("another state");

  simulation.stepFrames(8);
  expectShown("a step");

  Scene colored = smallSheet();
  colored.render.color = colored.render.backColor = {0.1, 0.2, 0.9};
  simulation.configure(colored);
  expectShown("another colour");

  Scene narrow = colored;
  narrow.cloths[0].width = 0.5;
  narrow.cloths[0].numWidthPoints = 4;
  simulation.rebuild(narrow);
  expectShown("another cloth");

  Cuts cuts = simulation.solver().cuts();
  ASSERT_TRUE(cutAlong(cuts, simulation.cloth(), 0, {0.5, 3.5}, {2.5, 3.5}));
  simulation.solver().setCuts(cuts);
  expectShown("a cut");
}

}  // namespace
}  // namespace clothsim

// Shaders compiled anew while the renderer runs. Works on a copy of the shaders, in a process of its own.
#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"

namespace clothsim {
namespace {

// What the child does: its shaders are in CLOTHSIM_ROOT, and may be changed.
using ReloadChild = GlTest;
TEST_F(ReloadChild, GoesOnAfterAnErrorAndTakesWhatCompiles) {
  const char* root = std::getenv("CLOTHSIM_ROOT");
  if (root == nullptr || std::filesystem::path(root) == SOURCE_ROOT) return;  // run by the test below
  const std::filesystem::path file = std::filesystem::path(root) / "shaders/render/phong.frag";
  const std::string good = readFile(file);
  const test::Drape drape(test::drapeScene());
  const gl::Buffer<Particle4> positions("positions", drape.positions);
  Renderer renderer(drape.cloth, drape.scene, {});
  const Camera camera(drape.scene, drape.cloth);
  const auto picture = [&] { return renderImage(renderer, positions.name(), camera, 0, 96, 64); };
  const Image before = picture();

  std::ofstream(file) << "// one line more\nnonsense;\n" << good;
  const std::optional<std::string> error = renderer.reloadShaders();
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(error->find("shaders/render/phong.frag:2"), std::string::npos) << *error;
  EXPECT_EQ(picture().rgb, before.rgb) << "the last good programs go on";

  std::filesystem::remove(file);
  EXPECT_NE(renderer.reloadShaders().value_or("").find("phong.frag"), std::string::npos);
  EXPECT_EQ(picture().rgb, before.rgb);

  std::string other = good;
  const std::string colors = "frame.clothFront.rgb : frame.clothBack.rgb";
  ASSERT_NE(other.find(colors), std::string::npos);
  std::ofstream(file) << other.replace(other.find(colors), colors.size(), "vec3(0, 1, 0) : vec3(0, 0, 1)");
  EXPECT_EQ(renderer.reloadShaders().value_or("none"), "none");
  EXPECT_GT(test::meanDifference(picture(), before), 2 * test::TOLERANCE);
}

TEST(Reload, GoesOnAfterAnErrorAndTakesWhatCompiles) {
  const test::ResourceCopy resources;
  const test::CommandResult result = resources.runTests("ReloadChild.*");
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_NE(result.output.find("[  PASSED  ] 1 test"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace clothsim

// Textures and the sky: what is bundled, what is wrong with a file, and how bright surfaces are under the
// sky.
#include "render/textures.h"

#include <cmath>
#include <fstream>

#include "core/error.h"
#include "gl/gl_test.h"
#include "render/environment.h"
#include "render/model_textures.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

using TexturesTest = GlTest;

TEST_F(TexturesTest, AllBundledOnesLoad) {
  EXPECT_EQ(bundledTextures(),
            (std::vector<std::string>{"checker", "hammered", "knit", "quilt", "stripes", "tartan"}));
  for (const std::string& name : bundledTextures()) EXPECT_NE(loadPrint(name).name(), 0u) << name;
  EXPECT_NE(loadHeights("knit").name(), 0u);
  for (const std::string_view name : weaves) {
    if (name == "none") continue;
    EXPECT_NE(loadWeave(std::string(name)).name(), 0u) << name;
  }
}

template <class E>
std::string messageOfLoading(const std::string& texture) {
  try {
    static_cast<void>(loadPrint(texture));
  } catch (const E& error) {
    return error.what();
  }
  return "loaded";
}

TEST_F(TexturesTest, AnUnknownNameIsASceneErrorThatKnowsTheNearest) {
  const std::string message = messageOfLoading<SceneError>("tarten");
  EXPECT_NE(message.find("render.texture"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean \"tartan\""), std::string::npos) << message;
  EXPECT_NE(message.find("quilt"), std::string::npos) << message;
}

TEST_F(TexturesTest, AFileThatIsMissingOrNoPictureIsNamed) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "missing.png").string(), wrong = (folder / "wrong.png").string();
  std::ofstream(wrong) << "no picture";
  EXPECT_NE(messageOfLoading<InputOutputError>(missing).find(missing), std::string::npos);
  EXPECT_NE(messageOfLoading<InputOutputError>(wrong).find(wrong), std::string::npos);
}

// Its first 33 bytes claim 16384 x 16384 pixels of 16 bits, 2 GiB as read.
TEST_F(TexturesTest, ASmallFileMayNotClaimAHugePicture) {
  const test::TemporaryFolder folder;
  const std::string bomb = (folder / "bomb.png").string();
  std::ofstream(bomb) << std::string(
      "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x40\0\0\0\x40\0\x10\6\0\0\0\0\0\0\0", 33);
  EXPECT_NE(messageOfLoading<InputOutputError>(bomb).find("has 16384 x 16384 pixels, more than"),
            std::string::npos);
}

TEST_F(TexturesTest, AWrongChoiceLeavesTheTexturesThatWereThere) {
  RenderSettings settings;
  settings.shader = "texture";
  ModelTextures textures;
  const ShadingModel known = shadingModelOf(settings);
  textures.choose(std::span(&known, 1), settings, {0, 1, 0});
  const auto before = textures.irradiance();
  settings.texture = "no such texture";
  const ShadingModel unknown = shadingModelOf(settings);
  EXPECT_THROW(textures.choose(std::span(&unknown, 1), settings, {0, 1, 0}), SceneError);
  EXPECT_EQ(textures.irradiance(), before);
}

// The oracle: the integral over the sky of light times cosine over pi, by the midpoint rule. A sky this
// smooth is known to lie within a few percent of its second-degree polynomial.
TEST_F(TexturesTest, TheSkysIrradianceIsItsIntegral) {
  const Environment sky;
  const std::array<glm::vec3, 9> terms = sky.irradiance();
  constexpr int rows = 90;
  const double pi = std::acos(-1.0);
  for (const glm::dvec3 n : {glm::dvec3(0, 1, 0), {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {0.6, 0.48, 0.64}}) {
    glm::dvec3 expected(0);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < 2 * rows; ++column) {
        const double polar = pi * (row + 0.5) / rows, azimuth = pi * (column + 0.5) / rows;
        const glm::dvec3 d{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                           std::sin(polar) * std::cos(azimuth)};
        const double weight = std::max(glm::dot(n, d), 0.0) * std::sin(polar) * (pi / rows / rows);
        expected += weight * glm::dvec3(sky.lightFrom(glm::vec3(d)));
      }
    }
    const std::array<double, 9> basis{
        1, n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.z * n.x, n.z * n.z, n.x * n.x - n.y * n.y};
    glm::dvec3 found(0);
    for (std::size_t i = 0; i < 9; ++i) found += basis[i] * glm::dvec3(terms[i]);
    for (glm::length_t channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(found[channel], expected[channel], 0.04 * expected[channel] + 0.01) << n.x << n.y << n.z;
  }
}

}  // namespace
}  // namespace clothsim

// The white furnace: white cloth under light that is the same from everywhere sends back no more than it
// gets, whichever way it is looked at (E. Heitz, "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", 2014, section 5.2).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"
#include "gl/vertex_array.h"
#include "render/look.h"
#include "render/model_textures.h"
#include "render/programs.h"
#include "render/shadow_map.h"

namespace clothsim {
namespace {

// The light that the canvas shows so: back through srgbEncoded() of shaders/render/tone.glsl, which grows
// with it.
double lightShownAs(double shown) {
  double low = 0, high = 2;
  for (int i = 0; i < 60; ++i) {
    const double light = 0.5 * (low + high), root = std::sqrt(light), fourth = std::sqrt(root);
    const double encoded = light <= 0.0031308
                               ? 12.92 * light
                               : 0.588657 * root + 0.776431 * fourth - 0.364366 * std::sqrt(fourth);
    (encoded < shown ? low : high) = light;
  }
  return 0.5 * (low + high);
}

constexpr int SIDE = 40;                 // pixels along the target, one for each direction of the key light
constexpr int DIRECTIONS = SIDE * SIDE;  // over the whole sphere: what shines through counts, too
constexpr float DIM = 0.02f;             // so little light that it is not mapped to the screen's range
constexpr double ROUNDING = 0.004;       // of the sum over the directions

struct Subject {
  std::string shader, weave;
  double gloss = 0;
  bool hasFuzz = false;
};

std::string nameOf(const Subject& subject) {
  std::string name = subject.shader;
  if (subject.hasFuzz) name += "_fuzz";
  if (subject.shader == "fabric")
    name += "_" + subject.weave + "_" + std::to_string(static_cast<int>(std::lround(100 * subject.gloss)));
  return name;
}

std::vector<Subject> subjects() {
  std::vector<Subject> all{
      {"phong", ""}, {"diffuse", ""}, {"texture", ""}, {"bump", ""}, {"displacement", ""}};
  for (const std::string_view weave : weaves)
    for (const double gloss : {0.0, 0.5, 1.0}) all.push_back({"fabric", std::string(weave), gloss});
  for (const char* weave : {"twill", "velvet"}) all.push_back({"fabric", weave, 0, true});
  return all;
}

glm::vec3 spiral(int k) {  // evenly over the sphere
  const double y = 1 - 2 * (k + 0.5) / DIRECTIONS, around = k * std::numbers::pi * (3 - std::sqrt(5.0)),
               r = std::sqrt(1 - y * y);
  return glm::vec3(r * std::cos(around), r * std::sin(around), y);
}

// A flat white sheet in z = 0 that fills each pixel in turn.
class Furnace {
 public:
  explicit Furnace(const Subject& subject) : model_(shadingModelOf(settingsOf(subject), subject.hasFuzz)) {
    const RenderSettings settings = settingsOf(subject);
    program_ =
        gl::Program::makeRender("render/cloth.vert", "render/" + model_.name + ".frag", model_.defines);
    if (subject.hasFuzz)
      fuzz_ = gl::Program::makeRender("render/fuzz.vert", "render/fuzz.frag", model_.defines);
    textures_.choose(std::array{model_}, settings, {0, 0, 1});
    frame_.toKeyLight = frame_.toFillLight = {0, 0, 1, 0};
    setClothLook(settings, frame_);
    frame_.weft.r = frame_.weft.g = frame_.weft.b = 1;
    // Corners of a triangle over the whole viewport: position, normal, texture coordinates and tangent of
    // each.
    const std::array<float, 42> corners{-1, -1, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0,  //
                                        3,  -1, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0,  //
                                        -1, 3,  0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0};
    corners_ = gl::Buffer<float>("corners", corners);
    constexpr GLsizei stride = 14 * sizeof(float);
    vertices_.attach(corners_.name(), {POSITION_LOCATION, 4, stride, 0});
    vertices_.attach(corners_.name(), {NORMAL_LOCATION, 4, stride, 16});
    vertices_.attach(corners_.name(), {TEXTURE_COORDINATE_LOCATION, 2, stride, 32});
    vertices_.attach(corners_.name(), {TANGENT_LOCATION, 4, stride, 40});
    shared::ClothPiece piece{};
    piece.width = piece.height = piece.longer = piece.front = 1;
    piece_.upload(std::span(&piece, 1));
    lit_.begin();  // cleared: nothing throws a shadow
    lit_.end();
  }

  // What it sends to an eye so far off its normal, turned from u [degrees], of a key light from all around.
  double ofKeyLight(double angle, double turn) {
    lookFrom(angle, turn);
    std::vector<shared::RenderFrame> frames(DIRECTIONS, frame_);
    for (int k = 0; k < DIRECTIONS; ++k) {
      frames[static_cast<std::size_t>(k)].toKeyLight = glm::vec4(spiral(k), 0);
      frames[static_cast<std::size_t>(k)].keyColor = glm::vec4(DIM);
    }
    const std::vector<double> light = lightOf(frames);
    double sum = 0;
    for (const double each : light) sum += each;
    return sum / DIM * 4 / DIRECTIONS;  // a matte white sheet sends key times cosine
  }

  // The same of a sky that is bright everywhere.
  double ofSky(double angle, double turn) {
    lookFrom(angle, turn);
    std::vector<shared::RenderFrame> frames(1, frame_);
    frames[0].irradiance[0] = frames[0].skyColor = frames[0].bounceColor = glm::vec4(DIM);
    return lightOf(frames).front() / DIM;
  }

 private:
  static RenderSettings settingsOf(const Subject& subject) {
    RenderSettings settings;
    settings.shader = subject.shader;
    if (!subject.weave.empty()) settings.weave = subject.weave;
    settings.gloss = subject.gloss;
    settings.color = settings.backColor = {1, 1, 1};
    settings.threadSpacing = 1e-5;  // seen as their mean
    settings.height = 0;
    if (subject.hasFuzz) settings.fuzz = 0.002;
    return settings;
  }

  void lookFrom(double angle, double turn) {
    const double a = angle * std::numbers::pi / 180, b = turn * std::numbers::pi / 180;
    frame_.eye =
        glm::vec4(1e4 * glm::dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)), 0);
    frame_.clipFromWorld = glm::mat4(1);
  }

  // The light of each frame, with the shells of fuzz over it.
  std::vector<double> lightOf(const std::vector<shared::RenderFrame>& frames) {
    std::vector<double> light;
    for (const Seen& seen : drawn(program_, frames)) light.push_back(seen.light);
    constexpr int shells = 12;
    for (int k = 0; fuzz_ && k < shells; ++k) {
      glProgramUniform3f(fuzz_->name(), FUZZ_SHELL_UNIFORM, (static_cast<float>(k) + 0.5f) / shells,
                         1.0f / shells, 1);
      const std::vector<Seen> shell = drawn(*fuzz_, frames);
      for (std::size_t i = 0; i < light.size(); ++i) light[i] += shell[i].cover * (shell[i].light - light[i]);
    }
    return light;
  }

  struct Seen {
    double light = 0, cover = 0;  // red light
  };
  std::vector<Seen> drawn(const gl::Program& program, const std::vector<shared::RenderFrame>& frames) {
    constexpr std::size_t step = 4096;  // bytes from frame to frame, which every driver can bind
    static_assert(sizeof(shared::RenderFrame) <= step);
    std::vector<std::byte> bytes(step * frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k)
      std::memcpy(&bytes[step * k], &frames[k], sizeof(shared::RenderFrame));
    const gl::Buffer<std::byte> blocks("frames", bytes);
    target_.bind();
    const std::array<float, 4> nothing{};
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, nothing.data());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    program.bind();
    textures_.bind(model_);
    lit_.bindTextures();
    for (GLuint k = 0; k < SKY_DIRECTIONS; ++k) lit_.bindDepth(SKY_SHADOW_UNIT + k);
    piece_.bindUniform(CLOTH_GRID_BINDING);
    vertices_.bind();
    for (std::size_t k = 0; k < frames.size(); ++k) {
      blocks.bindUniformRange(RENDER_FRAME_BINDING, step * k, sizeof(shared::RenderFrame));
      glViewport(static_cast<GLint>(k % SIDE), static_cast<GLint>(k / SIDE), 1, 1);
      glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    std::vector<float> pixels(4 * DIRECTIONS);
    glGetTextureImage(target_.colorTexture(), 0, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
    std::vector<Seen> seen;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const double shown = static_cast<double>(pixels[4 * k]), cover = static_cast<double>(pixels[4 * k + 3]);
      seen.push_back({cover > 0 ? lightShownAs(shown / cover) : 0, cover});
    }
    return seen;
  }

  ShadingModel model_;
  gl::Program program_;
  std::optional<gl::Program> fuzz_;
  ModelTextures textures_;
  shared::RenderFrame frame_{};
  gl::Buffer<float> corners_;
  gl::VertexArray vertices_{"sheet"};
  gl::Buffer<shared::ClothPiece> piece_{"piece", 1};
  ShadowMap lit_{16};
  gl::Framebuffer target_{"furnace", {.width = SIDE, .height = SIDE, .color = GL_RGBA32F}};
};

class WhiteFurnace : public GlTest, public ::testing::WithParamInterface<Subject> {};

TEST_P(WhiteFurnace, GivesNoMoreThanItGets) {
  Furnace furnace(GetParam());
  for (const double angle : {0.0, 30.0, 55.0, 75.0, 85.0})
    for (const double turn : {0.0, 45.0, 90.0}) {
      const double key = furnace.ofKeyLight(angle, turn), sky = furnace.ofSky(angle, turn);
      const std::string seen =
          std::to_string(angle) + " degrees off the normal, turned by " + std::to_string(turn);
      EXPECT_LT(key, 1 + ROUNDING) << "of the key light, " << seen;
      EXPECT_LT(sky, 1 + ROUNDING) << "of the sky, " << seen;
      EXPECT_GT(key, 0.05) << "of the key light, " << seen;  // of a print, which is not white
      EXPECT_GT(sky, 0.05) << "of the sky, " << seen;
    }
}

INSTANTIATE_TEST_SUITE_P(All, WhiteFurnace, ::testing::ValuesIn(subjects()),
                         [](const auto& subject) { return nameOf(subject.param); });

// What is measured is right: a matte white sheet sends back all there is.
using WhiteFurnaceItself = GlTest;
TEST_F(WhiteFurnaceItself, GetsAllBackFromLambert) {
  Furnace furnace({"diffuse", ""});
  EXPECT_NEAR(furnace.ofKeyLight(30, 0), 1, ROUNDING);
  EXPECT_NEAR(furnace.ofSky(30, 0), 1, ROUNDING);
}

void expectSeenInFurnace(const std::string& file, const std::string& from, const std::string& to,
                         const std::string& subject) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change(file, from, to)) << file << " has changed: so must this test";
  const std::string test = "All/WhiteFurnace.GivesNoMoreThanItGets/" + subject;
  const test::CommandResult result = resources.runTests(test);
  EXPECT_NE(result.output.find("FAILED  ] " + test), std::string::npos) << result.output;
}

TEST(BrokenFurnace, SheenOverUndimmedThreadsIsSeen) {
  expectSeenInFurnace("render/fabric_light.glsl", "* sheenAlbedo(normalEye));", "* 0.0);", "fabric_plain_0");
}
TEST(BrokenFurnace, ShineOverUndimmedThreadsIsSeen) {
  expectSeenInFurnace("render/fabric_light.glsl", "(1.0 - shineShare(gloss)) *", "1.0 *", "fabric_satin_100");
}
TEST(BrokenFurnace, HighlightsOverUndimmedMatteAreSeen) {
  expectSeenInFurnace("render/lights.glsl", "strength * 8.0", "strength * 0.0", "bump");
}

}  // namespace
}  // namespace clothsim

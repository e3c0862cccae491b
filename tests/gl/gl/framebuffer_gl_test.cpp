#include "gl/framebuffer.h"

#include <array>

#include "core/error.h"
#include "gl/gl_test.h"

namespace clothsim {
namespace {

using FramebufferTest = GlTest;
using Pixel = std::array<int, 3>;

Pixel pixelAt(const std::vector<std::uint8_t>& rgb, int width, int x, int y) {
  const std::size_t i = 3 * static_cast<std::size_t>(y * width + x);
  return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

void clearRectangle(const gl::Framebuffer& framebuffer, std::array<int, 4> box, std::array<float, 4> color) {
  framebuffer.bind();
  glEnable(GL_SCISSOR_TEST);
  glScissor(box[0], box[1], box[2], box[3]);
  glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, color.data());
  glDisable(GL_SCISSOR_TEST);
}

TEST_F(FramebufferTest, IsReadTopRowFirst) {
  const gl::Framebuffer framebuffer("small", {.width = 5, .height = 4, .color = GL_RGBA8});
  clearRectangle(framebuffer, {0, 0, 5, 4}, {0, 0, 1, 1});
  clearRectangle(framebuffer, {0, 3, 5, 1},
                 {1, 0, 0, 1});  // OpenGL counts rows from the bottom: this is the top one
  const std::vector<std::uint8_t> rgb = framebuffer.readRgb();
  ASSERT_EQ(rgb.size(), 3u * 5u * 4u);
  EXPECT_EQ(pixelAt(rgb, 5, 4, 0), (Pixel{255, 0, 0}));
  EXPECT_EQ(pixelAt(rgb, 5, 4, 1), (Pixel{0, 0, 255}));
}

TEST_F(FramebufferTest, ResolvesSamplesIntoOneColour) {
  const int samples = gl::supportedSamples(4);
  ASSERT_EQ(samples, 4) << "OpenGL 4.5 promises four samples";
  const gl::Framebuffer many("many samples",
                             {.width = 8, .height = 8, .samples = samples, .color = GL_RGBA8});
  const gl::Framebuffer one("one sample", {.width = 8, .height = 8, .color = GL_RGBA8});
  clearRectangle(many, {0, 0, 8, 8}, {0.2f, 0.4f, 0.6f, 1});
  many.resolveInto(one);
  EXPECT_EQ(pixelAt(one.readRgb(), 8, 3, 3), (Pixel{51, 102, 153}));
}

TEST_F(FramebufferTest, HoldsDepthAlone) {
  const gl::Framebuffer shadow("shadow", {.width = 16, .height = 16, .depth = GL_DEPTH_COMPONENT24});
  const float depth = 0.25f;
  glClearNamedFramebufferfv(shadow.name(), GL_DEPTH, 0, &depth);
  std::vector<float> read(16 * 16);
  glGetTextureImage(shadow.depthTexture(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                    static_cast<GLsizei>(read.size() * sizeof(float)), read.data());
  EXPECT_NEAR(read[100], 0.25f, 1e-6f);
}

TEST_F(FramebufferTest, OfAFormatThatCannotBeDrawnToIsAnError) {
  EXPECT_THROW(gl::Framebuffer("wrong", {.width = 8, .height = 8, .color = GL_RGB9_E5}), OpenGlError);
  while (glGetError() != GL_NO_ERROR) {
  }
}

TEST_F(FramebufferTest, NeverHasMoreSamplesThanTheDriverOffers) {
  EXPECT_GE(gl::supportedSamples(1000), 4);
  EXPECT_LE(gl::supportedSamples(1000), 64);
  EXPECT_EQ(gl::supportedSamples(0), 1);
}

}  // namespace
}  // namespace clothsim

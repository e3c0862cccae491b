#include "render/shadow_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "shared/render_layout.h"

namespace clothsim {
namespace {

constexpr gl::FramebufferFormat floorFormat{
    .width = FLOOR_SHADOW_SIZE, .height = FLOOR_SHADOW_SIZE, .color = GL_R8};
constexpr float border =
    0.03f;  // of the map, around the casters, so that their shadows' soft edges are inside

// The casters' extent in light space, where z points to the light.
Bounds inLightSpace(const Bounds& box, const glm::mat4& lightFromWorld) {
  Bounds seen;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec4 c{(corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                      (corner & 4) != 0 ? box.high.z : box.low.z, 1};
    seen.add(glm::vec3(lightFromWorld * c));
  }
  return seen;
}

// Draws only to a part of a target of `size` x `size` texels, or to all of it.
void scissor(const FlatBounds* part, int size) {
  if (part == nullptr) return;
  const auto texel = [size](float at) {
    return static_cast<int>(std::clamp(at, 0.0f, 1.0f) * static_cast<float>(size));
  };
  const int left = texel(part->low.x), bottom = texel(part->low.y);
  glEnable(GL_SCISSOR_TEST);
  glScissor(left, bottom, std::max(0, std::min(size, texel(part->high.x) + 1) - left),
            std::max(0, std::min(size, texel(part->high.y) + 1) - bottom));
}

}  // namespace

ShadowMap::ShadowMap(int size)
    : framebuffer_("shadow map", {.width = size, .height = size, .depth = GL_DEPTH_COMPONENT24}),
      halfBlurred_("half blurred floor shadow", floorFormat),
      floorShadow_("floor shadow", floorFormat) {
  const GLuint texture = framebuffer_.depthTexture();
  glTextureParameteri(texture, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  // Outside of the map nothing is in the light's way.
  const std::array<float, 4> lit{1, 1, 1, 1};
  for (const GLuint each : {texture, floorShadow_.colorTexture()}) {
    glTextureParameteri(each, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTextureParameteri(each, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTextureParameterfv(each, GL_TEXTURE_BORDER_COLOR, lit.data());
  }
  glTextureParameteri(texture, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

void ShadowMap::cover(const Bounds& reach, glm::vec3 toLight) {
  const glm::vec3 up = std::abs(toLight.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::mat4 lightFromWorld = glm::lookAt(reach.center() + toLight, reach.center(), up);
  const Bounds seen = inLightSpace(reach, lightFromWorld);
  const float half = 0.5f * std::max(seen.size().x, seen.size().y) / (1 - 2 * border);
  texelLength_ = 2 * half / static_cast<float>(framebuffer_.format().width);
  const glm::vec3 middle = seen.center();
  // Depth is clamped instead of clipped (see begin()): what is farther than the casters is lit or shadowed
  // all the same.
  const glm::mat4 clipFromLight = glm::ortho(middle.x - half, middle.x + half, middle.y - half,
                                             middle.y + half, -seen.high.z, -seen.low.z);
  const glm::mat4 unitFromClip = glm::scale(glm::translate(glm::mat4(1), glm::vec3(0.5f)), glm::vec3(0.5f));
  shadowFromWorld_ = unitFromClip * clipFromLight * lightFromWorld;
}

void ShadowMap::begin(const FlatBounds* part) const {
  framebuffer_.bind();
  scissor(part, framebuffer_.format().width);
  glDepthMask(GL_TRUE);
  const float farthest = 1;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(0.5f, 1.0f);
}

void ShadowMap::end() const {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_SCISSOR_TEST);
}

void ShadowMap::blurForFloors(const RenderPrograms& programs, const FlatBounds* part) const {
  glDisable(GL_DEPTH_TEST);
  scissor(part, FLOOR_SHADOW_SIZE);
  noVertices_.bind();
  bindTextures();
  halfBlurred_.bind();
  programs.blurFirstAxis.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindTextureUnit(FLOOR_SHADOW_UNIT, halfBlurred_.colorTexture());
  floorShadow_.bind();
  programs.blurSecondAxis.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
}

void ShadowMap::bindDepth(GLuint unit) const { glBindTextureUnit(unit, framebuffer_.depthTexture()); }

void ShadowMap::bindTextures() const {
  glBindTextureUnit(SHADOW_MAP_UNIT, framebuffer_.depthTexture());
  glBindTextureUnit(FLOOR_SHADOW_UNIT, floorShadow_.colorTexture());
}

}  // namespace clothsim

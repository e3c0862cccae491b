#include "render/look.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/srgb.h"
#include "render/stage.h"
#include "render/stage_look.h"
#include "render/strain_scale.h"
#include "render/weaves.h"

namespace clothsim {
namespace {

float linear(double encoded) { return static_cast<float>(linearOfSrgb(encoded)); }

glm::vec4 linearOf(double red, double green, double blue) {
  return {linear(red), linear(green), linear(blue), 1};
}

// A direction given relative to the viewer's side of the scene: x to the right, y up, z towards the viewer.
glm::vec3 fromViewer(glm::vec3 front, glm::vec3 direction) {
  const glm::vec3 right = glm::cross(glm::vec3(0, 1, 0), front);
  return glm::normalize(direction.x * right + glm::vec3(0, direction.y, 0) + direction.z * front);
}

// The sky's light with the distribution of its picture, scaled so that the studio's exposure holds for it.
void addSky(const std::array<glm::vec3, 9>& sky, shared::RenderFrame& frame) {
  const glm::vec3 up = sky[0] + sky[2] - sky[8];  // on a surface that faces (0, 1, 0)
  const glm::vec3 scale = glm::vec3(frame.skyColor) / glm::max(up, 1e-6f);
  for (std::size_t i = 0; i < sky.size(); ++i) frame.irradiance[i] = glm::vec4(scale * sky[i], 0);
}

void addThreads(const RenderSettings& settings, shared::RenderFrame& frame) {
  Weave weave = weaveOf(settings.weave);
  weave.weftIsOther &= settings.shader == "fabric";  // no other model sees threads
  const double repeat = weave.across * settings.threadSpacing,
               repeatAlong = weave.along * weave.distance * settings.threadSpacing;
  // Silk is smooth where wool has loose fibres.
  constexpr double sheenOfWool = 0.44, sheenOfSilk = 0.04;
  const double sheen = weave.sheen * (sheenOfWool + (sheenOfSilk - sheenOfWool) * settings.gloss);
  frame.fabric = {static_cast<float>(1 / repeat), static_cast<float>(1 / repeatAlong),
                  static_cast<float>(settings.gloss), static_cast<float>(sheen)};
  frame.yarns = {static_cast<float>(weave.across), static_cast<float>(weave.along),
                 static_cast<float>(weave.unevenness), weave.isKnit ? 1.0f : 0.0f};
  frame.weft = frame.clothBack;
  frame.weft.w = weave.weftIsOther ? 1 : 0;
  frame.fuzz = static_cast<float>(std::max(settings.fuzz, weave.fuzz));
  frame.fuzzCover = static_cast<float>(weave.fuzzCover);
  frame.pile = weave.isPile ? 1.0f : 0.0f;
  if (weave.weftIsOther) frame.clothBack = frame.clothFront;  // the warp is there on both sides
}

void addStrainScale(const RenderSettings& settings, shared::RenderFrame& frame) {
  const std::vector<StrainStop> stops = strainScale(settings);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const auto [red, green, blue] = stops[i].srgb;
    frame.strainStops[i] =
        linearOf(static_cast<double>(red), static_cast<double>(green), static_cast<double>(blue));
  }
  frame.strainRange = static_cast<float>(settings.strainRange);
}

}  // namespace

glm::vec3 linearColor(Vec3d srgb) { return {linear(srgb.x), linear(srgb.y), linear(srgb.z)}; }

glm::vec4 drawnLook(const Collider& collider) {
  constexpr Vec3d porcelain{0.80, 0.82, 0.84};
  const SolidLook& look =
      std::visit([](const auto& shape) -> const SolidLook& { return shape.render; }, collider);
  const auto gloss = static_cast<float>(look.gloss);
  if (!look.color && std::holds_alternative<Plane>(collider)) return {-1, -1, -1, gloss};
  return {linearColor(look.color.value_or(porcelain)), gloss};
}

void setClothLook(const RenderSettings& settings, shared::RenderFrame& frame) {
  frame.clothFront = glm::vec4(linearColor(settings.color), 1);
  frame.clothBack = glm::vec4(linearColor(settings.backColor), 1);
  addThreads(settings, frame);
  frame.relief = {static_cast<float>(settings.normalStrength), static_cast<float>(settings.height),
                  static_cast<float>(settings.textureRepeat),
                  static_cast<float>(weaveOf(settings.weave).reverseGloss)};
}

glm::vec3 directionToKeyLight(const RenderSettings& settings, glm::vec3 front) {
  if (settings.light) return glm::normalize(toGlm(*settings.light));
  return fromViewer(front, stageLook(settings.stage).toKey);
}

shared::RenderFrame makeLook(const RenderSettings& settings, glm::vec3 front,
                             const std::array<glm::vec3, 9>& sky) {
  const StageLook& stage = stageLook(settings.stage);
  shared::RenderFrame frame{};
  frame.toKeyLight = glm::vec4(directionToKeyLight(settings, front), 0);
  frame.toFillLight = glm::vec4(fromViewer(front, stage.toFill), 0);
  frame.keyColor = glm::vec4(stage.key, 0);
  frame.fillColor = glm::vec4(stage.fill, 0);
  frame.skyColor = glm::vec4(stage.sky, 0);
  frame.bounceColor = glm::vec4(stage.bounce, 0);  // what the floor gives back
  frame.floorColor = glm::vec4(linearColor(stage.ground), 1);
  frame.ground = stage.surface;
  frame.backgroundTop = glm::vec4(stage.backdropTop, 1);
  frame.backgroundBottom = glm::vec4(stage.backdropBottom, 1);
  frame.backgroundGlow = {0.16f, 0.17f, 0.18f, stage.corners};
  frame.backgroundPlain = glm::vec4(linearColor(settings.backgroundColor), 1);
  setClothLook(settings, frame);
  addSky(sky, frame);
  addStrainScale(settings, frame);
  return frame;
}

}  // namespace clothsim

#include "render/look.h"

#include <cmath>
#include <vector>

#include "render/stage.h"
#include "render/strain_scale.h"
#include "render/weaves.h"

namespace clothsim {
namespace {

float linear(double encoded) {
  const double value = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  return static_cast<float>(value);
}

glm::vec4 linearColor(double red, double green, double blue) {
  return {linear(red), linear(green), linear(blue), 1};
}
glm::vec4 linearColor(Vec3d srgb) { return linearColor(srgb.x, srgb.y, srgb.z); }

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
  if (weave.weftIsOther) frame.clothBack = frame.clothFront;  // the warp is there on both sides
}

void addStrainScale(const RenderSettings& settings, shared::RenderFrame& frame) {
  const std::vector<StrainStop> stops = strainScale(settings);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const auto [red, green, blue] = stops[i].srgb;
    frame.strainStops[i] =
        linearColor(static_cast<double>(red), static_cast<double>(green), static_cast<double>(blue));
  }
  frame.strainRange = static_cast<float>(settings.strainRange);
}

}  // namespace

glm::vec3 directionToKeyLight(const RenderSettings& settings, glm::vec3 front) {
  if (settings.light) return glm::normalize(toGlm(*settings.light));
  return fromViewer(front, {-0.55f, 1.0f, 0.42f});
}

shared::RenderFrame makeLook(const RenderSettings& settings, glm::vec3 front,
                             const std::array<glm::vec3, 9>& sky) {
  shared::RenderFrame frame{};
  frame.toKeyLight = glm::vec4(directionToKeyLight(settings, front), 0);
  frame.toFillLight = glm::vec4(fromViewer(front, {0.9f, 0.25f, 0.35f}), 0);
  frame.keyColor = {1.22f, 1.15f, 1.04f, 0};   // a warm key
  frame.fillColor = {0.16f, 0.20f, 0.28f, 0};  // a cool fill from the other side
  frame.skyColor = {0.34f, 0.38f, 0.44f, 0};
  frame.bounceColor = {0.25f, 0.22f, 0.20f, 0};  // what the floor gives back
  frame.clothFront = linearColor(settings.color);
  frame.clothBack = linearColor(settings.backColor);
  frame.sphereColor = linearColor(0.80, 0.82, 0.84);
  frame.floorColor = linearColor(0.70, 0.73, 0.76);
  frame.backgroundTop = linearColor(0.32, 0.38, 0.45);
  frame.backgroundBottom = linearColor(0.62, 0.67, 0.72);
  frame.backgroundGlow = {0.16f, 0.17f, 0.18f, 0};
  frame.backgroundPlain = linearColor(settings.backgroundColor);
  addThreads(settings, frame);
  frame.relief = {static_cast<float>(settings.normalStrength), static_cast<float>(settings.height),
                  static_cast<float>(settings.textureRepeat), 0};
  addSky(sky, frame);
  addStrainScale(settings, frame);
  return frame;
}

}  // namespace clothsim

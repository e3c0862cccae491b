#include "cloth/material_look.h"

#include <algorithm>
#include <array>

#include "cloth/material.h"

namespace clothsim {
namespace {

struct Look {
  std::string_view material, weave;
  double threadSpacing, gloss;  // thread counts of such fabrics in shops
  Vec3d color, backColor;
  double fuzz = 0;
};

constexpr std::array<Look, 7> looks{{
    {"silk", "satin", 0.00025, 0.85, {0.56, 0.05, 0.13}, {0.62, 0.14, 0.20}},
    {"cotton", "plain", 0.0004, 0.15, {0.87, 0.85, 0.79}, {0.87, 0.85, 0.79}},
    {"denim", "denim", 0.0004, 0.15, {0.045, 0.105, 0.25}, {0.68, 0.66, 0.61}},  // warp and weft
    {"wool", "twill", 0.0009, 0.0, {0.47, 0.33, 0.22}, {0.47, 0.33, 0.22}, 0.002},
    {"jersey", "jersey", 0.0009, 0.1, {0.46, 0.51, 0.58}, {0.46, 0.51, 0.58}},
    {"rubber", "none", 0.0015, 0.55, {0.13, 0.13, 0.14}, {0.13, 0.13, 0.14}},
    {"paper", "none", 0.0015, 0.1, {0.93, 0.92, 0.88}, {0.93, 0.92, 0.88}},
}};

int valuesInCommon(const Material& a, const Material& b) {
  return (a.density == b.density) + (a.stretch == b.stretch) + (a.stretchWarp == b.stretchWarp) +
         (a.shear == b.shear) + (a.bend == b.bend) + (a.bendWarp == b.bendWarp) + (a.damping == b.damping) +
         (a.thickness == b.thickness) + (a.friction == b.friction);
}

const Look* lookOf(const Material& material) {
  constexpr int fewest = 5;  // of nine; presets share four with each other at most
  const Look* nearest = nullptr;
  int most = fewest - 1;
  for (const Look& look : looks) {
    const int common = valuesInCommon(material, *materialPreset(look.material));
    if (common > most) nearest = &look;
    most = std::max(most, common);
  }
  return nearest;
}

}  // namespace

RenderSettings usualLook(const ClothSettings& cloth) {
  RenderSettings render;
  const std::optional<Material>& material = cloth.material;
  const Look* look = material ? lookOf(*material) : nullptr;
  if (look == nullptr) return render;
  render.weave = look->weave;
  render.threadSpacing = look->threadSpacing;
  render.gloss = look->gloss;
  render.fuzz = look->fuzz;
  render.color = look->color;
  render.backColor = look->backColor;
  return render;
}

RenderSettings usualLook(const Scene& scene) { return usualLook(scene.cloths.front()); }

void followLook(RenderSettings& render, const RenderSettings& before, const RenderSettings& after) {
  const auto follow = [&](auto member) {
    if (render.*member == before.*member) render.*member = after.*member;
  };
  follow(&RenderSettings::weave);
  follow(&RenderSettings::threadSpacing);
  follow(&RenderSettings::gloss);
  follow(&RenderSettings::fuzz);
  follow(&RenderSettings::color);
  follow(&RenderSettings::backColor);
}

RenderSettings lookOf(const Scene& scene, std::size_t cloth) {
  const ClothSettings& settings = scene.cloths[cloth];
  RenderSettings look = scene.render;
  followLook(look, usualLook(scene), usualLook(settings));
  forEachOfLook([&](auto own, auto ofScene) {
    if (const auto& value = settings.render.*own) look.*ofScene = *value;
  });
  return look;
}

}  // namespace clothsim

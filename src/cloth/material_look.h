// How fabrics look: what a scene's `render` holds where it names a material and says nothing else.
#pragma once

#include "scene/scene.h"

namespace clothsim {

// The look of a cloth's material: of that preset with which it has most values in common, so that denim that
// bends more easily is still denim. RenderSettings{} without a material, or where it is like none of them.
[[nodiscard]] RenderSettings usualLook(const ClothSettings& cloth);
// That of the first cloth, over which the keys of the scene's `render` are read.
[[nodiscard]] RenderSettings usualLook(const Scene& scene);

// After a change of the material: what `render` had from the look before, it has from the one after.
void followLook(RenderSettings& render, const RenderSettings& before, const RenderSettings& after);

// How one of the scene's cloths is drawn: what its own `render` says, else what the scene's says otherwise
// than usualLook(scene), else what is usual for its own material.
[[nodiscard]] RenderSettings lookOf(const Scene& scene, std::size_t cloth);

// Calls `visit(own, ofScene)` with each member of ClothLook and the member of RenderSettings that it
// replaces.
template <class Visit>
void forEachOfLook(Visit visit) {
  using L = ClothLook;
  using R = RenderSettings;
  visit(&L::color, &R::color);
  visit(&L::backColor, &R::backColor);
  visit(&L::texture, &R::texture);
  visit(&L::textureRepeat, &R::textureRepeat);
  visit(&L::weave, &R::weave);
  visit(&L::threadSpacing, &R::threadSpacing);
  visit(&L::gloss, &R::gloss);
  visit(&L::fuzz, &R::fuzz);
  visit(&L::normalStrength, &R::normalStrength);
  visit(&L::height, &R::height);
  visit(&L::thickness, &R::thickness);
}

}  // namespace clothsim

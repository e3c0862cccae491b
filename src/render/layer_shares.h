// How far the smooth surface may leave the particles' triangles where layers lie on each other. Contact keeps
// the triangles apart, by as little as a fabric is thick; in bends the smooth surface leaves them by more
// than that. Layers that would come nearer to each other than half of their triangles' distance share it.
// Computed on the GPU from the particles alone, whatever simulates them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "cloth/cloth.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "shared/render_layout.h"

namespace clothsim {

// Making them throws OpenGlError and InputOutputError.
struct LayerPrograms {
  gl::Program bulges = gl::Program::makeCompute("render/layer_bulges.comp");
  gl::Program patchBulges = gl::Program::makeCompute("render/layer_bulges.comp", {{"PATCHES", ""}});
  gl::Program insert = gl::Program::makeCompute("render/layer_shares.comp", {{"INSERT", ""}});
  gl::Program share = gl::Program::makeCompute("render/layer_shares.comp");
  gl::Program shareAgain = gl::Program::makeCompute("render/layer_shares.comp", {{"AGAIN", ""}});
};

class LayerShares {
 public:
  // Of the triangles of particles that are left of a cloth, whose layers contact keeps `distance` [m] apart.
  // What is within LAYERS_APART cells of each other at the start is no other layer.
  LayerShares(const Cloth& cloth, std::span<const std::array<std::uint32_t, 3>> triangles, double distance);

  // For layer_bulges.comp: the triangles, and how far the smooth surface is from the middle of each [m].
  void bindBulges() const;
  // For the particles at `positions`, a vec4 each, after layer_bulges.comp.
  void compute(const LayerPrograms& programs, GLuint positions);
  // A float a particle, 0 to 1: which part of its way from the triangles the smooth surface goes.
  [[nodiscard]] const gl::Buffer<float>& shares() const { return shares_; }

 private:
  gl::Buffer<shared::LayerSearch> search_;
  gl::Buffer<std::uint32_t> corners_, heads_;
  gl::Buffer<glm::vec4> entries_, bulges_, restPlaces_;
  gl::Buffer<float> before_, shares_;
};

}  // namespace clothsim

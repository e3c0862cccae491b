// The springs as lines of a colour for each kind, and the pinned particles as dots, over any shading model.
#pragma once

#include <array>
#include <optional>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/vertex_array.h"

namespace clothsim {

// What a viewer shows on top of any shading model; belongs to no scene.
struct ViewOptions {
  std::array<bool, 3> showSprings{};  // structural, shear, bending: as SpringKind counts
  bool showPins = false;
  friend bool operator==(const ViewOptions&, const ViewOptions&) = default;
};

struct OverlayPrograms {
  gl::Program springs =
      gl::Program::makeRender("render/springs.vert", "render/springs.geom", "render/springs.frag");
  gl::Program pins = gl::Program::makeRender("render/pins.vert", "render/pins.frag");
};

// sRGB, 0 to 1; for a legend. Colours that people with any colour vision tell apart.
[[nodiscard]] std::array<float, 3> springColor(SpringKind kind);

class SpringsOverlay {
 public:
  SpringsOverlay() : vertices_("springs") {}

  void forgetCuts() { kinds_ = {}; }  // after cuts have changed: lists are made anew when next needed
  // Where nothing lies before it; the caller has blending on, and writing of depth off. Pins are drawn larger
  // by `pinScale`.
  void draw(const ViewOptions& view, const OverlayPrograms& programs, const Cloth& cloth, const Cuts& cuts,
            GLuint positions, float pinScale);

 private:
  gl::VertexArray vertices_;
  std::array<std::optional<gl::Buffer<std::uint32_t>>, 3> kinds_;  // pairs of particles
  std::optional<float> pinSize_;
};

}  // namespace clothsim

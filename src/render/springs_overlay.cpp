#include "render/springs_overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shared/render_layout.h"

namespace clothsim {
namespace {

// Structural lies over bending, which covers the same way twice as far: the wider line goes first.
constexpr std::array<SpringKind, 3> drawingOrder{SpringKind::bending, SpringKind::shear,
                                                 SpringKind::structural};

// Of a pin's mark: a whole row of them is not to hide the cloth.
float pinSize(const Cloth& cloth) {
  constexpr float smallest = 0.4f, fewPins = 16;
  const auto masses = cloth.inverseMasses();
  const auto pins = static_cast<float>(std::count(masses.begin(), masses.end(), 0));
  return std::max(smallest, std::sqrt(fewPins / std::max(fewPins, pins)));
}

std::vector<std::uint32_t> endsOf(const Cloth& cloth, const Cuts& cuts, SpringKind kind) {
  std::vector<std::uint32_t> ends;
  for (const Spring& spring : cloth.springs()) {
    if (spring.kind != kind || isCut(cuts, cloth, spring)) continue;
    ends.push_back(spring.a);
    ends.push_back(spring.b);
  }
  return ends;
}

}  // namespace

std::array<float, 3> springColor(SpringKind kind) {
  switch (kind) {
    case SpringKind::structural:
      return {0.99f, 0.97f, 0.90f};
    case SpringKind::shear:
      return {0.34f, 0.71f, 0.91f};
    case SpringKind::bending:
      return {0.90f, 0.53f, 0.05f};
  }
  return {1, 1, 1};
}

void SpringsOverlay::draw(const ViewOptions& view, const OverlayPrograms& programs, const Cloth& cloth,
                          const Cuts& cuts, GLuint positions, float pinScale) {
  vertices_.attach(positions, {.location = POSITION_LOCATION});
  vertices_.bind();
  programs.springs.bind();
  for (const SpringKind kind : drawingOrder) {
    const auto number = static_cast<std::size_t>(kind);
    if (!view.showSprings[number]) continue;
    auto& ends = kinds_[number];
    if (!ends) ends.emplace("spring ends", endsOf(cloth, cuts, kind));
    const auto [red, green, blue] = springColor(kind);
    // All vertices have the colour, and in w the width [pixels].
    glVertexAttrib4f(LINE_LOOK_LOCATION, red, green, blue, kind == SpringKind::bending ? 3.4f : 1.5f);
    vertices_.attachIndices(ends->name());
    glDrawElements(GL_LINES, static_cast<GLsizei>(ends->size()), GL_UNSIGNED_INT, nullptr);
  }
  if (view.showPins) {
    glEnable(GL_PROGRAM_POINT_SIZE);
    programs.pins.bind();
    if (!pinSize_) pinSize_ = pinSize(cloth);
    glVertexAttrib4f(LINE_LOOK_LOCATION, 0, 0, 0, pinScale * *pinSize_);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(cloth.particleCount()));
    glDisable(GL_PROGRAM_POINT_SIZE);
  }
}

}  // namespace clothsim

// How much a picture may cost: draft, normal or final.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace clothsim {

struct RenderOptions {
  int sphereSegmentsAround = 64;  // -a: horizontal segments of drawn spheres, >= 3
  int sphereSegmentsDown = 48;    // -o: vertical segments, >= 2
  int samples = 4;                // multisampling, 1 to what the driver offers
  int shadowMapSize = 1024;  // texels along each side; a smaller map is faster and its shadows are softer
  bool shadows = true;
  // How often, at most, the sides of the cloth's triangles are halved for a smooth surface, as its size in
  // the picture asks for, 0 to 3; 0: it is drawn by the particles' own triangles.
  int subdivisions = 3;
  double flatness =
      0;  // halved only where it is seen by so much [pixels]; 0: everywhere, for highlights' sake
  bool thick = false;  // the cloth as thick as it is, with round edges, where that is seen
  // Light is worked out at the cloth's vertices where these are so dense in the picture that nobody sees it:
  // a software renderer shades pixels in blocks, of which a small triangle needs as many as a large one.
  bool lightsVertices = false;
  // Draws only where a picture differs from the one before, with the same pixels. It reads particles back,
  // which is next to nothing where the device is the processor, and a stall elsewhere.
  bool keepsStill = false;
};

// Of how many exposures a picture in final quality is the mean, and may be.
inline constexpr int FINAL_EXPOSURES = 64, MOST_EXPOSURES = 4096;

enum class Quality { draft, normal, final };
inline constexpr std::array<std::string_view, 3> qualityNames{"draft", "normal", "final"};

[[nodiscard]] inline std::string_view nameOf(Quality quality) {
  return qualityNames[static_cast<std::size_t>(quality)];
}
[[nodiscard]] inline std::optional<Quality> qualityNamed(std::string_view name) {
  for (std::size_t i = 0; i < qualityNames.size(); ++i)
    if (qualityNames[i] == name) return static_cast<Quality>(i);
  return std::nullopt;
}

// @param software  the renderer is the processor, to which every sample costs time
[[nodiscard]] inline RenderOptions withQuality(RenderOptions options, Quality quality, bool software) {
  const bool oneSample = quality == Quality::draft || (quality == Quality::normal && software);
  options.samples = oneSample ? 1 : 4;  // of one sample a pixel, edges are smoothed afterwards
  options.shadowMapSize = quality == Quality::draft ? 512 : 1024;
  // To a software renderer many small triangles cost as much as many pixels.
  const bool lean = quality == Quality::normal && software;
  options.subdivisions = quality == Quality::draft ? 0 : lean ? 1 : 3;
  options.flatness = lean ? 0.25 : 0;
  options.thick = quality != Quality::draft;
  options.lightsVertices = software && quality == Quality::draft;
  options.keepsStill = software && quality != Quality::final;
  return options;
}

// Of pictures that are the mean of so many exposures, which smooth edges and shadows by themselves
// (render/exposure.h).
[[nodiscard]] inline RenderOptions forExposures(RenderOptions options, int exposures) {
  if (exposures == 1) return options;
  options.samples = 1;
  options.shadowMapSize = 2048;
  return options;
}

// What a picture may take on a software renderer before its scene is drawn in fewer pixels [s]; 0: as long as
// it takes.
[[nodiscard]] inline double pictureBudget(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return 0.015;
    case Quality::normal:
      return 0.030;
    case Quality::final:
      return 0;
  }
  return 0;
}

}  // namespace clothsim

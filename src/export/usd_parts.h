// Text of USD files (openusd.org) for what stands around the cloth, and what all its prims are written with.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "export/text_numbers.h"
#include "scene/colliders/collider_set.h"
#include "scene/scene.h"

namespace clothsim {

[[nodiscard]] std::string usdNumber(double value);
void appendUsdVector(std::string& text, Vec3f v);

// "[a, b, c]", each element by `append`.
template <class Range, class Append>
void appendUsdArray(std::string& text, const Range& range, Append append) {
  text += '[';
  bool first = true;
  for (const auto& element : range) {
    if (!std::exchange(first, false)) text += ", ";
    append(element);
  }
  text += ']';
}

struct UsdBox {
  Vec3f low, high;
};

// A saved frame: its number, which is the time code, the time [s], and where each solid stands then, as a
// matrix.
struct UsdFrame {
  int code = 0;
  double time = 0;
  std::vector<std::string> solids = {};
};
[[nodiscard]] std::vector<std::string> usdMatrices(const ColliderSet& colliders, double time);

// The materials of cloth and solids, the solids on their ways, and the camera. The scene is that of the
// start. Spheres are prims of that kind, planes squares, all others meshes, in the shape of each frame.
// `cloth` is the box around it at the start: a camera that the scene does not place looks at it, and squares
// lie below it.
[[nodiscard]] std::string usdSurroundings(const Scene& scene, const UsdBox& cloth,
                                          const std::vector<UsdFrame>& frames);

// The name of a cloth's material.
[[nodiscard]] std::string usdClothMaterial(const Scene& scene, std::size_t cloth);

}  // namespace clothsim

#include "export/usd_parts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "cloth/material_look.h"
#include "export/surface_color.h"
#include "scene/colliders/solid_mesh.h"
#include "scene/pose.h"

namespace clothsim {
namespace {

std::string colorText(Vec3d color) {
  std::string text;
  appendUsdVector(text, linearFromSrgb(color).cast<float>());
  return text;
}

std::string materialText(const std::string& name, Vec3d color, double roughness) {
  return "        def Material \"" + name +
         "\"\n        {\n            token outputs:surface.connect = " + "</clothsim/materials/" + name +
         "/surface.outputs:surface>\n\n" + "            def Shader \"surface\"\n            {\n" +
         "                uniform token info:id = \"UsdPreviewSurface\"\n" +
         "                color3f inputs:diffuseColor = " + colorText(color) + "\n" +
         "                float inputs:roughness = " + usdNumber(roughness) + "\n" +
         "                token outputs:surface\n            }\n        }\n";
}

const SolidLook& solidLookOf(const Collider& collider) {
  return std::visit([](const auto& shape) -> const SolidLook& { return shape.render; }, collider);
}

// One for all, but for those that the scene gives a look of their own.
std::string solidMaterial(const Scene& scene, std::size_t number) {
  return solidLookOf(scene.colliders[number]) == SolidLook{} ? "solid" : "solid" + std::to_string(number);
}

std::string materials(const Scene& scene) {
  constexpr Vec3d gray{0.5, 0.5, 0.5};
  std::string text = "    def Scope \"materials\"\n    {\n";
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const RenderSettings look = lookOf(scene, i);
    text += materialText(usdClothMaterial(scene, i), look.color, clothRoughness(look));
  }
  text += materialText("solid", gray, 0.6);
  for (std::size_t i = 0; i < scene.colliders.size(); ++i)
    if (const SolidLook& look = solidLookOf(scene.colliders[i]); look != SolidLook{})
      text += materialText(solidMaterial(scene, i), look.color.value_or(gray), 1 - 0.8 * look.gloss);
  return text + "    }\n";
}

// A frame that stands in the world: USD multiplies rows by matrices, so that the axes are rows.
std::string matrixText(const std::array<Vec3d, 3>& axes, Vec3d place) {
  std::string text = "( ";
  const auto appendRow = [&](Vec3d v, const char* end) {
    text += '(';
    for (const double value : {v.x, v.y, v.z}) text.append(usdNumber(value)).append(", ");
    text += end;
  };
  for (const Vec3d& axis : axes) appendRow(axis, "0), ");
  appendRow(place, "1) )");
  return text;
}

constexpr const char* TRANSFORM_ORDER =
    "            uniform token[] xformOpOrder = [\"xformOp:transform\"]\n";

std::string transformText(std::size_t i, const std::vector<UsdFrame>& frames) {
  const std::string& first = frames.front().solids[i];
  std::string text = "            matrix4d xformOp:transform";
  if (std::ranges::all_of(frames, [&](const UsdFrame& frame) { return frame.solids[i] == first; }))
    return text + " = " + first + "\n" + TRANSFORM_ORDER;
  text += ".timeSamples = {\n";
  for (const UsdFrame& frame : frames)
    text += "                " + std::to_string(frame.code) + ": " + frame.solids[i] + ",\n";
  return text + "            }\n" + TRANSFORM_ORDER;
}

std::string sphereShape(const Sphere& sphere) {
  const auto r = static_cast<float>(sphere.radius);
  std::string text = "            double radius = ";
  text.append(usdNumber(sphere.radius)).append("\n            float3[] extent = [");
  appendUsdVector(text, {-r, -r, -r});
  text += ", ";
  appendUsdVector(text, {r, r, r});
  return text + "]\n";
}

std::string pointsText(const Surface& surface) {
  std::string text;
  appendUsdArray(text, surface.vertices, [&](const auto& v) { appendUsdVector(text, v.position); });
  return text;
}
std::string normalsText(const Surface& surface) {
  std::string text;
  appendUsdArray(text, surface.vertices, [&](const auto& v) { appendUsdVector(text, v.normal); });
  return text;
}

std::string meshShape(const Surface& surface) {
  std::string text =
      "            uniform token subdivisionScheme = \"none\"\n            int[] faceVertexCounts = ";
  appendUsdArray(text, std::vector<int>(surface.indices.size() / 3), [&](int) { text += '3'; });
  text += "\n            int[] faceVertexIndices = ";
  appendUsdArray(text, surface.indices, [&](std::uint32_t corner) { appendIndex(text, corner); });
  text += "\n            point3f[] points = " + pointsText(surface) +
          "\n            normal3f[] normals = " + normalsText(surface);
  return text + " (\n                interpolation = \"vertex\"\n            )\n";
}

// The same triangles in each frame.
std::string deformingShape(const ColliderSet& colliders, std::size_t i, const std::vector<UsdFrame>& frames) {
  std::string points = "            point3f[] points.timeSamples = {\n",
              normals = "            normal3f[] normals.timeSamples = {\n";
  for (const UsdFrame& frame : frames) {
    const Surface surface = colliders.drawnSurface(i, 0, frame.time);
    const std::string code = "                " + std::to_string(frame.code) + ": ";
    points += code + pointsText(surface) + ",\n";
    normals += code + normalsText(surface) + ",\n";
  }
  return meshShape(colliders.drawnSurface(i, 0, frames.front().time)) + points + "            }\n" + normals +
         "            }\n";
}

// A square of the plane around the foot of `middle`, in the plane's own frame, whose normal is y.
Surface planeSquare(const ColliderSet& colliders, std::size_t i, double time, Vec3d middle, double half) {
  const Vec3d foot = rotateBack(colliders.rotationAt(i, time), middle - poseAt(colliders[i], time).position);
  Surface surface;
  for (const auto& [x, z] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}})
    surface.vertices.push_back({Vec3d{foot.x + x * half, 0, foot.z + z * half}.cast<float>(), {0, 1, 0}});
  surface.indices = {0, 1, 2, 0, 2, 3};
  return surface;
}

std::string solidsText(const Scene& scene, Vec3d middle, double size, const std::vector<UsdFrame>& frames) {
  const ColliderSet colliders(scene);
  std::string text = "    def Scope \"solids\"\n    {\n";
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const auto* sphere = std::get_if<Sphere>(&colliders[i]);
    constexpr double squares = 4;  // times the size of the cloth to each side
    text += std::string("        def ") + (sphere != nullptr ? "Sphere" : "Mesh") + " \"" +
            std::string(typeOf(colliders[i])) + std::to_string(i) +
            "\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n        )\n        {\n"
            "            rel material:binding = </clothsim/materials/" +
            solidMaterial(scene, i) + ">\n";
    if (sphere != nullptr)
      text += sphereShape(*sphere);
    else if (std::holds_alternative<Plane>(colliders[i]))
      text += meshShape(planeSquare(colliders, i, frames.front().time, middle, squares * size));
    else if (deforms(colliders[i]))
      text += deformingShape(colliders, i, frames);
    else
      text += meshShape(colliders.drawnSurface(i, 0));
    text += transformText(i, frames) + "        }\n";
  }
  return text + "    }\n";
}

std::string cameraText(const CameraSettings& wanted, Vec3d middle, double size) {
  const double halfAngle = 0.5 * wanted.fov * std::numbers::pi / 180;
  const Vec3d target = wanted.target.value_or(middle);
  const Vec3d position =
      wanted.position.value_or(target + (0.5 * size / std::sin(halfAngle)) * unitVector({0.5, 0.3, 0.8}));
  const Vec3d back = unitVector(position - target);
  const Vec3d right = unitVector(cross(std::abs(back.y) < 0.9999 ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1}, back));
  constexpr double filmHeight = 24;  // in units of the focal length: only their ratio shows
  return "    def Camera \"camera\"\n    {\n        float2 clippingRange = (0.01, 1000)\n"
         "        float focalLength = " +
         usdNumber(0.5 * filmHeight / std::tan(halfAngle)) +
         "\n        float verticalAperture = " + usdNumber(filmHeight) +
         "\n        float horizontalAperture = " + usdNumber(filmHeight * 16 / 9) +
         "\n        matrix4d xformOp:transform = " + matrixText({right, cross(back, right), back}, position) +
         "\n        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }\n";
}

}  // namespace

std::string usdNumber(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value + 0.0).ptr};
}

void appendUsdVector(std::string& text, Vec3f v) {
  text += '(';
  appendNumber(text, v.x);
  text += ", ";
  appendNumber(text, v.y);
  text += ", ";
  appendNumber(text, v.z);
  text += ')';
}

std::string usdClothMaterial(const Scene& scene, std::size_t cloth) {
  return scene.cloths.size() == 1 ? "cloth" : "cloth" + std::to_string(cloth);
}

std::vector<std::string> usdMatrices(const ColliderSet& colliders, double time) {
  std::vector<std::string> matrices;
  for (std::size_t i = 0; i < colliders.size(); ++i)
    matrices.push_back(
        matrixText(transposed(colliders.rotationAt(i, time)), poseAt(colliders[i], time).position));
  return matrices;
}

std::string usdSurroundings(const Scene& scene, const UsdBox& cloth, const std::vector<UsdFrame>& frames) {
  const Vec3d low = cloth.low.cast<double>(), high = cloth.high.cast<double>();
  const Vec3d middle = 0.5 * (low + high);
  const double size = length(high - low);
  return materials(scene) + (scene.colliders.empty() ? "" : solidsText(scene, middle, size, frames)) +
         cameraText(scene.camera, middle, size > 0 ? size : 1);
}

}  // namespace clothsim

// .glb read by the words of its specification (Khronos, glTF 2.0, 4.4 "GLB File Format Specification").
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "export/formats.h"
#include "unit/export/small_cloth.h"

namespace clothsim {
namespace {

struct Glb {
  nlohmann::json json;
  std::string bytes;

  template <class Number>
  [[nodiscard]] std::vector<Number> numbers(std::size_t accessor) const {
    const auto& a = json["accessors"][accessor];
    const auto& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t width = a["type"] == "SCALAR" ? 1 : a["type"] == "VEC2" ? 2 : 3;
    std::vector<Number> result(a["count"].get<std::size_t>() * width);
    const std::size_t offset =
        view.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
    std::memcpy(result.data(), bytes.data() + offset, result.size() * sizeof(Number));
    return result;
  }
};

std::uint32_t wordAt(const std::string& bytes, std::size_t place) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + place, sizeof word);
  return word;
}

Glb read(const std::string& file) {
  EXPECT_EQ(file.substr(0, 4), "glTF");
  EXPECT_EQ(wordAt(file, 4), 2u);
  EXPECT_EQ(wordAt(file, 8), file.size());
  const std::uint32_t length = wordAt(file, 12);
  EXPECT_EQ(length % 4, 0u);
  EXPECT_EQ(file.substr(16, 4), "JSON");
  const std::size_t end = 20 + std::size_t{length};  // what follows is binary, if anything does
  return {nlohmann::json::parse(file.substr(20, length)), end < file.size() ? file.substr(end + 8) : ""};
}

TEST(Gltf, HoldsEachClothAsAMeshWithItsOwnPoints) {
  Scene scene = test::smallScene();
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].numWidthPoints = 4;
  scene.cloths[1].position = {0, 0.5, 0.25};
  const Cloth cloth(scene);
  const State state = test::smallState(cloth);
  const Glb glb = read(formatGlb(state, cloth));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  ASSERT_EQ(glb.json["meshes"].size(), 2u);
  std::size_t particle = 0;
  for (std::size_t m = 0; m < 2; ++m) {
    const Piece& piece = cloth.pieces()[m];
    const auto& primitive = glb.json["meshes"][m]["primitives"][0];
    const auto positions = glb.numbers<float>(primitive["attributes"]["POSITION"]);
    ASSERT_EQ(positions.size(), 3 * std::size_t{piece.particleCount()});
    for (std::size_t i = 0; i < positions.size() / 3; ++i, ++particle) {
      EXPECT_EQ(positions[3 * i], state.positions[particle].x);
      EXPECT_EQ(positions[3 * i + 1], state.positions[particle].y);
      EXPECT_EQ(positions[3 * i + 2], state.positions[particle].z);
    }
    const auto normals = glb.numbers<float>(primitive["attributes"]["NORMAL"]);
    for (std::size_t i = 0; i < normals.size(); ++i) EXPECT_EQ(normals[i], i % 3 == 1 ? 1 : 0);
    // From the upper edge, as glTF counts v: row 0 of a lying cloth is the upper one.
    const auto coordinates = glb.numbers<float>(primitive["attributes"]["TEXCOORD_0"]);
    EXPECT_EQ(coordinates[1], 0);
    EXPECT_EQ(coordinates.back(), 1);
    EXPECT_EQ(glb.json["accessors"][primitive["indices"].get<std::size_t>()]["count"],
              6u * static_cast<unsigned>(piece.columns - 1));
  }
  EXPECT_TRUE(glb.json["materials"][0]["doubleSided"].get<bool>());
}

TEST(Gltf, LeavesOutTrianglesThatAreCut) {
  const Cloth cloth(test::smallScene());
  State state = test::smallState(cloth);
  ASSERT_TRUE(cutAlong(state.cuts, cloth, 0, {0.5, -1}, {0.5, 2}));
  const Glb glb = read(formatGlb(state, cloth));
  const std::size_t indices = glb.json["meshes"][0]["primitives"][0]["indices"];
  EXPECT_EQ(glb.json["accessors"][indices]["count"], 6u);
}

TEST(Gltf, LeavesOutAClothOfWhichNoTriangleIsLeft) {
  Scene scene = test::smallScene();
  scene.cloths.push_back(scene.cloths[0]);
  const Cloth cloth(scene);
  State state = test::smallState(cloth);
  ASSERT_TRUE(cutAlong(state.cuts, cloth, 0, {-1, 0.5}, {3, 0.5}));
  const Glb glb = read(formatGlb(state, cloth));
  ASSERT_EQ(glb.json["meshes"].size(), 1u);
  const std::size_t indices = glb.json["meshes"][0]["primitives"][0]["indices"];
  EXPECT_EQ(glb.json["accessors"][indices]["count"], 12u);
  ASSERT_TRUE(cutAlong(state.cuts, cloth, 1, {-1, 0.5}, {3, 0.5}));
  const Glb empty = read(formatGlb(state, cloth));
  EXPECT_FALSE(empty.json.contains("meshes")) << "an empty list is not allowed";
  EXPECT_EQ(empty.json["nodes"].size(), 1u);
  EXPECT_EQ(empty.bytes, "") << "no buffer";
}

TEST(Gltf, HasAMaterialForEachCloth) {
  Scene scene = test::smallScene();
  scene.render.color = {1, 0.5, 0};
  scene.render.gloss = 0;
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].render.color = Vec3d{0, 0, 1};
  scene.cloths[1].render.gloss = 1;
  const Cloth cloth(scene);
  const Glb glb = read(formatGlb(test::smallState(cloth), cloth, &scene));
  EXPECT_FALSE(glb.json.contains("extensionsUsed"));
  ASSERT_EQ(glb.json["materials"].size(), 2u);
  const double green[] = {0.214041144, 0}, blue[] = {0, 1}, roughness[] = {1, 0.3};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(glb.json["meshes"][i]["primitives"][0]["material"], i);
    const auto& material = glb.json["materials"][i];
    EXPECT_EQ(material["name"], "cloth" + std::to_string(i));
    EXPECT_TRUE(material["doubleSided"].get<bool>());
    const auto& pbr = material["pbrMetallicRoughness"];
    EXPECT_NEAR(pbr["baseColorFactor"][1].get<double>(), green[i], 1e-6);
    EXPECT_NEAR(pbr["baseColorFactor"][2].get<double>(), blue[i], 1e-6);
    EXPECT_NEAR(pbr.value("roughnessFactor", 1.0), roughness[i], 1e-6);
  }
}

}  // namespace
}  // namespace clothsim

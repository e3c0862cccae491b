// Seams of a texture: what a point has several texture coordinates for, in files that are read back.
#include "export/texture_points.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cloth/mesh_shape.h"
#include "core/files.h"
#include "export/formats.h"
#include "export/sequence_formats.h"
#include "support/mesh_sheet.h"
#include "support/temporary_folder.h"
#include "unit/export/small_cloth.h"

namespace clothsim {
namespace {

// Two squares side by side, each with a part of the texture of its own, as panels of a garment have.
const std::string PANELS =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
    "vt 0 0\nvt 0.4 0\nvt 0 0.4\nvt 0.4 0.4\nvt 0.6 0.6\nvt 1 0.6\nvt 0.6 1\nvt 1 1\n"
    "f 1/1 2/2 5/4\nf 1/1 5/4 4/3\nf 2/5 3/6 6/8\nf 2/5 6/8 5/7\n";

Scene panels() {
  Scene scene = test::smallScene();
  ClothSettings mesh;
  mesh.mesh = test::meshFile(PANELS);
  mesh.ks = 100;
  scene.cloths.push_back(mesh);
  return scene;
}

using Triangle = std::array<std::uint32_t, 3>;

TEST(TexturePoints, AreSeveralWhereAPointIsAtASeam) {
  const Cloth cloth(panels());
  const TexturePoints ofGrid(cloth, cloth.pieces()[0]), ofMesh(cloth, cloth.pieces()[1]);
  EXPECT_FALSE(ofGrid.hasSeams());
  EXPECT_EQ(ofGrid.points().size(), 6u);
  EXPECT_TRUE(ofMesh.hasSeams());
  ASSERT_EQ(ofMesh.points().size(), 8u) << "two points of six are at the seam";
  EXPECT_EQ(ofMesh.of({6, 7, 10}), (Triangle{0, 1, 4}));
  const Triangle right = ofMesh.of({7, 8, 11});
  EXPECT_EQ(ofMesh.points()[right[0]].particle, 7u);
  EXPECT_EQ(ofMesh.points()[right[0]].coordinates, (std::array{0.6f, 0.6f}));
  EXPECT_EQ(right[1], 2u);
  EXPECT_EQ(ofMesh.of({7, 11, 10})[0], right[0]) << "one for both triangles";
}

TEST(TexturePoints, ComeBackFromAnObjFile) {
  const Cloth cloth(panels());
  Scene meshAlone = panels();
  meshAlone.cloths.erase(meshAlone.cloths.begin());
  const Cloth mesh(meshAlone);
  const auto before = meshShapeOf(meshAlone.cloths[0].mesh);
  const auto after =
      meshShapeOf(test::meshFile(formatObj(test::smallState(mesh), mesh, ObjObjects::byCloth)));
  ASSERT_EQ(after->triangles, before->triangles);
  for (std::size_t t = 0; t < before->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(after->cornerCoordinates[t][k][c], before->cornerCoordinates[t][k][c], 1e-6);
  // Behind another cloth, whose texture coordinates come first.
  const std::string both = formatObj(test::smallState(cloth), cloth, ObjObjects::byCloth);
  EXPECT_NE(both.find("f 7/7/7 8/8/8 11/11/11\n"), std::string::npos) << both;
  EXPECT_NE(both.find("f 8/13/8 9/9/9 12/12/12\n"), std::string::npos) << both;
}

TEST(TexturePoints, AreOfCornersInUsdAndVerticesInGltf) {
  const Cloth cloth(panels());
  const State state = test::smallState(cloth);
  const test::TemporaryFolder folder;
  auto usd = makeUsdWriter(folder / "a.usda", cloth, panels(), {});
  usd->addFrame(state, cloth, panels());
  usd->close();
  const std::string text = readFile(folder / "a.usda");
  const std::size_t grid = text.find("interpolation = \"vertex\""), mesh = text.find("\"faceVarying\"");
  ASSERT_NE(mesh, std::string::npos);
  EXPECT_LT(grid, mesh) << "the grid has no seam";
  EXPECT_NE(text.find("int[] primvars:st:indices = [0, 1, 4, 0, 4, 3, 6, 2, 5, 6, 5, 7]"), std::string::npos)
      << text;
  const std::string glb = formatGlb(state, cloth);
  const auto json = nlohmann::json::parse(glb.substr(20, glb.find("BIN", 20) - 24));
  const auto& attributes = json["meshes"][1]["primitives"][0]["attributes"];
  EXPECT_EQ(json["accessors"][attributes["TEXCOORD_0"].get<std::size_t>()]["count"], 8);
}

}  // namespace
}  // namespace clothsim

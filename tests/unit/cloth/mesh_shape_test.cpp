// OBJ files of cloth: what they become, and what is wrong with those that are wrong.
#include "cloth/mesh_shape.h"

#include <gtest/gtest.h>

#include "cloth/material.h"
#include "cloth/pins.h"
#include "core/error.h"
#include "scene_io/scene_io.h"
#include "scene_io/scene_options.h"
#include "support/mesh_sheet.h"
#include "support/throws.h"

namespace clothsim {
namespace {

const std::string squarePoints = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string messageOf(const std::string& text) {
  return test::messageThrownBy<SceneError>([&] { (void)meshShapeOf(test::meshFile(text)); });
}

void expectInMessage(const std::string& text, const std::string& part) {
  const std::string message = messageOf(text);
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_NE(message.find(".obj"), std::string::npos) << "the file is named: " << message;
}

TEST(MeshShape, SplitsPolygonsAndKnowsItsEdges) {
  const auto shape = meshShapeOf(test::meshFile(squarePoints + "f 1 2 3 4\n"));
  EXPECT_EQ(shape->points.size(), 4u);
  EXPECT_EQ(shape->triangles.size(), 2u);
  ASSERT_EQ(shape->edges.size(), 5u);
  int inner = 0;
  for (const MeshShape::Edge& edge : shape->edges) {
    EXPECT_LT(edge.b, edge.a);
    if (edge.triangles == 1) continue;
    ++inner;
    EXPECT_NE(edge.opposite[0], edge.opposite[1]);
  }
  EXPECT_EQ(inner, 1);
}

TEST(MeshShape, WeldsCornersThatDifferInTextureCoordinatesOrNormalsAlone) {
  const auto shape = meshShapeOf(test::meshFile(
      squarePoints +
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.5\nvn 0 0 1\nvn 0 1 0\nf 1/1/1 2/2/1 3/3/1\nf 1/4/2 3/2/2 4/1/2\n"));
  EXPECT_EQ(shape->points.size(), 4u);
  EXPECT_EQ(shape->edges.size(), 5u) << "the two faces share one";
  EXPECT_EQ(shape->textureCoordinates[0], (std::array{0.0f, 1.0f}))
      << "those of the first corner, v downwards";
  EXPECT_EQ(shape->textureCoordinates[2], (std::array{1.0f, 0.0f}));
}

TEST(MeshShape, KnowsTheGroupsOfItsFaces) {
  const auto shape = meshShapeOf(test::meshFile(squarePoints + "g left seam\nf 1 2 4\ng right\nf 2 3 4\n"));
  EXPECT_EQ(shape->groups.at("left"), (std::vector<std::uint32_t>{0, 1, 3}));
  EXPECT_EQ(shape->groups.at("seam"), shape->groups.at("left"));
  EXPECT_EQ(shape->groups.at("right"), (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST(MeshShape, IsReadAgainOnceTheFileHasChanged) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "cloth.obj";
  std::ofstream(path) << squarePoints << "f 1 2 3 4\n";
  EXPECT_EQ(meshShapeOf(path.string())->points.size(), 4u);
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(2));
  EXPECT_EQ(meshShapeOf(path.string())->points.size(), 3u);
}

TEST(MeshShape, TellsWhatIsWrongWithAFile) {
  EXPECT_NE(test::messageThrownBy<SceneError>([] {
              (void)meshShapeOf("/nowhere/skirt.obj");
            }).find("/nowhere/skirt.obj"),
            std::string::npos);
  expectInMessage("hello\n", "expected an OBJ file with faces");
  expectInMessage(squarePoints, "expected an OBJ file with faces");
  expectInMessage(squarePoints + "f 1 2 9\n",
                  ":5: a face names a point that the file does not have, expected 1 to 4, found \"f 1 2 9\"");
  expectInMessage(squarePoints + "f 1 2 3 9\n", "a face names a point that the file does not have");
  expectInMessage("v 0 0 0\nv 1 nan 0\nv 1 1 0\nf 1 2 3\n",
                  ":2: expected a point, v and three finite numbers");
  expectInMessage("v 0 0 0\nv 1 1e99 0\nv 1 1 0\nf 1 2 3\n", "three finite numbers");
  expectInMessage("v 0 0 0\nv 1 0\nv 1 1 0\nf 1 2 3\n", "three finite numbers");
  expectInMessage(squarePoints + "f 1 2 3\nf 1 3 3\nf 1 3 4\n", "has no area");
  expectInMessage("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n", "has no area");
  expectInMessage(squarePoints + "v 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 3 5\n",
                  "the edge of points 3 and 1 has more than two triangles");
  expectInMessage(squarePoints + "f 1 2 3\nf 1 4 3\n", "two triangles of opposite orientation");
  const std::string twice = "the triangle of points 1, 2, 3 is there twice";
  expectInMessage(squarePoints + "f 1 2 3\nf 1 3 4\nf 2 3 1\n", twice);
  expectInMessage(squarePoints + "f 1 2 3\nf 1 3 4\nf 3 2 1\n", twice);
}

TEST(MeshShape, IsReadBehindAByteOrderMarkAndFromLinesThatGoOn) {
  const auto shape = meshShapeOf(test::meshFile("\xEF\xBB\xBF" + squarePoints + "f 1 2 \\\n 3 4\n"));
  EXPECT_EQ(shape->points.size(), 4u);
  EXPECT_EQ(shape->triangles.size(), 2u);
  expectInMessage(squarePoints + "f 1 2 \\\r\n 3 4\nv 1 2\n", ":7: expected a point");
}

TEST(MeshShape, LeavesOutPointsOfNoFaceAndKnowsTheOthersByTheirPlaceInTheFile) {
  const auto shape =
      meshShapeOf(test::meshFile("v 9 9 9\n" + squarePoints + "v 9 0 0\ng all\nf 2 3 4\nf 2 4 5\n"));
  EXPECT_EQ(shape->loosePoints, 2u);
  ASSERT_EQ(shape->points.size(), 4u);
  EXPECT_EQ(shape->points[1], (Vec3d{1, 0, 0}));
  EXPECT_EQ(shape->triangles, (std::vector<MeshShape::Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(shape->groups.at("all"), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(shape->textureCoordinates[1], (std::array{1.0f, 1.0f})) << "of the box around the faces";
  EXPECT_EQ(shape->edges.back().a, 3u);
  EXPECT_EQ(shape->fileIndexOf(3), 4u);
  EXPECT_EQ(shape->pointAt(1), 0u);
  EXPECT_FALSE(shape->pointAt(0) || shape->pointAt(5) || shape->pointAt(6));
  ClothSettings cloth;
  cloth.mesh = test::meshFile("v 9 9 9\n" + squarePoints + "f 2 3 4 5\n");
  cloth.pinned = {VertexPin{2}};
  EXPECT_EQ(pinnedParticles(cloth), (std::vector<bool>{false, true, false, false}));
  EXPECT_EQ(vertexPinOf(cloth, 1), VertexPin{2}) << "as a scene that is saved names it";
  cloth.pinned = {VertexPin{0}};
  EXPECT_NE(test::messageThrownBy<SceneError>([&] {
              (void)pinnedParticles(cloth);
            }).find("vertex 0 of the mesh belongs to no face"),
            std::string::npos);
  const RemarkedScene read = readScene({.scene = cloth.mesh});
  EXPECT_NE(read.remarks.at(0).find("left out 1 point that belongs to no face"), std::string::npos);
  EXPECT_NE(read.remarks.back().find("taken with cloth.scale="), std::string::npos);
}

// On equilateral triangles a membrane of Poisson's ratio 1/3 is made of springs along its edges (A. Van
// Gelder, 1998).
TEST(MeshMechanics, OfAMaterialIsAsStiffAlongItsEdgesAsSpringsOfItsModulus) {
  const auto shape = meshShapeOf(test::meshSheetFile({}));
  ClothSettings cloth;
  cloth.material = Material{.stretch = 300, .shear = 0.375 * 300};
  const MeshMechanics mechanics = mechanicsOf(*shape, shape->points, cloth);
  for (std::size_t e = 0; e < shape->edges.size(); ++e)
    EXPECT_NEAR(mechanics.stretch[e], 300 * std::sqrt(0.75) * (shape->edges[e].triangles == 2 ? 1 : 0.5),
                0.05)
        << "Y = 2 k / sqrt(3), half along the border";
}

TEST(MeshMechanics, WeighsWhatItsAreaWeighs) {
  const test::MeshSheet sheet{.disorder = 0.2};
  const auto shape = meshShapeOf(test::meshSheetFile(sheet));
  ClothSettings cloth;
  cloth.density = 0.2;
  const auto total = [&] {
    double sum = 0;
    for (const double mass : mechanicsOf(*shape, placedPoints(*shape, cloth), cloth).masses) sum += mass;
    return sum;
  };
  const double area = (sheet.columns - 1) * (sheet.rows - 1) * std::sqrt(0.75) * sheet.edge * sheet.edge;
  EXPECT_NEAR(total(), 0.2 * area, 1e-5);
  cloth.scale = 2;
  EXPECT_NEAR(total(), 0.2 * 4 * area, 4e-5);
  cloth.mass = 3;
  EXPECT_NEAR(total(), 3, 1e-12);
}

// --- In scenes

std::string sceneText(const std::string& cloth) {
  return "{\"cloth\": {\"mesh\": \"" + test::meshSheetFile({}) + "\"" + cloth + "}}";
}
std::string messageOfScene(const std::string& cloth) {
  return test::messageThrownBy<SceneError>([&] { (void)parseScene(sceneText(cloth), "mesh.json"); });
}

TEST(MeshScene, IsTheSameOnceWrittenAndReadAgain) {
  const Scene scene = parseScene(
      sceneText(
          ", \"scale\": 0.5, \"rotation\": [0, 90, 0], \"material\": \"jersey\", \"pinned\": [{\"vertex\": "
          "3}, "
          "{\"region\": {\"from\": [0, 0, -1], \"to\": [1, 2, 3]}}, {\"group\": \"top\"}], \"pin_motion\": "
          "[{\"pinned\": [{\"group\": \"top\"}], \"keys\": [{\"t\": 0}, {\"t\": 1, \"position\": [0, 1, "
          "0]}]}]"),
      "mesh.json");
  ASSERT_EQ(scene.cloths[0].pinned.size(), 3u);
  EXPECT_EQ(std::get<VertexPin>(scene.cloths[0].pinned[0]).vertex, 3);
  EXPECT_EQ(std::get<GroupPin>(scene.cloths[0].pinMotion[0].pinned[0]).group, "top");
  EXPECT_EQ(parseScene(formatScene(scene), "again"), scene);
}

TEST(MeshScene, RefusesWhatBelongsToAGrid) {
  EXPECT_NE(messageOfScene(", \"num_width_points\": 20").find("found both num_width_points and mesh"),
            std::string::npos);
  EXPECT_NE(messageOfScene(", \"width\": 2").find("found both width and mesh"), std::string::npos);
  EXPECT_NE(messageOfScene(", \"pinned\": [\"top\"]").find("expected a pin of a mesh"), std::string::npos);
  EXPECT_NE(messageOfScene(", \"pinned\": [[0, 0]]").find("expected a pin of a mesh"), std::string::npos);
  const auto gridMessage = [](const std::string& cloth) {
    return test::messageThrownBy<SceneError>(
        [&] { (void)parseScene("{\"cloth\": {" + cloth + "}}", "grid.json"); });
  };
  EXPECT_NE(gridMessage("\"pinned\": [{\"vertex\": 3}]").find("expected a pin of a grid"), std::string::npos);
  EXPECT_NE(gridMessage("\"scale\": 2").find("only a cloth with the key \"mesh\" has a scale"),
            std::string::npos);
  EXPECT_NE(gridMessage("\"mesh\": \"\"").find("expected the name of an OBJ file"), std::string::npos);
}

TEST(MeshScene, HasNoResolutionToChange) {
  Scene scene = test::meshScene();
  const std::string message =
      test::messageThrownBy<UsageError>([&] { (void)changeResolution(scene, 32, 32, false); });
  EXPECT_NE(message.find("found only meshes"), std::string::npos) << message;
  scene.cloths.emplace_back().ks = 100;
  (void)changeResolution(scene, 32, 32, false);
  EXPECT_EQ(scene.cloths[1].numWidthPoints, 32);
}

TEST(MeshScene, TakesItsStepsFromTheFile) {
  Scene scene = parseScene(sceneText(", \"material\": \"jersey\""), "mesh.json");
  setSceneValue(scene, "solver.integrator=verlet");
  EXPECT_GE(1 / (90.0 * scene.solver.simulationSteps), 0.5 * stableStep(scene));
  EXPECT_LE(1 / (90.0 * scene.solver.simulationSteps), stableStep(scene));
  const int steps = scene.solver.simulationSteps;
  setSceneValue(scene, "cloth.scale=0.5");
  EXPECT_NEAR(scene.solver.simulationSteps, 2 * steps, 1) << "edges half as long";
}

TEST(MeshScene, IsMadeOfAGridByOneSetting) {
  Scene scene;
  scene.cloths[0].pinned = {GridSide::top};
  scene.cloths[0].ks = 100;
  scene.cloths[0].numWidthPoints = 20;
  setSceneValue(scene, "cloth.mesh=" + test::meshSheetFile({}));
  EXPECT_TRUE(scene.cloths[0].isMesh());
  EXPECT_TRUE(scene.cloths[0].pinned.empty());
}

TEST(MeshShape, RefusesNumbersThatTheirReaderWouldWrapAround) {
  expectInMessage(squarePoints + "f 1 2 4294967298\n",
                  ":5: expected numbers of points of at most 2147483647");
  expectInMessage(squarePoints + "f 1/9999999999 2/1 3/1\n", ":5: expected numbers of points");
  expectInMessage(squarePoints + "f -99999999999 2 3\n", ":5: expected numbers of points");
}

// Each of these few bytes would have taken gigabytes, or hours.
TEST(MeshShape, DoesNotGiveWhatAFewBytesAskFor) {
  EXPECT_EQ(meshShapeOf(test::meshFile(squarePoints + "f 1 2 3 4\nt tag 2000000000/0/0\n"))->points.size(),
            4u);
  std::string corners, names = "g";
  for (int i = 0; i < 20'000; ++i) corners += " " + std::to_string(1 + i % 4);
  expectInMessage(squarePoints + "f" + corners + "\n", ":5: expected a face of at most 1000 corners");
  for (int i = 0; i < 20'000; ++i) names += " " + std::to_string(i);
  std::string faces;
  for (int i = 0; i < 20'000; ++i) faces += "f 1 2 3\n";
  expectInMessage(squarePoints + names + "\n" + faces, "expected groups");
}

}  // namespace
}  // namespace clothsim

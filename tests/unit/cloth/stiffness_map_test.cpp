// Parts of meshes that are stiffer or softer than the rest.
#include "cloth/stiffness_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

#include "cloth/cloth.h"
#include "cloth/material.h"
#include "cloth/mesh_shape.h"
#include "core/error.h"
#include "scene_io/scene_io.h"
#include "support/mesh_sheet.h"
#include "support/throws.h"

namespace clothsim {
namespace {

Scene fabric() {
  Scene scene = test::meshScene({.disorder = 0.2});
  scene.cloths[0].ks.reset();
  scene.cloths[0].material = Material{.stretch = 300, .shear = 40, .bend = 1e-4};
  return scene;
}

std::set<std::uint32_t> groupOf(const Scene& scene, const std::string& name) {
  const auto& members = meshShapeOf(scene.cloths[0].mesh)->groups.at(name);
  return {members.begin(), members.end()};
}

TEST(StiffnessMap, MultipliesSpringsBetweenPointsOfAPart) {
  Scene scene = test::meshScene();
  const Cloth plain(scene);
  scene.cloths[0].stiffnessMap = {{{GroupPin{"bottom"}}, 3, 1},
                                  {{GroupPin{"bottom"}, GroupPin{"middle"}}, 2, 7}};
  const Cloth cloth(scene);
  const std::set<std::uint32_t> bottom = groupOf(scene, "bottom"), middle = groupOf(scene, "middle");
  const auto isIn = [](const std::set<std::uint32_t>& group, std::uint32_t i) { return group.count(i) > 0; };
  ASSERT_EQ(cloth.lists().springs.size(), plain.lists().springs.size());
  std::set<double> factors;
  for (std::size_t n = 0; n < plain.lists().springs.size(); ++n) {
    const MeshSpring& before = plain.lists().springs[n];
    const MeshSpring& after = cloth.lists().springs[n];
    factors.insert(after.stiffness / before.stiffness);
    if (before.kind != SpringKind::structural) continue;
    const bool both = isIn(bottom, before.a) && isIn(bottom, before.b);
    const bool either = (isIn(bottom, before.a) || isIn(middle, before.a)) &&
                        (isIn(bottom, before.b) || isIn(middle, before.b));
    EXPECT_DOUBLE_EQ(after.stiffness / before.stiffness, (both ? 3 : 1) * (either ? 2 : 1));
  }
  EXPECT_EQ(factors, (std::set<double>{1, 2, 6, 7})) << "7: across edges";
}

TEST(StiffnessMap, CountsPaintInPart) {
  const std::string text =
      "v 0 0 0 0 0 1\nv 1 0 0 0 0 0.5\nv 1 1 0 0 0 0.25\nv 0 1 0 0 0 0\nf 1 2 3\nf 1 3 4\n";
  Scene scene;
  scene.cloths[0].mesh = test::meshFile(text);
  scene.cloths[0].stiffnessMap = {{{PaintedPin{Paint::blue}}, 9, 5}};
  const auto shape = meshShapeOf(scene.cloths[0].mesh);
  const StiffnessMap map(scene.cloths[0], *shape);
  EXPECT_DOUBLE_EQ(map.stretchFactor({0, 1}), 1 + 0.5 * 8) << "the least of its points";
  EXPECT_DOUBLE_EQ(map.stretchFactor({0, 1, 2}), 1 + 0.25 * 8);
  EXPECT_DOUBLE_EQ(map.stretchFactor({0, 3}), 1);
  EXPECT_DOUBLE_EQ(map.bendFactor({2, 0}), 1 + 0.25 * 4);
}

// The energy of a membrane is 1/2 |R e|^2 and that of a hinge 1/2 |sum c x|^2: factors are squares.
TEST(StiffnessMap, MultipliesTheEnergyOfTrianglesAndFolds) {
  Scene scene = fabric();
  const Cloth plain(scene);
  scene.cloths[0].stiffnessMap = {{{GroupPin{"top"}}, 4, 0.25}};
  const Cloth cloth(scene);
  const std::set<std::uint32_t> top = groupOf(scene, "top");
  const auto areIn = [&](std::span<const std::uint32_t> points) {
    return std::all_of(points.begin(), points.end(), [&](std::uint32_t i) { return top.count(i) > 0; });
  };
  std::size_t stiffer = 0;
  for (std::size_t t = 0; t < plain.lists().membranes.size(); ++t) {
    const bool isIn = areIn(plain.lists().membranes[t].corners);
    stiffer += isIn ? 1 : 0;
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_DOUBLE_EQ(cloth.lists().membranes[t].roots[k],
                       (isIn ? 2 : 1) * plain.lists().membranes[t].roots[k]);
  }
  EXPECT_EQ(stiffer, 22u) << "a strip of triangles";
  for (std::size_t n = 0; n < plain.lists().hinges.size(); ++n) {
    const Hinge& hinge = plain.lists().hinges[n];
    const bool isIn = areIn(std::span(hinge.corners).first(2));
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_DOUBLE_EQ(cloth.lists().hinges[n].coefficients[k], (isIn ? 0.5 : 1) * hinge.coefficients[k]);
  }
}

TEST(StiffnessMap, LeavesNoFoldWhereItsFactorIsZero) {
  Scene scene = fabric();
  scene.cloths[0].stiffnessMap = {{{GroupPin{"bottom"}, GroupPin{"middle"}, GroupPin{"top"}}, 1, 0}};
  EXPECT_TRUE(Cloth(scene).lists().hinges.empty());
}

TEST(StiffnessMap, ShortensTheStableStepByTheRootOfItsFactor) {
  for (Scene scene : {fabric(), test::meshScene()}) {
    scene.solver.integrator = Integrator::verlet;
    const double plain = stableStep(scene);
    scene.cloths[0].stiffnessMap = {{{GroupPin{"bottom"}, GroupPin{"middle"}, GroupPin{"top"}}, 4, 4}};
    EXPECT_NEAR(stableStep(scene), plain / 2, 1e-12 * plain);
  }
}

TEST(StiffnessMap, ComplainsOfFactorsThatNothingFeels) {
  const auto messageOf = [](const Scene& scene) {
    return test::messageThrownBy<SceneError>([&] { (void)Cloth(scene); });
  };
  Scene scene = fabric();
  const auto expectMessage = [&](const StiffnessPart& part, const std::string& text) {
    scene.cloths[0].stiffnessMap = {part};
    const std::string message = messageOf(scene);
    EXPECT_NE(message.find(text), std::string::npos) << message;
    EXPECT_NE(message.find(".obj"), std::string::npos) << "the file is named: " << message;
  };
  expectMessage(
      {{VertexPin{0}, VertexPin{1}}, 2, 1},
      "cloth.stiffness_map.0.stretch: expected points that hold all corners of some triangle of the "
      "mesh, found none");
  expectMessage({{VertexPin{0}}, 1, 2}, "cloth.stiffness_map.0.bend: expected points that hold both ends");
  expectMessage({{GroupPin{"botom"}}, 1, 2}, "cloth.stiffness_map.0.points: the mesh has no group \"botom\"");
  expectMessage({{PaintedPin{}}, 1, 2}, "cloth.stiffness_map.0.points: expected colours of vertices");
  scene = test::meshScene();
  scene.cloths[0].stiffnessMap = {{{VertexPin{0}, VertexPin{1}}, 2, 1}};
  EXPECT_NO_THROW((void)Cloth(scene)) << "an edge is enough for springs";
}

TEST(StiffnessMap, IsTheSameOnceWrittenAndReadAgain) {
  const auto textOf = [](const std::string& keys) {
    return "{\"cloth\": {\"mesh\": \"" + test::meshSheetFile({}) + "\", " + keys + "}}";
  };
  const Scene scene = parseScene(
      textOf("\"pinned\": [{\"painted\": \"blue\"}], \"stiffness_map\": [{\"points\": [{\"group\": "
             "\"top\"}, {\"painted\": \"green\"}], \"stretch\": 2, \"bend\": 0}]"),
      "map.json");
  ASSERT_EQ(scene.cloths[0].stiffnessMap.size(), 1u);
  EXPECT_EQ(scene.cloths[0].stiffnessMap[0],
            (StiffnessPart{{GroupPin{"top"}, PaintedPin{Paint::green}}, 2, 0}));
  EXPECT_EQ(std::get<PaintedPin>(scene.cloths[0].pinned[0]).painted, Paint::blue);
  EXPECT_EQ(parseScene(formatScene(scene), "again"), scene);
  const auto expectMessage = [&](const std::string& keys, const std::string& part) {
    const std::string message =
        test::messageThrownBy<SceneError>([&] { (void)parseScene(textOf(keys), "map.json"); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expectMessage("\"stiffness_map\": [{\"points\": [\"top\"], \"bend\": 2}]",
                "cloth.stiffness_map.0.points.0: expected a pin of a mesh");
  expectMessage("\"stiffness_map\": [{\"points\": [{\"vertex\": 1}]}]",
                "cloth.stiffness_map.0: expected a factor, \"stretch\", \"bend\" or both, found none");
  expectMessage("\"pinned\": [{\"painted\": \"purple\"}]",
                "cloth.pinned.0.painted: expected one of red, green, blue, found \"purple\"");
}

}  // namespace
}  // namespace clothsim

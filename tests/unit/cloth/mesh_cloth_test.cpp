// Cloth made of a mesh: its lists, masses and pins.
#include <gtest/gtest.h>

#include <set>

#include "cloth/cloth.h"
#include "core/error.h"
#include "support/mesh_sheet.h"
#include "support/throws.h"

namespace clothsim {
namespace {

TEST(MeshCloth, HasASpringAlongEveryEdgeAndAcrossEveryInnerOne) {
  const test::MeshSheet sheet;
  const Cloth cloth(test::meshScene(sheet));
  const int along = (sheet.columns - 1) * sheet.rows + (2 * sheet.columns - 1) * (sheet.rows - 1);
  const int border = 2 * (sheet.columns - 1) + 2 * (sheet.rows - 1);
  EXPECT_EQ(cloth.particleCount(), static_cast<std::uint32_t>(sheet.columns * sheet.rows));
  EXPECT_EQ(cloth.triangleCount(), static_cast<std::uint64_t>(2 * (sheet.columns - 1) * (sheet.rows - 1)));
  EXPECT_EQ(cloth.springCount(), static_cast<std::uint64_t>(along + along - border));
  std::set<std::pair<std::uint32_t, std::uint32_t>> structural;
  for (const Spring& spring : cloth.springs()) {
    EXPECT_LT(spring.b, spring.a);
    if (spring.kind == SpringKind::structural) {
      EXPECT_TRUE(structural.emplace(spring.a, spring.b).second);
      EXPECT_NEAR(spring.restLength, sheet.edge, 2e-6);
      EXPECT_DOUBLE_EQ(spring.stiffness, 200);
    } else {
      EXPECT_NEAR(spring.restLength, std::sqrt(3) * sheet.edge, 2e-6) << "or two edges, over the border";
      EXPECT_DOUBLE_EQ(spring.stiffness, 40);
    }
  }
  EXPECT_EQ(structural.size(), static_cast<std::size_t>(along));
}

TEST(MeshCloth, HasColorsOfSpringsThatShareNoParticleAndTogetherHoldAll) {
  const Cloth cloth(test::meshScene({.disorder = 0.2}));
  const Piece& mesh = cloth.pieces()[0];
  std::uint32_t next = 0;
  for (const SpringColor& color : mesh.colors) {
    EXPECT_EQ(color.first, next);
    next = color.end;
    std::set<std::uint32_t> particles;
    for (std::uint32_t n = color.first; n < color.end; ++n) {
      EXPECT_TRUE(particles.insert(cloth.lists().springs[n].a).second);
      EXPECT_TRUE(particles.insert(cloth.lists().springs[n].b).second);
    }
  }
  EXPECT_EQ(next, cloth.lists().springs.size());
  EXPECT_LE(mesh.colors.size(), 22u) << "greedily, twice the neighbours less one, of each kind";
}

TEST(MeshCloth, GathersInAscendingOrderAndEachElementAtAllItsParticles) {
  Scene scene = test::meshScene({.disorder = 0.2});
  scene.cloths[0].ks.reset();
  scene.cloths[0].material = Material{};
  const Cloth cloth(scene);
  const SpringLists& lists = cloth.lists();
  EXPECT_EQ(lists.springsOf.entries.size(), 2 * lists.springs.size());
  EXPECT_EQ(lists.hingesOf.entries.size(), 4 * lists.hinges.size());
  EXPECT_EQ(lists.trianglesOf.entries.size(), 3 * lists.triangles.size());
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i) {
    for (const SpringLists::Incidence* list : {&lists.springsOf, &lists.hingesOf, &lists.trianglesOf})
      EXPECT_TRUE(std::is_sorted(list->entries.begin() + list->starts[i],
                                 list->entries.begin() + list->starts[i + 1]));
    for (std::uint32_t at = lists.springsOf.starts[i]; at < lists.springsOf.starts[i + 1]; ++at) {
      const MeshSpring& spring = lists.springs[lists.springsOf.entries[at]];
      EXPECT_TRUE(spring.a == i || spring.b == i);
    }
  }
}

TEST(MeshCloth, LiesBesideGridsInTheSameArrays) {
  Scene scene = test::meshScene();
  scene.cloths.insert(scene.cloths.begin(), ClothSettings{});
  scene.cloths[0].ks = 100;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = 5;
  const Cloth cloth(scene);
  EXPECT_EQ(cloth.pieces()[1].firstParticle, 25u);
  EXPECT_FALSE(cloth.isOfMesh(24));
  EXPECT_TRUE(cloth.isOfMesh(25));
  const auto triangles = cloth.triangles();
  EXPECT_EQ(triangles.size(), cloth.triangleCount());
  EXPECT_EQ(triangles[32], (std::array<std::uint32_t, 3>{25, 26, 37}));
  EXPECT_EQ(cloth.springs().size(), cloth.springCount());
  EXPECT_EQ(cloth.textureCoordinates().size(), cloth.particleCount());
}

std::vector<std::uint32_t> pinnedOf(std::vector<Pin> pins, Vec3d position = {}) {
  Scene scene = test::meshScene();
  scene.cloths[0].pinned = std::move(pins);
  scene.cloths[0].position = position;
  const Cloth cloth(scene);
  std::vector<std::uint32_t> pinned;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    if (cloth.inverseMasses()[i] == 0) pinned.push_back(i);
  return pinned;
}

TEST(MeshCloth, IsPinnedByVertexByRegionAndByGroup) {
  EXPECT_EQ(pinnedOf({VertexPin{5}, VertexPin{17}}), (std::vector<std::uint32_t>{5, 17}));
  EXPECT_EQ(pinnedOf({RegionPin{{{-0.01, -0.01, -1}, {0.06, 0.01, 1}}}}), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(pinnedOf({RegionPin{{{0.99, 1.99, -1}, {1.06, 2.01, 1}}}}, {1, 2, 0}),
            (std::vector<std::uint32_t>{0, 1}))
      << "where the mesh is placed";
  const std::vector<std::uint32_t> bottom = pinnedOf({GroupPin{"bottom"}});
  ASSERT_EQ(bottom.size(), 24u) << "all points of the first strip of triangles";
  EXPECT_EQ(bottom.back(), 23u);
}

TEST(MeshCloth, ComplainsOfPinsThatTheMeshDoesNotHave) {
  const auto messageOf = [](Pin pin) {
    return test::messageThrownBy<SceneError>([&] { (void)pinnedOf({std::move(pin)}); });
  };
  EXPECT_NE(messageOf(VertexPin{168}).find("expected a vertex from 0 to 167 of the mesh, found 168"),
            std::string::npos);
  EXPECT_NE(messageOf(RegionPin{{{5, 5, 5}, {6, 6, 6}}}).find("found one that holds none"),
            std::string::npos);
  EXPECT_NE(messageOf(GroupPin{"topp"}).find("did you mean \"top\"?; it has bottom, middle, top"),
            std::string::npos)
      << messageOf(GroupPin{"topp"});
}

TEST(MeshCloth, IsPinnedByPaint) {
  const std::string faces = "f 1 2 3\nf 1 3 4\n";
  const auto pinnedIn = [](const std::string& text, Paint paint) {
    Scene scene;
    scene.cloths[0].ks = 100;
    scene.cloths[0].mesh = test::meshFile(text);
    scene.cloths[0].pinned = {PaintedPin{paint}};
    const Cloth cloth(scene);
    std::vector<std::uint32_t> pinned;
    for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
      if (cloth.inverseMasses()[i] == 0) pinned.push_back(i);
    return pinned;
  };
  const std::string painted = "v 0 0 0 1 0 0\nv 1 0 0 0.5 0.6 0\nv 1 1 0 0.51 0 0.2\nv 0 1 0 0 1 0\n" + faces;
  EXPECT_EQ(pinnedIn(painted, Paint::red), (std::vector<std::uint32_t>{0, 2})) << "more than 0.5";
  EXPECT_EQ(pinnedIn(painted, Paint::green), (std::vector<std::uint32_t>{1, 3}));
  const auto messageOf = [&](const std::string& text, Paint paint) {
    return test::messageThrownBy<SceneError>([&] { (void)pinnedIn(text, paint); });
  };
  EXPECT_NE(messageOf(painted, Paint::blue)
                .find("cloth.pinned: expected paint of more than 0.5 at some vertex of the mesh, found none"),
            std::string::npos);
  for (const std::string first : {"v 0 0 0", "v 0 0 0 1", "v 0 0 0 1 0 red"})
    EXPECT_NE(messageOf(first + "\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\n" + faces, Paint::red)
                  .find("v x y z r g b for each, found vertices without"),
              std::string::npos);
  EXPECT_NE(messageOf("v 0 0 0 1 0 0\nv 1 0 0 255 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\n" + faces, Paint::red)
                .find("expected colours from 0 to 1 in the mesh file, found red 255 at vertex 1"),
            std::string::npos);
}

TEST(MeshCloth, ComplainsOfMotionsOfVerticesThatAreNotPinned) {
  Scene scene = test::meshScene();
  scene.cloths[0].pinned = {GroupPin{"top"}};
  PinMotion motion;
  motion.keys.resize(1);
  motion.pinned = {VertexPin{3}};
  scene.cloths[0].pinMotion = {motion};
  const std::string message = test::messageThrownBy<SceneError>([&] { (void)Cloth(scene); });
  EXPECT_NE(message.find("found vertex 3, which the cloth's key \"pinned\" does not name"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace clothsim

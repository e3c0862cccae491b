#include "cloth/cloth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cloth/contact_memory.h"
#include "core/error.h"
#include "scene/budget.h"
#include "support/test_scenes.h"
#include "support/throws.h"

namespace clothsim {
namespace {

using test::sheetScene;

TEST(Cloth, LaysAHorizontalSheetAtHeightOneWithColumnsAlongX) {
  const Cloth cloth(sheetScene(50));
  ASSERT_EQ(cloth.particleCount(), 2500u);
  EXPECT_EQ(cloth.positions()[0], (Vec3d{0, 1, 0}));
  EXPECT_EQ(cloth.positions()[49], (Vec3d{1, 1, 0}));
  EXPECT_EQ(cloth.positions()[49 * 50], (Vec3d{0, 1, 1}));
}

TEST(Cloth, LaysAVerticalSheetInXyWithASmallRepeatableJitterInZ) {
  Scene scene = sheetScene(20);
  scene.cloths[0].orientation = Orientation::vertical;
  const Cloth cloth(scene), again(scene);
  std::set<double> depths;
  for (std::size_t i = 0; i < cloth.particleCount(); ++i) {
    EXPECT_LE(std::abs(cloth.positions()[i].z), 0.001);
    EXPECT_EQ(cloth.positions()[i], again.positions()[i]);
    depths.insert(cloth.positions()[i].z);
  }
  EXPECT_GT(depths.size(), 390u) << "every point has its own depth";
  EXPECT_DOUBLE_EQ(cloth.positions()[19 * 20].y, 1);
}

TEST(Cloth, HasTheMassOfCs184) {
  const Cloth cloth(sheetScene(50));
  EXPECT_DOUBLE_EQ(cloth.pieces()[0].particleMass, 150.0 / 2500);
  EXPECT_DOUBLE_EQ(cloth.inverseMasses()[7], 2500 / 150.0);
}

TEST(Cloth, SharesOutATotalMassWhenOneIsGiven) {
  Scene scene = sheetScene(10);
  scene.cloths[0].mass = 1;
  EXPECT_DOUBLE_EQ(Cloth(scene).pieces()[0].particleMass, 0.01);
}

TEST(Cloth, HasAsManySpringsAsTheLatticeHasPairs) {
  const Cloth cloth(sheetScene(50));
  // structural 2 * 49 * 50, both diagonals 2 * 49 * 49, bending 2 * 48 * 50
  EXPECT_EQ(cloth.springCount(), 4900u + 4802u + 4800u);
  EXPECT_EQ(cloth.springs().size(), cloth.springCount());
}

TEST(Cloth, SwitchesEachKindOfSpringAlone) {
  Scene scene = sheetScene(50);
  scene.cloths[0].enableShearing = false;
  EXPECT_EQ(Cloth(scene).springCount(), 4900u + 4800u);
  scene.cloths[0].enableStructural = false;
  EXPECT_EQ(Cloth(scene).springCount(), 4800u);
  scene.cloths[0].enableBending = false;
  EXPECT_EQ(Cloth(scene).springCount(), 0u);
}

TEST(Cloth, NumbersSpringsByOwnerAndSlotAndEveryParticleMeetsItsOwnInAscendingOrder) {
  const Cloth cloth(sheetScene(9));
  const Piece& piece = cloth.pieces()[0];
  std::vector<std::vector<std::uint32_t>> byParticle(cloth.particleCount());
  for (const Spring& spring : cloth.springs()) {
    byParticle[spring.a].push_back(spring.number);
    byParticle[spring.b].push_back(spring.number);
  }
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      std::vector<std::uint32_t> met;
      for (const IncidentSpring& incident : incidentSprings) {
        if (!piece.contains(column + incident.columns, row + incident.rows)) continue;
        const std::uint32_t owner = incident.owned
                                        ? piece.particle(column, row)
                                        : piece.particle(column + incident.columns, row + incident.rows);
        met.push_back(6 * owner + static_cast<std::uint32_t>(incident.slot));
      }
      std::vector<std::uint32_t> expected = byParticle[piece.particle(column, row)];
      std::sort(expected.begin(), expected.end());
      EXPECT_EQ(met, expected) << column << ", " << row;
    }
  }
}

TEST(Cloth, GivesBendingSpringsAFifthOfKs) {
  const Cloth cloth(sheetScene(5));
  const Piece& piece = cloth.pieces()[0];
  EXPECT_DOUBLE_EQ(piece.stiffness[toLeft], 5000);
  EXPECT_DOUBLE_EQ(piece.stiffness[toUpperRight], 5000);
  EXPECT_DOUBLE_EQ(piece.stiffness[toSecondUpper], 1000);
}

TEST(Cloth, ScalesCs171StiffnessByTheReferenceLength) {
  Scene scene = sheetScene(11);
  scene.cloths[0].ks.reset();
  scene.cloths[0].stiffnessReference = 40;
  const Cloth cloth(scene);
  const Piece& piece = cloth.pieces()[0];
  EXPECT_DOUBLE_EQ(piece.stiffness[toLeft], 40);
  EXPECT_NEAR(piece.stiffness[toUpperLeft], 40 / std::sqrt(2.0), 1e-12);
}

TEST(Cloth, PinsAreColumnAndRow) {
  Scene scene = sheetScene(8);
  scene.cloths[0].pinned = {GridPoint{7, 0}, GridRange{{2, 3}, {3, 4}}};
  const Cloth cloth(scene);
  std::set<std::uint32_t> pinned;
  for (std::uint32_t i = 0; i < cloth.particleCount(); ++i)
    if (cloth.inverseMasses()[i] == 0) pinned.insert(i);
  EXPECT_EQ(pinned, (std::set<std::uint32_t>{7, 26, 27, 34, 35}));
}

TEST(Cloth, PinsTheUpperEdgeAsTopWhicheverWayTheSheetHangs) {
  Scene scene = sheetScene(4);
  scene.cloths[0].pinned = {GridSide::top};
  EXPECT_EQ(Cloth(scene).inverseMasses()[1], 0);
  scene.cloths[0].orientation = Orientation::vertical;
  const Cloth vertical(scene);
  EXPECT_NE(vertical.inverseMasses()[1], 0);
  EXPECT_EQ(vertical.inverseMasses()[13], 0);
}

TEST(Cloth, UsesNominalLengthsOnAFlatLatticeAndATableOnAJitteredOne) {
  Scene scene = sheetScene(50);
  EXPECT_FALSE(Cloth(scene).hasRestLengthTable());
  scene.cloths[0].orientation = Orientation::vertical;
  EXPECT_TRUE(Cloth(scene).hasRestLengthTable());
}

// The noise that lets a standing sheet buckle is part of CS184's rest shape, and of no other model's.
TEST(Cloth, RestsFlatThoughItStandsCrookedUnlessItIsCs184s) {
  Scene scene = sheetScene(65);
  ClothSettings& sheet = scene.cloths[0];
  sheet.orientation = Orientation::vertical;
  sheet.ks.reset();
  for (const bool isFabric : {true, false}) {
    sheet.material = isFabric ? std::optional(Material{}) : std::nullopt;
    sheet.stiffnessReference = isFabric ? std::nullopt : std::optional(40.0);
    const Cloth cloth(scene);
    EXPECT_FALSE(cloth.hasRestLengthTable());
    double largestDepth = 0, largestStrain = 0;
    for (const Spring& spring : cloth.springs()) {
      EXPECT_EQ(spring.restLength, cloth.pieces()[0].nominalLength[spring.number % SPRING_SLOTS]);
      const Vec3d a = cloth.positions()[spring.a], b = cloth.positions()[spring.b];
      largestDepth = std::max(largestDepth, std::abs(a.z));
      largestStrain = std::max(largestStrain, length(b - a) / spring.restLength - 1);
    }
    EXPECT_GT(largestDepth, 0) << "it can buckle";
    EXPECT_LE(largestStrain, 1e-5) << "and is hardly stretched by that";
  }
}

TEST(Cloth, KeepsSeveralGridsInContiguousRanges) {
  Scene scene = sheetScene(5);
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].numWidthPoints = 3;
  scene.cloths[1].position = {0, 2, 0};
  const Cloth cloth(scene);
  EXPECT_EQ(cloth.pieces()[1].firstParticle, 25u);
  EXPECT_EQ(cloth.particleCount(), 40u);
  EXPECT_EQ(cloth.positions()[25], (Vec3d{0, 3, 0}));
  for (const Spring& spring : cloth.springs())
    EXPECT_EQ(spring.a < 25, spring.b < 25) << "no spring joins two cloths";
}

TEST(Cloth, FrontsOfAHorizontalSheetLookUp) {
  const Cloth cloth(sheetScene(3));
  const auto triangles = cloth.triangles();
  ASSERT_EQ(triangles.size(), 8u);
  ASSERT_EQ(triangles.size(), cloth.triangleCount());
  for (const auto& [a, b, c] : triangles) {
    const auto x = cloth.positions();
    EXPECT_GT(cross(x[b] - x[a], x[c] - x[a]).y, 0);
  }
}

TEST(Cloth, RefusesMoreParticlesThanBuffersCanHold) {
  Scene scene = sheetScene(16384);
  EXPECT_THROW(Cloth{scene}, SceneError);
}

TEST(Cloth, FindsTheGridOfEveryParticleAmongThousands) {
  Scene scene = sheetScene(2);
  scene.cloths.assign(3000, scene.cloths[0]);
  scene.cloths[1].numWidthPoints = 5;
  const Cloth cloth(scene);
  for (std::size_t piece = 0; piece < cloth.pieces().size(); ++piece) {
    const Piece& found = cloth.pieces()[piece];
    EXPECT_EQ(cloth.pieceOf(found.firstParticle), piece);
    EXPECT_EQ(cloth.pieceOf(found.firstParticle + found.particleCount() - 1), piece);
  }
}

// Thousands of blocks of a quarter of a million points each: going through every point of each would take
// seconds, and holding them all gigabytes.
TEST(Cloth, MergesPinsThatOverlap) {
  Scene scene = sheetScene(500);
  for (int i = 0; i < 3000; ++i)
    scene.cloths[0].pinned.push_back(GridRange{{i % 10, i % 7}, {498 - i % 3, 498}});
  const Cloth cloth(scene);
  const auto pinned = std::count(cloth.inverseMasses().begin(), cloth.inverseMasses().end(), 0.0);
  EXPECT_EQ(pinned, 499 * 499);
  EXPECT_NE(cloth.inverseMasses()[499], 0);
}

TEST(Cloth, IsNotMadeWhereItsContactsWouldTakeAllMemory) {
  Scene scene = sheetScene(2000);
  scene.cloths.assign(15, scene.cloths[0]);
  scene.solver.selfCollision = SelfCollision::averaged;
  const std::string message = test::messageThrownBy<SceneError>([&] { checkContactMemory(scene, 100e9); });
  EXPECT_NE(message.find("this machine has 100.0 GB"), std::string::npos) << message;
  EXPECT_NE(message.find("thickness"), std::string::npos) << message;
  checkContactMemory(scene, 1e12);
  scene.solver.selfCollision = SelfCollision::robust;
  checkContactMemory(scene, 100e9);
}

TEST(Budget, NamesWhatIsNeededAndWhatIsThere) {
  checkMemory(1e6, 600e6);
  const std::string message = test::messageThrownBy<SceneError>([] { checkMemory(67'108'864, 24e9); });
  EXPECT_NE(message.find("67108864 particles together, which need about 40.3 GB; this machine has 24.0 GB"),
            std::string::npos)
      << message;
  EXPECT_GT(machineMemory(), 1e8);
}

}  // namespace
}  // namespace clothsim

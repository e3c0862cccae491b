// Crossings counted by exact predicates, against a count in another way.
#include "measure/crossings.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "solver/solver.h"
#include "support/test_scenes.h"

namespace clothsim {
namespace {

class Crossings : public testing::Test {
 protected:
  void SetUp() override {
    if (!CrossingCounter::available()) GTEST_SKIP() << "built without CGAL";
  }
};

CrossingCount countOf(const Scene& scene, const State& state) {
  return CrossingCounter(Cloth(scene)).count(state);
}
CrossingCount countAtStart(const Scene& scene) { return countOf(scene, initialState(Cloth(scene), scene)); }

// A lying sheet and, as second cloth, one that is turned and moved.
Scene twoSheets(int n, int m, Vec3d rotation, Vec3d position) {
  Scene scene = test::sheetScene(n);
  scene.cloths.push_back(scene.cloths[0]);
  scene.cloths[1].numWidthPoints = scene.cloths[1].numHeightPoints = m;
  scene.cloths[1].rotation = rotation;
  scene.cloths[1].position = position;
  return scene;
}

Vec3d pointOf(const State& state, std::uint32_t i) {
  const Particle4& x = state.positions[i];
  return Vec3f{x.x, x.y, x.z}.cast<double>();
}

// Whether the segment pq goes through the triangle: the signs of five volumes. For points in general
// position.
bool pierces(Vec3d p, Vec3d q, Vec3d a, Vec3d b, Vec3d c) {
  const auto volume = [](Vec3d u, Vec3d v, Vec3d w, Vec3d x) { return dot(cross(v - u, w - u), x - u); };
  if ((volume(a, b, c, p) > 0) == (volume(a, b, c, q) > 0)) return false;
  const bool ab = volume(p, q, a, b) > 0, bc = volume(p, q, b, c) > 0, ca = volume(p, q, c, a) > 0;
  return ab == bc && bc == ca;
}

// All pairs between two cloths: triangles cross when an edge of one pierces the other.
std::uint64_t countBetweenSheetsTheLongWay(const Scene& scene, const State& state) {
  const Cloth cloth(scene);
  const auto triangles = cloth.triangles();
  const std::uint32_t second = cloth.pieces()[1].firstParticle;
  std::uint64_t count = 0;
  for (const auto& a : triangles) {
    for (const auto& b : triangles) {
      if (a[0] >= second || b[0] < second) continue;
      bool cross = false;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto edgeThrough = [&](const auto& edge, const auto& face) {
          return pierces(pointOf(state, edge[i]), pointOf(state, edge[(i + 1) % 3]), pointOf(state, face[0]),
                         pointOf(state, face[1]), pointOf(state, face[2]));
        };
        cross = cross || edgeThrough(a, b) || edgeThrough(b, a);
      }
      count += cross ? 1 : 0;
    }
  }
  return count;
}

TEST_F(Crossings, OfTwoSheetsAreAsManyAsAnotherFormulaFinds) {
  for (const Vec3d rotation : {Vec3d{81, 13, 7}, Vec3d{40, -70, 20}, Vec3d{3, 5, 1}}) {
    const Scene scene = twoSheets(13, 11, rotation, {0, 0, 0});
    State state = initialState(Cloth(scene), scene);
    // The middle of the second sheet goes near the middle of the first.
    const Vec3d shift = Vec3d{0.53, 1.003, 0.47} - pointOf(state, 13 * 13 + 11 * 11 / 2);
    for (std::size_t i = 13 * 13; i < state.positions.size(); ++i) {
      state.positions[i].x += static_cast<float>(shift.x);
      state.positions[i].y += static_cast<float>(shift.y);
      state.positions[i].z += static_cast<float>(shift.z);
    }
    const CrossingCount count = countOf(scene, state);
    EXPECT_EQ(count.apart, countBetweenSheetsTheLongWay(scene, state));
    EXPECT_GT(count.apart, 20u);
    EXPECT_EQ(count.neighbours, 0u) << "two cloths have no neighbours between them";
  }
}

TEST_F(Crossings, AreNoneInSheetsAtRestAndInSheetsThatLieCloseTogether) {
  EXPECT_EQ(countAtStart(test::sheetScene(20)), CrossingCount{});
  EXPECT_EQ(countAtStart(twoSheets(12, 9, {0, 0, 0}, {0, 1e-6, 0})), CrossingCount{});
}

TEST_F(Crossings, CountTrianglesThatTouchInASinglePoint) {
  Scene scene = twoSheets(2, 2, {0, 0, 0}, {0, 5, 0});
  State state = initialState(Cloth(scene), scene);
  EXPECT_EQ(countOf(scene, state), CrossingCount{});
  state.positions[4] = {0.25f, 1, 0.25f,
                        1};  // a corner of the upper sheet onto the inside of a lower triangle
  EXPECT_EQ(countOf(scene, state), (CrossingCount{1, 0}));
  state.positions[4].y = 1 + 0x1p-23f;  // the next binary32 number above
  EXPECT_EQ(countOf(scene, state), CrossingCount{});
}

// Two sheets in one plane: every triangle meets those whose square it overlaps or touches.
TEST_F(Crossings, CountSheetsInOnePlane) {
  EXPECT_EQ(countAtStart(twoSheets(2, 2, {0, 0, 0}, {0, 0, 0})), (CrossingCount{4, 0}));
  EXPECT_EQ(countAtStart(twoSheets(2, 2, {0, 0, 0}, {2, 0, 0})), CrossingCount{});
}

// A strip of seven cells, particles 0 to 7 along one side and 8 to 15 along the other, with one cell turned
// upright through the first one. The cells beside it stay above and below the strip.
TEST_F(Crossings, AreCountedApartFromThoseOfNeighboursOnTheCloth) {
  Scene scene = test::sheetScene(2);
  scene.cloths[0].numWidthPoints = 8;
  scene.cloths[0].width = 7;
  const auto withUprightCell = [&](std::uint32_t cell) {
    State state = initialState(Cloth(scene), scene);
    state.positions[cell] = {0.5f, 3, 0.21f, 1};
    state.positions[cell + 8] = {0.5f, 3, 0.83f, 1};
    state.positions[cell + 1] = {0.5f, -1, 0.22f, 1};
    state.positions[cell + 9] = {0.5f, -1, 0.81f, 1};
    return countOf(scene, state);
  };
  const CrossingCount far = withUprightCell(6), near = withUprightCell(2);
  EXPECT_GE(far.apart, 2u);
  EXPECT_EQ(far.neighbours, 0u);
  EXPECT_EQ(near.apart, 0u);
  EXPECT_EQ(near.neighbours, far.apart)
      << "cells 0 and 2 share no particle, but columns 1 and 2 are neighbours";
}

TEST_F(Crossings, OfTrianglesWithACommonEdgeAreFoldsOntoEachOther) {
  Scene scene = test::sheetScene(2);
  State state = initialState(Cloth(scene), scene);  // (0,0) (1,0) / (0,1) (1,1); the common edge is 1 2
  EXPECT_EQ(countOf(scene, state), CrossingCount{});
  state.positions[3] = {0.25f, 1, 0.25f, 1};  // flat onto the other triangle
  EXPECT_EQ(countOf(scene, state), (CrossingCount{0, 1}));
  state.positions[3].y = 1.001f;  // just above it
  EXPECT_EQ(countOf(scene, state), CrossingCount{});
}

TEST_F(Crossings, SurviveTrianglesOfNoArea) {
  Scene scene = twoSheets(5, 5, {90, 0, 0}, {0, 0.5, 0.37});
  State state = initialState(Cloth(scene), scene);
  const CrossingCount before = countOf(scene, state);
  ASSERT_GT(before.apart, 0u);
  state.positions[7] = state.positions[6];
  state.positions[32] = state.positions[31];
  EXPECT_GT(countOf(scene, state).apart, 0u);
  for (Particle4& x : state.positions) x = {1, 2, 3, 1};
  EXPECT_EQ(countOf(scene, state), CrossingCount{});
  for (std::size_t i = 0; i < state.positions.size(); ++i) state.positions[i].x = static_cast<float>(i);
  EXPECT_EQ(countOf(scene, state), CrossingCount{}) << "all on one line";
}

TEST(CrossingSummary, KeepsTheWorstTheSumAndTheFirst) {
  CrossingSummary summary;
  summary.add(0, {0, 0});
  EXPECT_FALSE(summary.firstFrame.has_value());
  summary.add(1, {3, 9});
  summary.add(2, {2, 1});
  EXPECT_EQ(summary.framesChecked, 3);
  EXPECT_EQ(summary.worst, 3u);
  EXPECT_EQ(summary.total, 5u);
  EXPECT_EQ(summary.firstFrame, 1);
  EXPECT_EQ(summary.neighbours, 9u);
}

// Two sheets side by side whose borders lie on each other.
TEST_F(Crossings, CountTrianglesThatShareASewnPointAsNeighbours) {
  Scene scene = twoSheets(5, 5, {0, 0, 0}, {1, 0, 0});
  EXPECT_GT(countAtStart(scene).apart, 0u);
  Seam seam;
  seam.a = {0, {GridSide::right}};
  seam.b = {1, {GridSide::left}};
  scene.seams = {seam};
  EXPECT_EQ(countAtStart(scene).apart, 0u);
  EXPECT_GT(countAtStart(scene).neighbours, 0u);
}

TEST(CrossingCounter, SaysWhatToInstallWhenBuiltWithoutCgal) {
  const Cloth cloth(test::sheetScene(2));
  if (CrossingCounter::available())
    EXPECT_NO_THROW(CrossingCounter{cloth});
  else
    EXPECT_THROW(CrossingCounter{cloth}, UsageError);
}

}  // namespace
}  // namespace clothsim

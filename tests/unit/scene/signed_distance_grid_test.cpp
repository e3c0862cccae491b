#include "scene/colliders/signed_distance_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "core/files.h"
#include "scene_io/scene_io.h"
#include "solver/cpu/shapes.h"
#include "support/temporary_folder.h"
#include "support/throws.h"

namespace clothsim {
namespace {

// A box of 2 x 1 x 0.5 m about the origin: its distance is known.
const std::string boxObj =
    "v -1 -0.5 -0.25\nv 1 -0.5 -0.25\nv 1 0.5 -0.25\nv -1 0.5 -0.25\n"
    "v -1 -0.5 0.25\nv 1 -0.5 0.25\nv 1 0.5 0.25\nv -1 0.5 0.25\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

double boxDistance(Vec3d p) {
  const Vec3d q{std::abs(p.x) - 1, std::abs(p.y) - 0.5, std::abs(p.z) - 0.25};
  const double inside = std::min(std::max({q.x, q.y, q.z}), 0.0);
  const Vec3d out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return inside + std::sqrt(dot(out, out));
}

class MeshFile : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    const auto path = folder_ / "mesh.obj";
    writeFileAtomically(path, text);
    return path.string();
  }
  std::string messageOf(const std::string& text) {
    try {
      (void)loadSolidMesh(write(text), 1);
    } catch (const SceneError& error) {
      EXPECT_EQ(error.exitCode(), ExitCode::scene);
      return error.what();
    }
    return "no SceneError";
  }
  test::TemporaryFolder folder_;
};

std::vector<Vec3d> randomPoints(int count) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) points.push_back({uniform(engine), uniform(engine), uniform(engine)});
  return points;
}

TEST_F(MeshFile, HasTheDistancesOfTheShapeThatItIs) {
  const SignedDistanceGrid grid(loadSolidMesh(write(boxObj), 1), 16);
  for (const Vec3d p : randomPoints(3000)) EXPECT_NEAR(grid.distance(p), boxDistance(p), 1e-12);
}

TEST(TriangleTree, GivesEightPlacesWhatEachHasAlone) {
  const SolidMesh pawn = loadSolidMesh("assets/meshes/pawn.obj", 1);
  const TriangleTree tree(pawn);
  EightPlaces places;
  std::size_t count = 0;
  for (const Vec3d p : randomPoints(800)) {  // far apart and near each other
    places.set(count % 8, count % 16 < 8 ? p : pawn.points[count % pawn.points.size()] + 0.01 * p);
    if (++count % 8 != 0) continue;
    const EightPlaces::Numbers distances = tree.signedDistances(places);
    const std::array<MeshPoint, 8> nearest = tree.nearestPoints(places);
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_EQ(distances[k], tree.signedDistance(places.at(k)));
      EXPECT_NEAR(length(placeOf(pawn, nearest[k]) - places.at(k)), std::abs(distances[k]), 1e-12);
    }
  }
}

TEST_F(MeshFile, IsTurnedOutsideOutWhenItsFacesLookInwards) {
  std::string inwards = boxObj.substr(0, boxObj.find('f'));
  inwards += "f 2 3 4 1\nf 8 7 6 5\nf 5 6 2 1\nf 3 7 8 4\nf 4 8 5 1\nf 6 7 3 2\n";
  const SignedDistanceGrid grid(loadSolidMesh(write(inwards), 1), 8);
  EXPECT_NEAR(grid.distance({0, 0, 0}), -0.25, 1e-12);
}

TEST_F(MeshFile, IsScaledAndWeldedAtSeams) {
  std::string doubled;
  // The last face uses points of its own at the same places.
  doubled = boxObj.substr(0, boxObj.rfind("f "));
  doubled += "v 1 -0.5 -0.25\nv 1 0.5 -0.25\nv 1 0.5 0.25\nv 1 -0.5 0.25\nf 9 10 11 12\n";
  const SolidMesh mesh = loadSolidMesh(write(doubled), 3);
  EXPECT_EQ(mesh.points.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(SignedDistanceGrid(mesh, 8).distance({0, 0, 0}), -0.75, 1e-12);
}

TEST_F(MeshFile, ThatIsWrongGetsAMessageThatSaysWhatToDo) {
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(messageOf(boxObj.substr(0, boxObj.rfind("f "))), "mesh.obj: expected a closed surface");
  has(messageOf("v 0 0 0\n"), "mesh.obj: expected an OBJ file with faces, found none");
  has(messageOf("v 0 0 0\nv 1 0 0\nf 1 2 9\n"), "mesh.obj:3: a face names a point");
  try {
    (void)loadSolidMesh("/nonexistent/a.obj", 1);
    ADD_FAILURE() << "no SceneError";
  } catch (const SceneError& error) {
    has(error.what(), "/nonexistent/a.obj");
  }
}

TEST_F(MeshFile, IsInterpolatedWithinTheErrorOfItsGrid) {
  MeshCollider collider{.file = write(boxObj), .cells = 64};
  Scene scene;
  scene.colliders = {collider};
  const ColliderSet colliders(scene);
  const auto params = colliders.params<double>(0, 0, 0);
  const auto single = colliders.params<float>(0, 0, 0);
  const float* samples = colliders.distances()->data();
  const double cell = 2.0 / 64;
  for (const Vec3d p : randomPoints(3000)) {
    const double exact = boxDistance(p);
    const auto nearest = cpu::nearestOnShape<COLLIDER_MESH>(params, p, samples);
    const auto rounded = cpu::nearestOnShape<COLLIDER_MESH>(single, p.cast<float>(), samples);
    if (exact < 1.5 * cell) {
      EXPECT_NEAR(nearest.distance, exact, 0.5 * cell) << "at edges and corners";
    } else {
      EXPECT_LE(nearest.distance, exact + 1e-6 + 0.5 * cell) << "never reaches beyond the surface";
    }
    EXPECT_NEAR(static_cast<double>(rounded.distance), nearest.distance, 1e-5);
    EXPECT_NEAR(std::sqrt(dot(nearest.normal, nearest.normal)), 1, 1e-9);
  }
  const auto top = cpu::nearestOnShape<COLLIDER_MESH>(params, Vec3d{0.2, 0.52, 0.05}, samples);
  EXPECT_NEAR(top.distance, 0.02, 1e-6) << "exact over faces";
  EXPECT_NEAR(top.normal.y, 1, 1e-6);
}

TEST_F(MeshFile, IsFoundBesideTheScene) {
  write(boxObj);
  writeFileAtomically(folder_ / "scene.json",
                      R"({"cloth": {}, "colliders": [{"type": "mesh", "file": "mesh.obj"}]})");
  const Scene scene = loadScene(folder_ / "scene.json");
  EXPECT_EQ(distanceGridOf(std::get<MeshCollider>(scene.colliders[0]))->mesh().triangles.size(), 12u);
}

TEST(BundledMeshes, AreClosed) {
  EXPECT_GT(loadSolidMesh("assets/meshes/pawn.obj", 1).triangles.size(), 1000u);
}

TEST_F(MeshFile, StaysTheSameForWhoHoldsItWhateverBecomesOfTheFile) {
  write(boxObj);
  MeshCollider collider{.file = (folder_ / "mesh.obj").string(), .scale = 0.37, .cells = 8};
  std::weak_ptr<const SignedDistanceGrid> first = distanceGridOf(collider);
  EXPECT_EQ(distanceGridOf(collider), first.lock()) << "computed once";
  const auto held = first.lock();
  Scene scene;
  scene.colliders = {collider};
  const ColliderSet set(scene);
  EXPECT_EQ(ColliderSet(scene).distances(), set.distances()) << "nor is it copied for another set";
  write("f 1 2 3\n");
  EXPECT_EQ(distanceGridOf(collider), held) << "whatever becomes of the file";
}

TEST_F(MeshFile, IsNotSampledBeyondTheBudgetOfAllCollidersTogether) {
  write(boxObj);
  Scene scene;
  const MeshCollider collider{.file = (folder_ / "mesh.obj").string(), .cells = 8};
  scene.colliders.assign(3, collider);
  const std::size_t each = SignedDistanceGrid::sampleCount(loadShapes(collider), false, 8);
  EXPECT_EQ(distanceGridOf(collider)->samples().size(), each);
  EXPECT_EQ(ColliderSet(scene, 3 * each).distances()->size(), 3 * each);
  const std::string message =
      test::messageThrownBy<SceneError>([&] { (void)ColliderSet(scene, 3 * each - 1); });
  EXPECT_EQ(message, "colliders.2: with this one the meshes among the colliders need " +
                         std::to_string(3 * each) + " samples of distance, expected at most " +
                         std::to_string(3 * each - 1) + "; lower their `cells`, or use fewer of them");
}

}  // namespace
}  // namespace clothsim

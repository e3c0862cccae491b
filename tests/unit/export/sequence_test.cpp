#include "export/sequence.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "core/files.h"
#include "export/formats.h"
#include "support/temporary_folder.h"
#include "support/throws.h"
#include "unit/export/small_cloth.h"

namespace clothsim {
namespace {

using test::messageThrownBy;

class Sequence : public testing::Test {
 protected:
  Scene scene_ = test::smallScene();
  Cloth cloth_{scene_};
  State first_ = test::smallState(cloth_), second_ = first_;
  test::TemporaryFolder folder_;

  void SetUp() override {
    for (Particle4& x : second_.positions) x.y += 0.1f;
  }
  // Two frames, the second after three.
  void write(const std::string& name) const {
    const auto writer = makeSequenceWriter(folder_ / name, cloth_, scene_, {60, 3});
    writer->addFrame(first_, cloth_, scene_);
    writer->addFrame(second_, cloth_, scene_);
    writer->close();
  }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }
};

TEST_F(Sequence, KnowsItsExtensions) {
  EXPECT_TRUE(isSequence("a.pc2"));
  EXPECT_TRUE(isSequence("b/c.usda"));
  EXPECT_TRUE(isSequence("a.usdc"));
  EXPECT_TRUE(isSequence("a.usd"));
  EXPECT_FALSE(isSequence("a.obj"));
  const std::string message =
      messageThrownBy<UsageError>([&] { (void)makeSequenceWriter(folder_ / "a.abc", cloth_, scene_, {}); });
  EXPECT_TRUE(has(message, "a.abc") && has(message, ".pc2") && has(message, ".usda")) << message;
}

TEST_F(Sequence, PointCacheHasItsHeaderAndEveryBitOfThePositions) {
  write("a.pc2");
  const std::string bytes = readFile(folder_ / "a.pc2");
  ASSERT_EQ(bytes.size(), 32 + 2 * 6 * 3 * 4u);
  EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2\0", 12));
  std::int32_t version = 0, points = 0, samples = 0;
  float start = -1, rate = -1;
  std::memcpy(&version, &bytes[12], 4);
  std::memcpy(&points, &bytes[16], 4);
  std::memcpy(&start, &bytes[20], 4);
  std::memcpy(&rate, &bytes[24], 4);
  std::memcpy(&samples, &bytes[28], 4);
  EXPECT_EQ(version, 1);
  EXPECT_EQ(points, 6);
  EXPECT_EQ(start, 0);
  EXPECT_EQ(rate, 3) << "frames from one sample to the next";
  EXPECT_EQ(samples, 2);
  for (std::size_t i = 0; i < 6; ++i) {
    float x[3];
    std::memcpy(x, &bytes[32 + 72 + 12 * i], 12);
    EXPECT_EQ(x[0], second_.positions[i].x);
    EXPECT_EQ(x[1], second_.positions[i].y);
    EXPECT_EQ(x[2], second_.positions[i].z);
  }
}

TEST_F(Sequence, PointCacheComesWithTheMeshOfItsFirstFrame) {
  write("a.pc2");
  EXPECT_EQ(readFile(folder_ / "a_rest.obj"), formatObj(first_, cloth_));
  EXPECT_EQ(folder_.fileCount(), 2);
}

TEST_F(Sequence, UsdTellsUnitsAxisFrameRateAndTheFrameOfEachSample) {
  write("a.usda");
  const std::string text = readFile(folder_ / "a.usda");
  EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
  for (const char* part :
       {"metersPerUnit = 1\n", "upAxis = \"Y\"\n", "startTimeCode = 0\n", "endTimeCode = 3\n",
        "timeCodesPerSecond = 60\n", "        3: [(0, 1.10000002, 0), (1, 1.10000002, 0)",
        "faceVertexCounts = [3, 3, 3, 3]\n", "faceVertexIndices = [0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5]\n",
        "texCoord2f[] primvars:st = [(0, 1), (0.5, 1)", "        0: [(0, 1, 0), (2, 1, 1)],\n"})
    EXPECT_TRUE(has(text, part)) << part << "\nis missing in\n" << text;
}

TEST_F(Sequence, UsdChangesItsTrianglesWhereTheClothIsCutOnTheWay) {
  ASSERT_TRUE(cutAlong(second_.cuts, cloth_, 0, {0.5, -1}, {0.5, 2}));
  write("a.usda");
  EXPECT_TRUE(has(
      readFile(folder_ / "a.usda"),
      "faceVertexCounts.timeSamples = {\n            0: [3, 3, 3, 3],\n            3: [3, 3],\n        }\n"));
}

TEST_F(Sequence, UsdHasAMeshForEachClothWithItsOwnPointsAndTriangles) {
  scene_.cloths.push_back(scene_.cloths[0]);
  scene_.cloths[1].position = {0, 0.5, 0};
  cloth_ = Cloth(scene_);
  first_ = second_ = test::smallState(cloth_);
  write("a.usda");
  const std::string text = readFile(folder_ / "a.usda");
  const std::size_t one = text.find("def Mesh \"cloth0\""), two = text.find("def Mesh \"cloth1\"");
  ASSERT_TRUE(one != text.npos && two != text.npos && one < two);
  for (const std::string& mesh : {text.substr(one, two - one), text.substr(two)}) {
    EXPECT_TRUE(has(mesh, "faceVertexIndices = [0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5]\n")) << mesh;
    EXPECT_TRUE(has(mesh, "            3: [(0, 1, 0), (0, 1, 0)")) << "normals\n" << mesh;
  }
  EXPECT_TRUE(has(text.substr(one, two - one), "0: [(0, 1, 0), (1, 1, 0)"));
  EXPECT_TRUE(has(text.substr(two), "0: [(0, 1.5, 0), (1, 1.5, 0)"));
}

TEST_F(Sequence, UsdHasBodiesInTheShapesThatTheyTake) {
  MeshCollider walk{.file = "assets/meshes/walk/walk_%02d.obj", .cells = 24};
  walk.shapes = 5;
  walk.shapesPerSecond = 60;
  scene_.colliders = {walk};
  first_.clock = {};
  second_.clock = {.step = 1, .stepLength = 0.02};
  write("a.usda");
  const std::string text = readFile(folder_ / "a.usda");
  const std::size_t samples = text.find("point3f[] points.timeSamples = {", text.find("def Mesh \"mesh0\""));
  ASSERT_NE(samples, text.npos);
  const auto pointsAt = [&](const std::string& code) {
    const std::size_t begin = text.find(" " + code + ": ", samples);
    return text.substr(begin + code.size() + 3, text.find('\n', begin) - begin - code.size() - 3);
  };
  const std::string shape = readFile(resourceRoot() / "assets/meshes/walk/walk_00.obj");
  const auto points = static_cast<long>(std::count(shape.begin(), shape.end(), 'v'));
  EXPECT_GT(points, 100);
  for (const char* code : {"0", "3"}) EXPECT_EQ(std::ranges::count(pointsAt(code), '('), points) << code;
  EXPECT_NE(pointsAt("0"), pointsAt("3"));
}

// A ball that is turned by 90 degrees about z while it moves: USD multiplies rows by matrices.
TEST_F(Sequence, UsdHasTheSolidsOnTheirWayTheMaterialsAndTheCamera) {
  Sphere ball{.origin = {1, 2, 3}, .radius = 0.5};
  ball.motion = Motion{.keys = {{0, {1, 2, 3}, {}}, {1, {2, 2, 3}, {0, 0, 90}}}};
  ball.render.color = Vec3d{0, 0, 1};
  scene_.colliders = {ball, Box{}};
  scene_.render.color = {1, 0.5, 0};
  scene_.camera.position = {0, 0, 5};
  scene_.camera.target = {0, 0, 0};
  scene_.camera.fov = 90;
  first_.clock = {};
  second_.clock = {.step = 1, .stepLength = 1};
  write("a.usda");
  const std::string text = readFile(folder_ / "a.usda");
  for (const char* part : {"def Sphere \"sphere0\"", "double radius = 0.5\n", "def Mesh \"box1\"",
                           "0: ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1, 2, 3, 1) )", "(2, 2, 3, 1) )",
                           "inputs:diffuseColor = (1, 0.214041144, 0)\n",  // of sRGB 0.5
                           "</clothsim/materials/solid0>", "inputs:diffuseColor = (0, 0, 1)\n",
                           "(0, 0, 1, 0), (0, 0, 5, 1) )", "verticalAperture = 24\n"})
    EXPECT_TRUE(has(text, part)) << part << "\nis missing in\n" << text;
}

TEST_F(Sequence, BinaryUsdSaysWhatToInstallWherePixarsLibraryIsMissing) {
  const char* const before = std::getenv("CLOTHSIM_PYTHON");
  const std::string old = before == nullptr ? "" : before;
  ::setenv("CLOTHSIM_PYTHON", "false", 1);
  const std::string message = messageThrownBy<InputOutputError>(
      [&] { (void)makeSequenceWriter(folder_ / "a.usdc", cloth_, scene_, {}); });
  ::setenv("CLOTHSIM_PYTHON", old.c_str(), 1);
  EXPECT_TRUE(has(message, "a.usdc") && has(message, "pip install usd-core") && has(message, ".usda"))
      << message;
  EXPECT_EQ(folder_.fileCount(), 0);
}

TEST_F(Sequence, BinaryUsdTellsTheLastLineOfATraceback) {
  const std::filesystem::path python = folder_ / "python";
  writeFileAtomically(
      python,
      "#!/bin/sh\ncase \"$2\" in *shutil*) printf 'Traceback (most recent call last):\\n  File\\n"
      "OSError: No space left on device\\n' >&2; exit 1;; esac\n");
  std::filesystem::permissions(python, std::filesystem::perms::owner_all);
  const char* const before = std::getenv("CLOTHSIM_PYTHON");
  const std::string old = before == nullptr ? "" : before;
  ::setenv("CLOTHSIM_PYTHON", python.c_str(), 1);
  const std::string message = messageThrownBy<InputOutputError>([&] { write("a.usdc"); });
  ::setenv("CLOTHSIM_PYTHON", old.c_str(), 1);
  EXPECT_TRUE(has(message, "a.usdc: cannot be written") && has(message, "No space left")) << message;
  EXPECT_FALSE(has(message, "Traceback")) << message;
}

TEST_F(Sequence, IsWholeOrNotThere) {
  for (const char* name : {"a.pc2", "a.usda"}) {
    {
      const auto writer = makeSequenceWriter(folder_ / name, cloth_, scene_, {});
      writer->addFrame(first_, cloth_, scene_);
      EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << "before close()";
    }
    EXPECT_EQ(folder_.fileCount(), 0) << "without close() nothing is left";
  }
}

TEST_F(Sequence, RefusesAClothThatWasRebuiltAlsoWithAsManyPoints) {
  Scene turned = scene_;
  std::swap(turned.cloths[0].numWidthPoints, turned.cloths[0].numHeightPoints);
  const Cloth other(turned);
  ASSERT_EQ(other.particleCount(), cloth_.particleCount());
  for (const char* name : {"a.pc2", "a.usda"}) {
    const auto writer = makeSequenceWriter(folder_ / name, cloth_, scene_, {});
    writer->addFrame(first_, cloth_, scene_);
    const std::string message =
        messageThrownBy<InputOutputError>([&] { writer->addFrame(second_, other, turned); });
    EXPECT_TRUE(has(message, name) && has(message, "rebuilt")) << message;
  }
}

// As replays of what a person has done in the viewer do.
TEST_F(Sequence, FollowsSolidsThatAreMovedAndSaysWhatItCannotFollow) {
  scene_.colliders = {Sphere{.origin = {0, 0.5, 0}, .radius = 0.25}};
  scene_.solver.framesPerSec = 60;
  const auto writer = makeSequenceWriter(folder_ / "a.usda", cloth_, scene_, {60});
  writer->addFrame(first_, cloth_, scene_);
  std::get<Sphere>(scene_.colliders[0]).origin = {0, 0.5, -0.125};
  writer->addFrame(second_, cloth_, scene_);
  EXPECT_TRUE(writer->losses().empty());
  scene_.solver.framesPerSec = 30;
  std::get<Sphere>(scene_.colliders[0]).radius = 0.125;
  writer->addFrame(second_, cloth_, scene_);
  ASSERT_EQ(writer->losses().size(), 2u);
  EXPECT_TRUE(has(writer->losses()[0], "colliders of the start alone") &&
              has(writer->losses()[1], "60 frames a second"));
  writer->close();
  const std::string text = readFile(folder_ / "a.usda");
  EXPECT_TRUE(has(text, "0: ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0.5, 0, 1) )")) << text;
  EXPECT_TRUE(has(text, "1: ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0.5, -0.125, 1) )")) << text;
}

// A full disk, played by a limit on the size of files.
TEST_F(Sequence, LeavesTheOldFileWhenTheDiskIsFull) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  for (const char* name : {"a.pc2", "a.usda"}) {
    writeFileAtomically(folder_ / name, "old");
    const rlimit small{64, old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string message = messageThrownBy<InputOutputError>([&] { write(name); });
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    EXPECT_TRUE(has(message, "cannot be written")) << message;
    EXPECT_EQ(readFile(folder_ / name), "old");
  }
  EXPECT_EQ(folder_.fileCount(), 2) << "a temporary file, or a mesh without its cache, was left behind";
}

}  // namespace
}  // namespace clothsim

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <sstream>

#include "cloth/mesh_shape.h"
#include "export/formats.h"
#include "solver/solver.h"
#include "support/mesh_sheet.h"
#include "unit/export/small_cloth.h"

namespace clothsim {
namespace {

class MeshFormats : public testing::Test {
 protected:
  Cloth cloth_{test::smallScene()};
  State state_ = test::smallState(cloth_);
};

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(MeshFormats, CsvHasTheHeaderAndNineSignificantDigitsAsPrintfWritesThem) {
  state_.positions[1] = {0.1f, -123456.789f, 1e-20f, 0};
  const std::vector<std::string> lines = linesOf(formatCsv(state_));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[0], "index,x,y,z,vx,vy,vz");
  char expected[200];
  const Particle4 &x = state_.positions[1], &v = state_.velocities[1];
  std::snprintf(expected, sizeof expected, "1,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", x.x, x.y, x.z, v.x, v.y, v.z);
  EXPECT_EQ(lines[2], expected);
}

TEST_F(MeshFormats, CsvReadsBackToTheSameFloats) {
  state_.positions[0].x = 0.333333343f;
  state_.positions[0].y = 16777217.0f;
  float x = 0, y = 0;
  ASSERT_EQ(std::sscanf(linesOf(formatCsv(state_))[1].c_str(), "0,%f,%f", &x, &y), 2);
  EXPECT_EQ(x, state_.positions[0].x);
  EXPECT_EQ(y, state_.positions[0].y);
}

TEST_F(MeshFormats, NormalsOfAFlatHorizontalSheetPointUp) {
  for (const Vec3f& normal : vertexNormals(state_, cloth_)) EXPECT_EQ(normal, (Vec3f{0, 1, 0}));
}

// The sheet as the slope y = x: its normal is (-1, 1, 0) / sqrt 2, the same at every point of a plane.
TEST_F(MeshFormats, NormalsOfATiltedSheetAreThePlanesOwn) {
  for (Particle4& particle : state_.positions) particle.y = particle.x;
  for (const Vec3f& normal : vertexNormals(state_, cloth_)) {
    EXPECT_FLOAT_EQ(normal.x, -0.70710678f);
    EXPECT_FLOAT_EQ(normal.y, 0.70710678f);
    EXPECT_FLOAT_EQ(normal.z, 0);
  }
}

TEST_F(MeshFormats, NormalsOfAClothPulledIntoAPointAreStillUnitVectors) {
  for (Particle4& particle : state_.positions) particle = {0, 0, 0, 1};
  for (const Vec3f& normal : vertexNormals(state_, cloth_)) EXPECT_EQ(dot(normal, normal), 1);
}

TEST_F(MeshFormats, ObjHasAVertexATextureCoordinateAndANormalPerParticleAndCountsFromOne) {
  int vertices = 0, textures = 0, normals = 0, faces = 0;
  for (const std::string& line : linesOf(formatObj(state_, cloth_))) {
    vertices += line.starts_with("v ");
    textures += line.starts_with("vt ");
    normals += line.starts_with("vn ");
    if (!line.starts_with("f ")) continue;
    unsigned v[9];
    ASSERT_EQ(std::sscanf(line.c_str(), "f %u/%u/%u %u/%u/%u %u/%u/%u", v, v + 1, v + 2, v + 3, v + 4, v + 5,
                          v + 6, v + 7, v + 8),
              9)
        << line;
    const auto triangle = cloth_.triangles()[static_cast<std::size_t>(faces++)];
    for (std::size_t corner = 0; corner < 9; ++corner) EXPECT_EQ(v[corner], triangle[corner / 3] + 1) << line;
  }
  EXPECT_EQ(vertices, 6);
  EXPECT_EQ(textures, 6);
  EXPECT_EQ(normals, 6);
  EXPECT_EQ(faces, 4);
}

// As other programs put a picture on it: its lower edge is v = 0. The first row of the grid is its upper
// edge.
TEST_F(MeshFormats, ObjHasTheUpperLeftCornerOfAPictureAtTheFirstParticle) {
  std::vector<std::string> coordinates;
  for (const std::string& line : linesOf(formatObj(state_, cloth_)))
    if (line.starts_with("vt ")) coordinates.push_back(line);
  EXPECT_EQ(coordinates,
            (std::vector<std::string>{"vt 0 1", "vt 0.5 1", "vt 1 1", "vt 0 0", "vt 0.5 0", "vt 1 0"}));
}

TEST_F(MeshFormats, PlyIsAsLongAsItsHeaderSaysAndHoldsTheParticles) {
  const std::string bytes = formatPly(state_, cloth_);
  const std::string endOfHeader = "end_header\n";
  const std::size_t body = bytes.find(endOfHeader) + endOfHeader.size();
  const std::string header = bytes.substr(0, body);
  EXPECT_TRUE(header.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_NE(header.find("element vertex 6\n"), std::string::npos);
  EXPECT_NE(header.find("element face 4\n"), std::string::npos);
  ASSERT_EQ(bytes.size() - body, 6 * 8 * 4 + 4 * (1 + 3 * 4u));

  float vertex[8];
  std::memcpy(vertex, bytes.data() + body + 5 * sizeof vertex,
              sizeof vertex);  // the last particle: the lower right corner of a picture
  const Particle4& x = state_.positions[5];
  const float expected[8] = {x.x, x.y, x.z, 0, 1, 0, 1, 0};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(vertex[i], expected[i]) << "property " << i;
}

TEST_F(MeshFormats, ObjAndPlyTellWhichClothAFaceIsOf) {
  Scene scene = test::smallScene();
  scene.cloths.push_back(scene.cloths[0]);
  cloth_ = Cloth(scene);
  state_ = test::smallState(cloth_);
  std::string lines;
  for (const std::string& line : linesOf(formatObj(state_, cloth_)))
    if (line[0] == 'o' || line[0] == 'f') lines += line[0] == 'o' ? line + " " : line.substr(0, 1);
  EXPECT_EQ(lines, "o cloth0 ffffo cloth1 ffff");
  EXPECT_EQ(formatObj(state_, cloth_, ObjObjects::one).find("\no "), std::string::npos);

  const std::string bytes = formatPly(state_, cloth_);
  EXPECT_NE(bytes.find("property list uchar int vertex_indices\nproperty int cloth\nend_header\n"),
            std::string::npos);
  for (std::size_t face = 0; face < 8; ++face) {
    std::int32_t cloth = -1;
    std::memcpy(&cloth, bytes.data() + bytes.size() - 17 * (8 - face) + 13, sizeof cloth);
    EXPECT_EQ(cloth, face < 4 ? 0 : 1);
  }
}

TEST_F(MeshFormats, NpzHoldsEachArrayUncompressedBehindAHeaderOfWholeLines) {
  const std::string bytes = formatNpz(state_, cloth_);
  EXPECT_TRUE(bytes.starts_with("PK\x03\x04")) << "a zip archive";
  const std::size_t name = bytes.find("positions.npy"), array = name + std::string("positions.npy").size();
  ASSERT_EQ(bytes.substr(array, 8), std::string("\x93NUMPY\x01\0", 8));
  const std::size_t length = static_cast<unsigned char>(bytes[array + 8]);
  EXPECT_EQ((10 + length) % 64, 0u);
  EXPECT_TRUE(bytes.substr(array + 10, length)
                  .starts_with("{'descr': '<f4', 'fortran_order': False, 'shape': (6,3,), }"));
  float last[3];
  std::memcpy(last, bytes.data() + array + 10 + length + 5 * sizeof last, sizeof last);
  EXPECT_EQ(last[0], state_.positions[5].x);
  EXPECT_EQ(last[1], state_.positions[5].y);
  EXPECT_EQ(last[2], state_.positions[5].z);
  EXPECT_EQ(bytes, formatNpz(state_, cloth_));
}

TEST(ObjFile, OfAMeshIsReadAsTheSameMesh) {
  Scene scene = test::meshScene({.disorder = 0.2});
  const std::string withCoordinates =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.1 0.25\nvt 0.9 0.25\nvt 1 0.75\nvt 0 1\n"
      "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
  for (const std::string& text : {test::meshSheetText({.disorder = 0.2}), withCoordinates}) {
    scene.cloths[0].mesh = test::meshFile(text);
    const Cloth cloth(scene);
    const auto before = meshShapeOf(scene.cloths[0].mesh);
    const auto after = meshShapeOf(test::meshFile(formatObj(initialState(cloth, scene), cloth)));
    EXPECT_EQ(after->triangles, before->triangles);
    EXPECT_EQ(after->points, before->points);
    for (std::size_t i = 0; i < before->points.size(); ++i)
      for (const std::size_t k : {0, 1})
        EXPECT_NEAR(after->textureCoordinates[i][k], before->textureCoordinates[i][k], 1e-6);
  }
}

}  // namespace
}  // namespace clothsim

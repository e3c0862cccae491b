// CSV, OBJ and PLY.
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "export/formats.h"
#include "export/text_numbers.h"
#include "export/texture_points.h"

namespace clothsim {
namespace {

// "v 1 2 3\n"
void appendLine(std::string& text, std::string_view keyword, std::initializer_list<float> values) {
  text += keyword;
  for (const float value : values) {
    text += ' ';
    appendNumber(text, value);
  }
  text += '\n';
}

template <class T>
void appendBytes(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little, "the PLY file says binary_little_endian");
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

std::vector<std::array<float, 2>> pictureCoordinates(const Cloth& cloth) {
  std::vector<std::array<float, 2>> coordinates = cloth.textureCoordinates();
  for (std::array<float, 2>& uv : coordinates) uv[1] = 1 - uv[1];
  return coordinates;
}

std::string clothName(const Cloth& cloth, std::size_t piece) {
  return cloth.pieces().size() == 1 ? "cloth" : "cloth" + std::to_string(piece);
}

std::vector<Vec3f> vertexNormals(const State& state, const Cloth& cloth) {
  std::vector<Vec3f> points;
  points.reserve(state.positions.size());
  for (const Particle4& particle : state.positions) points.push_back({particle.x, particle.y, particle.z});
  return vertexNormals(points, remainingTriangles(cloth, state.cuts));
}

std::vector<Vec3f> vertexNormals(std::span<const Vec3f> points,
                                 std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Vec3d> sums(points.size());
  for (const auto& triangle : triangles) {
    const Vec3d a = points[triangle[0]].cast<double>();
    const Vec3d b = points[triangle[1]].cast<double>();
    const Vec3d c = points[triangle[2]].cast<double>();
    const Vec3d twiceArea = cross(b - a, c - a);
    for (const std::uint32_t corner : triangle) sums[corner] = sums[corner] + twiceArea;
  }
  std::vector<Vec3f> normals(sums.size(), Vec3f{0, 1, 0});
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = std::sqrt(dot(sums[i], sums[i]));
    if (length > 0) normals[i] = (1 / length * sums[i]).cast<float>();
  }
  return normals;
}

std::string formatCsv(const State& state) {
  std::string text = "index,x,y,z,vx,vy,vz\n";
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4& x = state.positions[i];
    const Particle4& v = state.velocities[i];
    appendIndex(text, i);
    for (const float value : {x.x, x.y, x.z, v.x, v.y, v.z}) {
      text += ',';
      appendNumber(text, value);
    }
    text += '\n';
  }
  return text;
}

std::string formatObj(const State& state, const Cloth& cloth, ObjObjects objects) {
  std::string text = "# clothsim, step " + std::to_string(state.clock.step) + ", metres, y up\n";
  for (const Particle4& x : state.positions) appendLine(text, "v", {x.x, x.y, x.z});
  std::vector<TexturePoints> texture;
  std::vector<std::size_t> firstPoints;  // of each cloth in the list of all texture coordinates
  std::size_t points = 0;
  for (const Piece& piece : cloth.pieces()) {
    texture.emplace_back(cloth, piece);
    firstPoints.push_back(points);
    points += texture.back().points().size();
    for (const TexturePoints::Point& point : texture.back().points())
      appendLine(text, "vt", {point.coordinates[0], point.coordinates[1]});
  }
  for (const Vec3f& n : vertexNormals(state, cloth)) appendLine(text, "vn", {n.x, n.y, n.z});
  const bool hasObjects = objects == ObjObjects::byCloth && cloth.pieces().size() > 1;
  std::optional<std::size_t> object;
  for (const auto& triangle : remainingTriangles(cloth, state.cuts)) {
    const std::size_t piece = cloth.pieceOf(triangle[0]);
    if (hasObjects && object != piece) text += "o " + clothName(cloth, *(object = piece)) + "\n";
    text += 'f';
    const std::array<std::uint32_t, 3> ofTexture = texture[piece].of(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t corner = triangle[k] + std::size_t{1};  // OBJ counts from one
      text += ' ';
      appendIndex(text, corner);
      text += '/';
      appendIndex(text, firstPoints[piece] + ofTexture[k] + 1);
      text += '/';
      appendIndex(text, corner);
    }
    text += '\n';
  }
  return text;
}

std::string formatPly(const State& state, const Cloth& cloth) {
  const auto triangles = remainingTriangles(cloth, state.cuts);
  const auto textureCoordinates = pictureCoordinates(cloth);
  const auto normals = vertexNormals(state, cloth);

  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment clothsim, step " +
                      std::to_string(state.clock.step) + ", metres, y up\nelement vertex " +
                      std::to_string(state.positions.size()) + "\n";
  // s and t are the names that Blender and MeshLab know texture coordinates by.
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
    bytes += std::string("property float ") + name + "\n";
  bytes += "element face " + std::to_string(triangles.size()) + "\nproperty list uchar int vertex_indices\n";
  const bool tellsCloths = cloth.pieces().size() > 1;
  bytes += tellsCloths ? "property int cloth\nend_header\n" : "end_header\n";

  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4& x = state.positions[i];
    const Vec3f& n = normals[i];
    for (const float value :
         {x.x, x.y, x.z, n.x, n.y, n.z, textureCoordinates[i][0], textureCoordinates[i][1]})
      appendBytes(bytes, value);
  }
  for (const auto& triangle : triangles) {
    appendBytes(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : triangle) appendBytes(bytes, corner);
    if (tellsCloths) appendBytes(bytes, static_cast<std::int32_t>(cloth.pieceOf(triangle[0])));
  }
  return bytes;
}

}  // namespace clothsim

#include "cloth/mesh_shape.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <sstream>
#include <tuple>

#include "cloth/stiffness_map.h"
#include "core/error.h"
#include "core/recent.h"
#include "scene/obj_file.h"
#include "scene/pose.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

using Triangle = MeshShape::Triangle;
using Edge = MeshShape::Edge;

constexpr std::size_t MOST_MEMBERSHIPS = std::size_t{1} << 26;  // of corners of faces in groups
constexpr std::size_t MOST_KEPT_POINTS = std::size_t{1} << 22;  // of all meshes that nobody holds
constexpr double FLATTEST = 1e-4;  // the least height of a triangle, as a part of its longest side

// The name of a face in messages: its vertices as the file counts them.
std::string faceText(const Triangle& t) {
  return std::to_string(t[0] + 1) + ", " + std::to_string(t[1] + 1) + ", " + std::to_string(t[2] + 1);
}

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw SceneError(file + ": " + what);
}

// --- From the file

Triangle cornersOf(const std::string& file, const std::vector<tinyobj::index_t>& indices, std::size_t first,
                   std::size_t points) {
  Triangle corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    const int index = indices[first + k].vertex_index;
    if (index < 0 || static_cast<std::size_t>(index) >= points)
      fail(file, "a face names a point that the file does not have, expected 1 to " + std::to_string(points));
    corners[k] = static_cast<std::uint32_t>(index);
  }
  return corners;
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The two longest sides of the box around the points as u and v.
void projectTextureCoordinates(MeshShape& shape) {
  if (shape.triangles.empty()) return;
  Vec3d low = shape.points[shape.triangles[0][0]], high = low;
  const auto enclose = [&](const Vec3d& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  for (const Triangle& t : shape.triangles)
    for (const std::uint32_t corner : t) enclose(shape.points[corner]);
  const Vec3d size = high - low;
  const auto part = [](double x, double from, double extent) {
    return static_cast<float>(extent > 0 ? (x - from) / extent : 0);
  };
  const bool flatInX = size.x < size.y && size.x < size.z,
             flatInY = !flatInX && size.y < size.z && size.y < size.x;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    const Vec3d& p = shape.points[i];
    const float x = part(p.x, low.x, size.x), y = 1 - part(p.y, low.y, size.y), z = part(p.z, low.z, size.z);
    shape.textureCoordinates[i] = flatInX ? std::array{z, y} : flatInY ? std::array{x, z} : std::array{x, y};
  }
  for (std::size_t t = 0; t < shape.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      shape.cornerCoordinates[t][k] = shape.textureCoordinates[shape.triangles[t][k]];
}

// OBJ's v points up, ours down.
void readFaces(const std::string& file, const ObjFile& obj, MeshShape& shape) {
  const std::size_t points = shape.points.size();
  std::vector<bool> hasCoordinates(points);
  std::map<std::string, std::set<std::uint32_t>> groups;
  const std::vector<float>& uv = obj.attributes.texcoords;
  std::size_t memberships = 0;
  for (const tinyobj::shape_t& part : obj.shapes) {
    const std::vector<std::string> names = wordsOf(part.name);
    memberships += names.size() * part.mesh.indices.size();
    if (memberships > MOST_MEMBERSHIPS)
      fail(file, "expected groups whose faces have at most " + std::to_string(MOST_MEMBERSHIPS) +
                     " corners together, found more; a face may be in several groups, but not in thousands");
    for (std::size_t first = 0; first + 2 < part.mesh.indices.size(); first += 3) {
      const Triangle corners = cornersOf(file, part.mesh.indices, first, points);
      shape.triangles.push_back(corners);
      shape.cornerCoordinates.emplace_back();
      for (const std::string& name : names) groups[name].insert(corners.begin(), corners.end());
      for (std::size_t k = 0; k < 3; ++k) {
        const int at = part.mesh.indices[first + k].texcoord_index;
        if (at < 0 || 2 * static_cast<std::size_t>(at) + 1 >= uv.size()) continue;
        const std::array here{uv[2 * static_cast<std::size_t>(at)],
                              1 - uv[2 * static_cast<std::size_t>(at) + 1]};
        shape.cornerCoordinates.back()[k] = here;
        if (hasCoordinates[corners[k]]) continue;
        hasCoordinates[corners[k]] = true;
        shape.textureCoordinates[corners[k]] = here;
      }
    }
  }
  if (std::find(hasCoordinates.begin(), hasCoordinates.end(), true) == hasCoordinates.end())
    projectTextureCoordinates(shape);
  for (const auto& [name, members] : groups) shape.groups[name].assign(members.begin(), members.end());
}

void checkTriangles(const std::string& file, const MeshShape& shape) {
  for (const Triangle& t : shape.triangles) {
    const Vec3d a = shape.points[t[0]], b = shape.points[t[1]], c = shape.points[t[2]];
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    if (length(cross(b - a, c - a)) > FLATTEST * longest * longest) continue;
    fail(file,
         "the triangle of points " + faceText(t) +
             " has no area. Dissolve degenerate faces in a modelling program (in Blender: Mesh, Clean Up, "
             "Degenerate Dissolve).");
  }
}

// The last step of reading: until then messages name points as the file counts them. The others keep their
// order, and so edges and groups theirs.
void dropLoosePoints(MeshShape& shape) {
  std::vector<bool> used(shape.points.size());
  for (const Triangle& t : shape.triangles)
    for (const std::uint32_t corner : t) used[corner] = true;
  if (std::find(used.begin(), used.end(), false) == used.end()) return;
  std::vector<std::uint32_t> places(used.size());
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const std::size_t place = shape.fileIndices.size();
    places[i] = static_cast<std::uint32_t>(place);
    shape.fileIndices.push_back(i);
    shape.points[place] = shape.points[i];
    shape.textureCoordinates[place] = shape.textureCoordinates[i];
    if (!shape.colors.empty()) shape.colors[place] = shape.colors[i];
  }
  shape.points.resize(shape.fileIndices.size());
  shape.textureCoordinates.resize(shape.fileIndices.size());
  if (!shape.colors.empty()) shape.colors.resize(shape.fileIndices.size());
  shape.loosePoints = used.size() - shape.fileIndices.size();
  for (Triangle& t : shape.triangles)
    for (std::uint32_t& corner : t) corner = places[corner];
  for (Edge& edge : shape.edges)
    for (std::uint32_t* point : {&edge.a, &edge.b, &edge.opposite[0], &edge.opposite[1]})
      *point = places[*point];
  for (auto& [name, members] : shape.groups)
    for (std::uint32_t& member : members) member = places[member];
}

// --- Edges

struct Side {  // of a triangle, from its lower to its higher point
  std::uint32_t a, b, opposite;
  bool forwards;  // whether the triangle goes from a to b
  std::uint32_t triangle;
};

std::vector<Side> sidesOf(const MeshShape& shape) {
  std::vector<Side> sides;
  sides.reserve(3 * shape.triangles.size());
  for (std::uint32_t n = 0; n < shape.triangles.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& t = shape.triangles[n];
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      sides.push_back({std::max(from, to), std::min(from, to), t[(k + 2) % 3], from > to, n});
    }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& x, const Side& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  return sides;
}

// Its edges would be said to have too many triangles, which another cure is for.
void checkForDoubles(const std::string& file, const MeshShape& shape) {
  std::vector<Triangle> triangles = shape.triangles;
  for (Triangle& t : triangles) std::ranges::sort(t);
  std::ranges::sort(triangles);
  const auto twice = std::ranges::adjacent_find(triangles);
  if (twice == triangles.end()) return;
  fail(file, "the triangle of points " + faceText(*twice) +
                 " is there twice. Leave one (in Blender: Mesh, Clean Up, Merge by Distance).");
}

void findEdges(const std::string& file, MeshShape& shape) {
  const std::vector<Side> sides = sidesOf(shape);
  for (const Side& side : sides) {
    Edge* last = shape.edges.empty() ? nullptr : &shape.edges.back();
    const std::string place =
        "the edge of points " + std::to_string(side.a + 1) + " and " + std::to_string(side.b + 1);
    if (last == nullptr || last->a != side.a || last->b != side.b) {
      shape.edges.push_back(
          {side.a, side.b, {side.opposite, side.opposite}, 1, {side.triangle, side.triangle}});
    } else if (last->triangles == 2) {
      checkForDoubles(file, shape);
      fail(file,
           place +
               " has more than two triangles: cloth is a surface, on which at most two meet. Take layers "
               "apart (in Blender: Select, All by Trait, Non Manifold).");
    } else {
      const bool before = (&side - 1)->forwards;
      if (before == side.forwards) {
        checkForDoubles(file, shape);
        fail(file, place +
                       " has two triangles of opposite orientation. Unify the normals (in Blender: Mesh, "
                       "Normals, Recalculate Outside).");
      }
      last->triangles = 2;
      last->beside[1] = side.triangle;
      (side.forwards ? last->opposite[0] : last->opposite[1]) = side.opposite;
    }
  }
}

MeshShape load(const std::string& file) {
  const ObjFile obj = readObjFile(file, "cloth's `mesh`");
  MeshShape shape;
  const std::vector<float>& xyz = obj.attributes.vertices;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
    shape.points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
  const std::vector<float>& rgb = obj.attributes.colors;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
    shape.colors.push_back({rgb[i], rgb[i + 1], rgb[i + 2]});
  shape.textureCoordinates.resize(shape.points.size());
  if (!shape.points.empty()) readFaces(file, obj, shape);
  if (shape.triangles.empty())
    fail(file, "expected an OBJ file with faces (lines that begin with f), found none");
  checkTriangles(file, shape);
  findEdges(file, shape);
  dropLoosePoints(shape);
  return shape;
}

}  // namespace

std::shared_ptr<const MeshShape> meshShapeOf(const std::string& file) {
  // Of a file: when it was written, and its number, since the clock ticks seldom.
  using Version = std::tuple<std::string, std::int64_t, std::int64_t, std::uint64_t>;
  static Recent<Version, MeshShape> shapes(MOST_KEPT_POINTS);
  const fs::path path = meshPath(file);
  struct stat facts {};
  const bool isThere = ::stat(path.c_str(), &facts) == 0;  // otherwise reading the file will report it
  const Version version{path.string(), facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec, facts.st_ino};
  if (auto shape = shapes.find(version); shape && isThere) return shape;
  auto shape = std::make_shared<const MeshShape>(load(file));
  shapes.add(version, shape, shape->points.size());
  return shape;
}

std::optional<std::uint32_t> MeshShape::pointAt(std::uint32_t fileIndex) const {
  if (fileIndices.empty()) return fileIndex < points.size() ? std::optional(fileIndex) : std::nullopt;
  const auto found = std::ranges::lower_bound(fileIndices, fileIndex);
  if (found == fileIndices.end() || *found != fileIndex) return std::nullopt;
  return static_cast<std::uint32_t>(found - fileIndices.begin());
}

std::vector<Vec3d> placedPoints(const MeshShape& shape, const ClothSettings& cloth) {
  const Matrix3 turn = rotationMatrix(cloth.rotation);
  std::vector<Vec3d> points;
  points.reserve(shape.points.size());
  for (const Vec3d& p : shape.points) points.push_back(rotate(turn, cloth.scale * p) + cloth.position);
  return points;
}

// --- Mechanics

namespace {

double cotangent(Vec3d at, Vec3d p, Vec3d q) {
  const Vec3d a = p - at, b = q - at;
  return dot(a, b) / length(cross(a, b));
}

double areaOf(Vec3d a, Vec3d b, Vec3d c) { return 0.5 * length(cross(b - a, c - a)); }

std::vector<double> massesOf(const MeshShape& shape, const std::vector<Vec3d>& points,
                             const ClothSettings& cloth) {
  std::vector<double> masses(points.size());
  double total = 0;
  for (const Triangle& t : shape.triangles) {
    const double area = areaOf(points[t[0]], points[t[1]], points[t[2]]);
    total += area;
    for (const std::uint32_t corner : t) masses[corner] += area / 3;
  }
  const double density = cloth.material ? cloth.material->density
                         : cloth.mass   ? *cloth.mass / total
                                        : cloth.density;
  for (double& mass : masses) mass *= density;
  return masses;
}

// By triangle and edge to edges: the stiffness along each, of the triangles beside it.
std::vector<double> stiffnessAlongEdges(const MeshShape& shape, const std::vector<Vec3d>& points,
                                        const std::vector<MembraneRoots>& membranes) {
  std::vector<double> sums(shape.edges.size());
  for (std::size_t t = 0; t < membranes.size(); ++t) {
    const TriangleEdges edges = edgesOf(shape.triangles[t], points);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = shape.triangles[t][(k + 1) % 3], q = shape.triangles[t][(k + 2) % 3];
      const std::pair ends(std::max(p, q), std::min(p, q));
      const auto edge =
          std::lower_bound(shape.edges.begin(), shape.edges.end(), ends,
                           [](const Edge& e, const auto& wanted) { return std::pair(e.a, e.b) < wanted; });
      sums[static_cast<std::size_t>(edge - shape.edges.begin())] += stiffnessAlong(k, edges, membranes[t]);
    }
  }
  return sums;
}

double sumOfAreas(const Edge& edge, const std::vector<Vec3d>& points) {
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.triangles); ++k)
    sum += areaOf(points[edge.a], points[edge.b], points[edge.opposite[k]]);
  return sum;
}

std::array<double, 4> bendingAcross(const Edge& edge, const std::vector<Vec3d>& points, double rigidity) {
  const Vec3d a = points[edge.a], b = points[edge.b], p = points[edge.opposite[0]],
              q = points[edge.opposite[1]];
  const double ap = cotangent(a, b, p), aq = cotangent(a, b, q), bp = cotangent(b, a, p),
               bq = cotangent(b, a, q);
  const double weight = std::sqrt(rigidity / sumOfAreas(edge, points));
  return {weight * (bp + bq), weight * (ap + aq), -weight * (ap + bp), -weight * (aq + bq)};
}

// Of the assignments' models [N/m].
double springOf(const ClothSettings& cloth, double restLength, bool across) {
  if (cloth.stiffnessReference) return *cloth.stiffnessReference * cloth.referenceLength / restLength;
  return (across ? 0.2 : 1) * cloth.ks.value_or(0);
}

// What the map says, on mechanics that the cloth's constants have made.
void applyMap(const StiffnessMap& map, const MeshShape& shape, MeshMechanics& mechanics) {
  for (std::size_t e = 0; e < shape.edges.size(); ++e) {
    const Edge& edge = shape.edges[e];
    const double bend = map.bendFactor({edge.a, edge.b});
    mechanics.stretch[e] *= map.stretchFactor({edge.a, edge.b});
    mechanics.across[e] *= bend;
    if (mechanics.bending.empty()) continue;
    for (double& coefficient : mechanics.bending[e]) coefficient *= std::sqrt(bend);
  }
  for (std::size_t t = 0; t < mechanics.membranes.size(); ++t) {
    const auto& [a, b, c] = shape.triangles[t];
    for (double& root : mechanics.membranes[t]) root *= std::sqrt(map.stretchFactor({a, b, c}));
  }
}

}  // namespace

MeshMechanics mechanicsOf(const MeshShape& shape, const std::vector<Vec3d>& points,
                          const ClothSettings& cloth) {
  MeshMechanics mechanics;
  mechanics.masses = massesOf(shape, points, cloth);
  for (const Edge& edge : shape.edges) {
    const double l = length(points[edge.a] - points[edge.b]);
    const bool isInner = edge.triangles == 2;
    const bool bends = isInner && cloth.enableBending;
    double along = 0, across = 0;
    if (cloth.material) {
      if (bends) mechanics.bending.push_back(bendingAcross(edge, points, cloth.material->bend));
      if (!bends) mechanics.bending.push_back({});
    } else {
      along = springOf(cloth, l, false);
      if (bends) across = springOf(cloth, length(points[edge.opposite[0]] - points[edge.opposite[1]]), true);
    }
    mechanics.stretch.push_back(cloth.enableStructural ? along : 0);
    mechanics.across.push_back(across);
  }
  const bool hasMembranes = cloth.material && cloth.enableStructural;
  if (hasMembranes) mechanics.membranes = membranesOf(shape, points, cloth);
  if (!cloth.stiffnessMap.empty()) applyMap(StiffnessMap(cloth, shape), shape, mechanics);
  if (hasMembranes) mechanics.stretch = stiffnessAlongEdges(shape, points, mechanics.membranes);
  return mechanics;
}

}  // namespace clothsim

#include "cloth/cloth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "cloth/contact_memory.h"
#include "cloth/material.h"
#include "cloth/mesh_shape.h"
#include "cloth/pins.h"
#include "core/error.h"
#include "core/hash.h"
#include "scene/budget.h"
#include "scene/pose.h"

namespace clothsim {
namespace {

constexpr std::uint64_t MAX_PARTICLES = 1ull << 26;
constexpr double NOMINAL_LENGTH_TOLERANCE = 1e-6;  // [m]
constexpr double JITTER = 0.001;                   // [m], z of a vertical sheet, so that it can buckle
constexpr double JITTER_OF_SPACING = 0.002;        // no spring of a flat rest shape starts at more than 1e-5
constexpr std::uint32_t JITTER_SEED = 184;

bool kindEnabled(const ClothSettings& settings, SpringKind kind) {
  switch (kind) {
    case SpringKind::structural:
      return settings.enableStructural;
    case SpringKind::shear:
      return settings.enableShearing;
    case SpringKind::bending:
      return settings.enableBending;
  }
  return false;
}

// Spring constants of CS184's and CS171's models (docs/physics.md) [N/m].
double springStiffness(const ClothSettings& settings, SpringKind kind, double restLength) {
  if (settings.stiffnessReference)
    return *settings.stiffnessReference * settings.referenceLength / restLength;
  const double ks = settings.ks.value_or(0);
  return kind == SpringKind::bending ? 0.2 * ks : ks;
}

// The springs and masses of a material (cloth/material.h).
void putMaterial(const ClothSettings& settings, Piece& piece) {
  const double dx = spacing(settings.width, piece.columns), dy = spacing(settings.height, piece.rows);
  const LatticeStiffness k = latticeStiffness(*settings.material, dx, dy);
  piece.hasMaterial = true;
  piece.particleMass = settings.material->density * dx * dy;
  piece.stiffness = {k.alongRow, k.alongColumn, k.diagonal, k.diagonal, 0, 0};
  piece.slotEnabled[toSecondLeft] = piece.slotEnabled[toSecondUpper] = false;
  if (!settings.enableBending) return;
  piece.bendAlongRow = k.bendAlongRow;
  piece.bendAlongColumn = k.bendAlongColumn;
}

Piece makeGrid(const ClothSettings& settings, std::uint32_t firstParticle) {
  Piece piece;
  piece.firstParticle = firstParticle;
  piece.columns = settings.numWidthPoints;
  piece.rows = settings.numHeightPoints;
  piece.rowsGoUp = settings.orientation == Orientation::vertical;
  const double mass = settings.mass.value_or(settings.width * settings.height * settings.density);
  piece.particleMass = mass / piece.particleCount();
  const double dx = spacing(settings.width, piece.columns), dy = spacing(settings.height, piece.rows);
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
    const SpringOffset& offset = springOffsets[slot];
    const bool fits = std::abs(offset.columns) < piece.columns && std::abs(offset.rows) < piece.rows;
    if (!fits) continue;
    piece.slotEnabled[slot] = kindEnabled(settings, offset.kind);
    piece.nominalLength[slot] = std::hypot(offset.columns * dx, offset.rows * dy);
    piece.stiffness[slot] = springStiffness(settings, offset.kind, piece.nominalLength[slot]);
  }
  if (settings.material) putMaterial(settings, piece);
  return piece;
}

// CS184 measures rest lengths on the sheet as it starts, jitter included. Fabrics, and CS171's sheet, are cut
// from a flat one.
bool restsAsItStarts(const ClothSettings& settings) {
  return !settings.material && !settings.stiffnessReference;
}

// Largest |z| of a vertical sheet at the start [m].
double jitterOf(const ClothSettings& settings) {
  if (restsAsItStarts(settings)) return JITTER;
  const double dx = spacing(settings.width, settings.numWidthPoints),
               dy = spacing(settings.height, settings.numHeightPoints);
  return std::min(JITTER, JITTER_OF_SPACING * std::min(dx, dy));
}

// Where the lattice begins: (u, 1, v) or (u, v, z) with z from a hash, turned and moved [m].
void appendPositions(const ClothSettings& settings, std::uint32_t firstParticle,
                     std::vector<Vec3d>& positions) {
  const Matrix3 turn = rotationMatrix(settings.rotation);
  const int columns = settings.numWidthPoints, rows = settings.numHeightPoints;
  const Vec3d origin = settings.orientation == Orientation::horizontal ? Vec3d{0, 1, 0} : Vec3d{0, 0, 0};
  const double jitter = jitterOf(settings);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double u = columns > 1 ? settings.width * column / (columns - 1) : 0;
      const double v = rows > 1 ? settings.height * row / (rows - 1) : 0;
      const auto index = static_cast<std::uint32_t>(positions.size()) - firstParticle;
      const Vec3d local = settings.orientation == Orientation::horizontal
                              ? Vec3d{u, 0, v}
                              : Vec3d{u, v, jitter * (2 * uniform01(JITTER_SEED, index) - 1)};
      positions.push_back(origin + rotate(turn, local) + settings.position);
    }
  }
}

// Whether some spring, measured between positions as binary32 stores them, differs from its kind's nominal
// length.
bool differsFromNominal(const Piece& piece, std::span<const Vec3d> positions) {
  for (int row = 0; row < piece.rows; ++row) {
    for (int column = 0; column < piece.columns; ++column) {
      for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
        const SpringOffset& offset = springOffsets[slot];
        if (!piece.slotEnabled[slot] || !piece.contains(column + offset.columns, row + offset.rows)) continue;
        const Vec3d a = positions[piece.particle(column, row)].cast<float>().cast<double>();
        const Vec3d b = positions[piece.particle(column + offset.columns, row + offset.rows)]
                            .cast<float>()
                            .cast<double>();
        if (std::abs(length(b - a) - piece.nominalLength[slot]) > NOMINAL_LENGTH_TOLERANCE) return true;
      }
    }
  }
  return false;
}

// An unpinned vertex cannot be moved along a path, nor one along two.
void checkPinMotions(const ClothSettings& settings) {
  const auto conflict = findPinConflict(settings);
  if (!conflict) return;
  throw SceneError("cloth.pin_motion." + std::to_string(conflict->motion) + ": " +
                   (conflict->otherMotion
                        ? "expected each pin in one motion, found " + conflict->point + " in pin_motion." +
                              std::to_string(*conflict->otherMotion) + ", too"
                        : "expected only pins of the cloth, found " + conflict->point +
                              ", which the cloth's key \"pinned\" does not name") +
                   " (" + settings.mesh + ")");
}

// How long a unit of u and of v is on the mesh, as the mean over its area: |dx/du|, |dx/dv|.
std::array<double, 2> textureSizeOf(const MeshShape& shape, const std::vector<Vec3d>& points) {
  double areas = 0, alongU = 0, alongV = 0;
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const MeshShape::Triangle& t = shape.triangles[i];
    const Vec3d p = points[t[1]] - points[t[0]], q = points[t[2]] - points[t[0]];
    const auto& [a, b, c] = shape.cornerCoordinates[i];
    const double pu = double{b[0]} - double{a[0]}, pv = double{b[1]} - double{a[1]},
                 qu = double{c[0]} - double{a[0]}, qv = double{c[1]} - double{a[1]};
    const double determinant = pu * qv - qu * pv, area = length(cross(p, q));
    if (std::abs(determinant) < 1e-12) continue;
    areas += area;
    alongU += area * length((1 / determinant) * (qv * p - pv * q));
    alongV += area * length((1 / determinant) * (pu * q - qu * p));
  }
  return areas > 0 ? std::array{alongU / areas, alongV / areas} : std::array{1.0, 1.0};
}

// Where the particles and the triangles of a mesh begin.
struct MeshPlace {
  std::uint32_t particle, triangle;
  [[nodiscard]] TrianglesBeside beside(const MeshShape::Edge& edge) const {
    return {triangle + edge.beside[0], triangle + edge.beside[1]};
  }
};

// The springs of a mesh along and across its edges.
void appendSprings(const MeshShape& shape, const MeshMechanics& mechanics, const MeshPlace& place,
                   std::vector<MeshSpring>& springs) {
  const std::uint32_t first = place.particle;
  for (std::size_t e = 0; e < shape.edges.size(); ++e) {
    const MeshShape::Edge& edge = shape.edges[e];
    const auto& [p, q] = edge.opposite;
    if (mechanics.stretch[e] > 0)
      springs.push_back({first + edge.a, first + edge.b, SpringKind::structural,
                         mechanics.membranes.empty() ? mechanics.stretch[e] : 0, place.beside(edge)});
    if (mechanics.across[e] > 0)
      springs.push_back({first + std::max(p, q), first + std::min(p, q), SpringKind::bending,
                         mechanics.across[e], place.beside(edge)});
  }
}

void appendHinges(const MeshShape& shape, const MeshMechanics& mechanics, const MeshPlace& place,
                  std::vector<Hinge>& hinges) {
  const std::uint32_t first = place.particle;
  for (std::size_t e = 0; e < mechanics.bending.size(); ++e) {
    const MeshShape::Edge& edge = shape.edges[e];
    if (mechanics.bending[e] == std::array<double, 4>{}) continue;
    hinges.push_back({{first + edge.a, first + edge.b, first + edge.opposite[0], first + edge.opposite[1]},
                      mechanics.bending[e],
                      place.beside(edge)});
  }
}

// With the moduli of the material on the shrunk triangles, too, whose squares of lengths are smaller.
void appendMembranes(const MeshShape& shape, const MeshMechanics& mechanics, const MeshPlace& place,
                     double restScale, std::vector<Membrane>& membranes) {
  const std::uint32_t first = place.particle;
  for (std::uint32_t t = 0; t < mechanics.membranes.size(); ++t) {
    const auto& [a, b, c] = shape.triangles[t];
    Membrane membrane{{first + a, first + b, first + c}, mechanics.membranes[t], place.triangle + t};
    for (double& root : membrane.roots) root /= restScale;
    membranes.push_back(membrane);
  }
}

}  // namespace

Cloth::Cloth(const Scene& scene) {
  checkContactMemory(scene);
  for (const ClothSettings& settings : scene.cloths)
    settings.isMesh() ? addMesh(settings) : addGrid(settings);
  seams_ = seamSprings(scene, pieces_, positions_);
  if (lists_.empty()) return;
  gatherIncidences(lists_, particleCount());
  meshMasses_.resize(particleCount());
  meshCoordinates_.resize(particleCount());
}

void Cloth::checkSize(std::uint64_t more) const {
  const std::uint64_t total = positions_.size() + more;
  if (total > MAX_PARTICLES)
    throw SceneError("the cloths hold " + std::to_string(total) + " particles together; at most " +
                     std::to_string(MAX_PARTICLES) +
                     " are possible. Use fewer points or a smaller --resolution.");
  checkMemory(static_cast<double>(total));
}

void Cloth::holdPins(const ClothSettings& settings, std::uint32_t first) {
  const std::vector<bool> pinned = pinnedParticles(settings);
  const std::vector<bool> free = freeAtTheStart(settings);
  for (std::size_t i = 0; i < pinned.size(); ++i)
    if (pinned[i] && !(i < free.size() && free[i])) inverseMasses_[first + i] = 0;
}

void Cloth::addGrid(const ClothSettings& settings) {
  Piece piece = makeGrid(settings, particleCount());
  checkSize(piece.particleCount());
  appendPositions(settings, piece.firstParticle, positions_);
  for (int row = 0; row < piece.rows; ++row)
    for (int column = 0; column < piece.columns; ++column)
      inverseMasses_.push_back(1 / (piece.particleMass * piece.massWeight(column, row)));
  holdPins(settings, piece.firstParticle);
  piece.hasRestLengthTable = restsAsItStarts(settings) && differsFromNominal(piece, positions_);
  piece.restScale = 1 - settings.shrink;
  for (double& nominal : piece.nominalLength) nominal *= piece.restScale;
  pieces_.push_back(piece);
}

void Cloth::addMesh(const ClothSettings& settings) {
  const std::shared_ptr<const MeshShape> shape = meshShapeOf(settings.mesh);
  checkSize(shape->points.size());
  checkPinMotions(settings);
  const std::vector<Vec3d> points = placedPoints(*shape, settings);
  const MeshMechanics mechanics = mechanicsOf(*shape, points, settings);
  Piece mesh;
  mesh.isMesh = true;
  mesh.firstParticle = particleCount();
  mesh.columns = static_cast<int>(points.size());
  mesh.rows = 1;
  const std::uint32_t first = mesh.firstParticle, end = first + mesh.particleCount();

  double sum = 0;
  for (const MeshShape::Edge& edge : shape->edges) {
    const double l = length(points[edge.a] - points[edge.b]);
    sum += l;
    mesh.longestEdge = std::max(mesh.longestEdge, l);
  }
  mesh.restScale = 1 - settings.shrink;
  mesh.nominalLength.fill(mesh.restScale * sum / static_cast<double>(shape->edges.size()));
  mesh.textureSize = textureSizeOf(*shape, points);

  positions_.insert(positions_.end(), points.begin(), points.end());
  for (const double mass : mechanics.masses) inverseMasses_.push_back(1 / mass);
  holdPins(settings, first);
  meshMasses_.resize(first);
  meshMasses_.insert(meshMasses_.end(), mechanics.masses.begin(), mechanics.masses.end());
  meshCoordinates_.resize(first);
  meshCoordinates_.insert(meshCoordinates_.end(), shape->textureCoordinates.begin(),
                          shape->textureCoordinates.end());

  const std::size_t firstSpring = lists_.springs.size();
  mesh.firstTriangle = static_cast<std::uint32_t>(lists_.triangles.size());
  const MeshPlace place{first, mesh.firstTriangle};
  appendSprings(*shape, mechanics, place, lists_.springs);
  mesh.colors = colorSprings(lists_.springs, firstSpring, end);
  double stiffest = 0;
  for (const std::vector<double>& stiffness : {mechanics.stretch, mechanics.across})
    for (const double k : stiffness) stiffest = std::max(stiffest, k);
  mesh.stiffness.fill(stiffest);
  mesh.particleMass = std::accumulate(mechanics.masses.begin(), mechanics.masses.end(), 0.0) / mesh.columns;
  appendHinges(*shape, mechanics, place, lists_.hinges);
  appendMembranes(*shape, mechanics, place, mesh.restScale, lists_.membranes);
  for (std::size_t t = 0; t < shape->triangles.size(); ++t) {
    const auto& [a, b, c] = shape->triangles[t];
    lists_.triangles.push_back({first + a, first + b, first + c});
    const std::array ofPoints{shape->textureCoordinates[a], shape->textureCoordinates[b],
                              shape->textureCoordinates[c]};
    if (shape->cornerCoordinates[t] != ofPoints)
      textureSeams_.emplace(lists_.triangles.back(), shape->cornerCoordinates[t]);
  }
  mesh.endTriangle = static_cast<std::uint32_t>(lists_.triangles.size());
  pieces_.push_back(std::move(mesh));
}

double Cloth::massOf(std::uint32_t particle) const {
  const Piece& piece = pieces_[pieceOf(particle)];
  if (piece.isMesh) return meshMasses_[particle];
  const int place = static_cast<int>(particle - piece.firstParticle);
  return piece.particleMass * piece.massWeight(place % piece.columns, place / piece.columns);
}

std::size_t Cloth::pieceOf(std::uint32_t particle) const {
  const auto next =
      std::upper_bound(pieces_.begin(), pieces_.end(), particle,
                       [](std::uint32_t wanted, const Piece& piece) { return wanted < piece.firstParticle; });
  return static_cast<std::size_t>(next - pieces_.begin()) - 1;
}

bool Cloth::hasRestLengthTable() const {
  for (const Piece& piece : pieces_)
    if (piece.hasRestLengthTable) return true;
  return false;
}

std::uint64_t Cloth::triangleCount() const {
  std::uint64_t count = 0;
  for (const Piece& piece : pieces_)
    count += piece.isMesh ? piece.endTriangle - piece.firstTriangle
                          : 2 * static_cast<std::uint64_t>(piece.columns - 1) *
                                static_cast<std::uint64_t>(piece.rows - 1);
  return count;
}

std::uint64_t Cloth::springCount() const {
  std::uint64_t count = lists_.springs.size();
  for (const Piece& piece : pieces_)
    for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot)
      if (piece.slotEnabled[slot])
        count += static_cast<std::uint64_t>(piece.columns - std::abs(springOffsets[slot].columns)) *
                 static_cast<std::uint64_t>(piece.rows - std::abs(springOffsets[slot].rows));
  return count;
}

std::vector<std::array<std::uint32_t, 3>> Cloth::triangles() const {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(triangleCount());
  for (const Piece& piece : pieces_) {
    if (piece.isMesh)
      triangles.insert(triangles.end(), lists_.triangles.begin() + piece.firstTriangle,
                       lists_.triangles.begin() + piece.endTriangle);
    for (int row = 0; row + 1 < piece.rows; ++row) {
      for (int column = 0; column + 1 < piece.columns; ++column) {
        const auto cell = piece.cellTriangles(column, row);
        triangles.insert(triangles.end(), cell.begin(), cell.end());
      }
    }
  }
  return triangles;
}

std::vector<std::array<float, 2>> Cloth::textureCoordinates() const {
  std::vector<std::array<float, 2>> coordinates;
  coordinates.reserve(particleCount());
  for (const Piece& piece : pieces_)
    for (int row = 0; row < piece.rows; ++row)
      for (int column = 0; column < piece.columns; ++column) {
        const int fromTop = piece.rowsGoUp ? piece.rows - 1 - row : row;
        coordinates.push_back(
            piece.isMesh
                ? meshCoordinates_[piece.particle(column, row)]
                : std::array{static_cast<float>(column) / static_cast<float>(std::max(1, piece.columns - 1)),
                             static_cast<float>(fromTop) / static_cast<float>(std::max(1, piece.rows - 1))});
      }
  return coordinates;
}

double Cloth::restLength(const Piece& piece, std::size_t slot, std::uint32_t a, std::uint32_t b) const {
  if (!piece.isMesh && !piece.hasRestLengthTable) return piece.nominalLength[slot];
  return piece.restScale * length(positions_[b] - positions_[a]);
}

std::vector<Spring> Cloth::springs() const {
  std::vector<Spring> springs;
  for (const Piece& piece : pieces_) {
    for (int row = 0; row < piece.rows; ++row) {
      for (int column = 0; column < piece.columns; ++column) {
        const std::uint32_t owner = piece.particle(column, row);
        for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
          const SpringOffset& offset = springOffsets[slot];
          if (!piece.slotEnabled[slot] || !piece.contains(column + offset.columns, row + offset.rows))
            continue;
          const std::uint32_t other = piece.particle(column + offset.columns, row + offset.rows);
          springs.push_back(
              {static_cast<std::uint32_t>(SPRING_SLOTS * owner + slot), offset.kind, owner, other,
               piece.stiffness[slot] * piece.springWeight(column, row, static_cast<SpringSlot>(slot)),
               restLength(piece, slot, owner, other)});
        }
      }
    }
  }
  const std::uint32_t first = SPRING_SLOTS * particleCount();
  for (std::uint32_t n = 0; n < lists_.springs.size(); ++n) {
    const auto& [a, b, kind, stiffness, triangles] = lists_.springs[n];
    springs.push_back({first + n, kind, a, b, stiffness, restLength(pieces_[pieceOf(a)], 0, a, b)});
  }
  return springs;
}

double smallestSpacing(const Cloth& cloth) {
  double smallest = INFINITY;
  for (const Piece& piece : cloth.pieces())
    for (const std::size_t slot : {toLeft, toUpper})  // 0 across a rope, which has one row
      if (piece.nominalLength[slot] > 0) smallest = std::min(smallest, piece.nominalLength[slot]);
  return std::isfinite(smallest) ? smallest : 0;
}

}  // namespace clothsim

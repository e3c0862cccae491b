#include "cloth/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cloth/cloth.h"
#include "cloth/membrane.h"
#include "cloth/mesh_shape.h"
#include "core/error.h"
#include "scene/budget.h"

namespace clothsim {
namespace {

// The counts that "auto" chooses.
constexpr double LONGEST_CHOSEN_STEP = 1.0 / 60;     // [s]
constexpr double LONGEST_BUCKLING_STEP = 1.0 / 120;  // of fabric that buckles, under an implicit integrator
constexpr double LONGEST_FOLDING_STEP = 1.0 / 240;   // where cloth touches cloth: self_collision "contact"
// That sound comes in fabric in an implicit step [m]; of all presets, paper needs it.
constexpr double FURTHEST_SOUND = 4.4;
constexpr double MOST_AIR_AGAINST_INERTIA = 0.09;  // in an implicit step under pressure: h^2 p L / m
constexpr double ITERATIONS_PER_SECOND = 4800, FEWEST_ITERATIONS = 20, MOST_ITERATIONS = 60;
constexpr double FEWEST_CONTACT_ITERATIONS = 40;

struct Preset {
  std::string_view name;
  Material material;
};

// Typical, rounded values in the ranges of the Kawabata Evaluation System (KES-F; S. Kawabata, "The
// Standardization and Analysis of Hand Evaluation", 1980) for such fabrics, converted to SI: 1 gf/cm = 0.981
// N/m, 1 gf cm^2/cm = 9.81e-5 N m, 1 gf/(cm degree) = 56.2 N/m a radian. They are not measurements of one
// cloth. Jersey is knitted, not woven: its loops give way, so it stretches some thirty times as easily.
// Rubber: a latex sheet of 0.4 mm, E = 1.5 MPa, Poisson 1/2, 930 kg/m^3. Paper: 80 g/m^2, 0.1 mm, E = 3.5
// GPa, B = E t^3 / 12. Damping is chosen so that motion stays lively without
// ringing on.
constexpr std::array<Preset, 7> presets{{
    {"silk",
     {.density = 0.06,
      .stretch = 8'000,
      .shear = 20,
      .bend = 3e-6,
      .damping = 0.3,
      .thickness = 0.0002,
      .friction = 0.25}},
    {"cotton",
     {.density = 0.15,
      .stretch = 10'000,
      .shear = 50,
      .bend = 1e-5,
      .damping = 0.5,
      .thickness = 0.0005,
      .friction = 0.4}},
    {"denim",
     {.density = 0.40,
      .stretch = 25'000,
      .shear = 150,
      .bend = 8e-5,
      .damping = 0.8,
      .thickness = 0.001,
      .friction = 0.5}},
    {"wool",
     {.density = 0.25,
      .stretch = 6'000,
      .shear = 40,
      .bend = 1.2e-5,
      .damping = 0.8,
      .thickness = 0.0008,
      .friction = 0.4}},
    {"jersey",
     {.density = 0.18,
      .stretch = 250,
      .shear = 90,
      .bend = 5e-6,
      .damping = 0.8,
      .thickness = 0.0007,
      .friction = 0.4}},
    {"rubber",
     {.density = 0.37,
      .stretch = 600,
      .shear = 200,
      .bend = 8e-6,
      .damping = 1,
      .thickness = 0.0004,
      .friction = 0.9}},
    {"paper",
     {.density = 0.08,
      .stretch = 350'000,
      .shear = 130'000,
      .bend = 3e-4,
      .damping = 1,
      .thickness = 0.0001,
      .friction = 0.4}},
}};

}  // namespace

bool usesMaterial(const Scene& scene) {
  return std::any_of(scene.cloths.begin(), scene.cloths.end(),
                     [](const ClothSettings& cloth) { return cloth.material.has_value(); });
}

std::optional<Material> materialPreset(std::string_view name) {
  for (const Preset& preset : presets)
    if (preset.name == name) return preset.material;
  return std::nullopt;
}

std::vector<std::string> materialPresetNames() {
  std::vector<std::string> names;
  for (const Preset& preset : presets) names.emplace_back(preset.name);
  return names;
}

void giveMaterial(ClothSettings& cloth, const Material& material) {
  const ClothSettings plain;
  cloth.material = material;
  cloth.ks.reset();
  cloth.stiffnessReference.reset();
  cloth.mass.reset();
  cloth.density = plain.density;
  cloth.damping = plain.damping;
  cloth.thickness = plain.thickness;
}

SheetModuli sheetModuli(const Material& material) {
  const double y = material.stretch, g = material.shear, warp = material.stretchWarp.value_or(y);
  const double c11 = 0.5 * (y + std::sqrt(y * y + 4 * g * g * (y / warp)));
  return {c11, c11 * (warp / y), g, g};
}

// The energy of springs k (l - L)^2 / 2 under a small strain, a cell: with two diagonals of length l =
// hypot(dx, dy), C11 dx dy = k_row dx^2 + 2 k_d dx^4 / l^2 and C12 dx dy = 2 k_d dx^2 dy^2 / l^2; likewise
// along columns.
LatticeStiffness latticeStiffness(const Material& material, double dx, double dy) {
  const auto [c11, c22, c12, g] = sheetModuli(material);
  LatticeStiffness k;
  if (dx == 0 || dy == 0) return k;
  k.diagonal = g * (dx * dx + dy * dy) / (2 * dx * dy);
  k.alongRow = c11 * dy / dx - g * dx / dy;
  k.alongColumn = c22 * dx / dy - g * dy / dx;
  k.bendAlongRow = material.bend * dy / (dx * dx * dx);
  k.bendAlongColumn = material.bendWarp.value_or(material.bend) * dx / (dy * dy * dy);
  return k;
}

namespace {

// How much stiffer a membrane is that is stretched by a tenth: (3 1.1^2 - 1) / 2.
constexpr double MEMBRANE_MARGIN = 1.315;

// A mesh as it is built; none when its file or its stiffness map is wrong, which building the cloth will
// report.
struct PlacedMesh {
  std::shared_ptr<const MeshShape> shape;
  std::vector<Vec3d> points;
  MeshMechanics mechanics;
};
std::optional<PlacedMesh> placedMesh(const ClothSettings& cloth) {
  try {
    PlacedMesh mesh{.shape = meshShapeOf(cloth.mesh), .points = {}, .mechanics = {}};
    mesh.points = placedPoints(*mesh.shape, cloth);
    mesh.mechanics = mechanicsOf(*mesh.shape, mesh.points, cloth);
    return mesh;
  } catch (const SceneError&) {
    return std::nullopt;
  }
}

// Infinite when the mesh cannot be built.
double stableStepOfMesh(const ClothSettings& cloth) {
  const std::optional<PlacedMesh> placed = placedMesh(cloth);
  if (!placed) return std::numeric_limits<double>::infinity();
  const auto& [shape, points, mechanics] = *placed;
  std::vector<double> sums(shape->points.size());  // of |K| in each block row
  for (std::size_t e = 0; e < shape->edges.size(); ++e) {
    const MeshShape::Edge& edge = shape->edges[e];
    if (mechanics.membranes.empty())
      for (const std::uint32_t end : {edge.a, edge.b}) sums[end] += 2 * mechanics.stretch[e];
    for (const std::uint32_t end : edge.opposite) sums[end] += 2 * mechanics.across[e];
    if (mechanics.bending.empty()) continue;
    const auto& c = mechanics.bending[e];
    const double all = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) + std::abs(c[3]);
    const std::array corners{edge.a, edge.b, edge.opposite[0], edge.opposite[1]};
    for (std::size_t k = 0; k < 4; ++k) sums[corners[k]] += std::abs(c[k]) * all;
  }
  for (std::size_t t = 0; t < mechanics.membranes.size(); ++t) {
    const double bound =
        MEMBRANE_MARGIN * membraneBound(edgesOf(shape->triangles[t], points), mechanics.membranes[t]);
    for (const std::uint32_t corner : shape->triangles[t]) sums[corner] += bound;
  }
  double largest = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) largest = std::max(largest, sums[i] / mechanics.masses[i]);
  return largest > 0 ? 2 / std::sqrt(largest) : std::numeric_limits<double>::infinity();
}

}  // namespace

namespace {

// Stiffnesses of a grid's springs, and of what bends over three particles (LatticeStiffness) [N/m].
struct GridSprings {
  double row, column, diagonal, rowOverTwo, columnOverTwo, bendRow, bendColumn;
};

GridSprings springsOf(const ClothSettings& cloth, double dx, double dy) {
  const double structural = cloth.enableStructural ? 1 : 0, shear = cloth.enableShearing ? 1 : 0,
               bending = cloth.enableBending ? 1 : 0;
  if (cloth.material) {
    const LatticeStiffness k = latticeStiffness(*cloth.material, dx, dy);
    return {structural * std::max(k.alongRow, 0.0),
            structural * std::max(k.alongColumn, 0.0),
            shear * k.diagonal,
            0,
            0,
            bending * k.bendAlongRow,
            bending * k.bendAlongColumn};
  }
  if (cloth.stiffnessReference) {
    const double unit = *cloth.stiffnessReference * cloth.referenceLength;
    return {structural * unit / dx,
            structural * unit / dy,
            shear * unit / std::hypot(dx, dy),
            bending * unit / (2 * dx),
            bending * unit / (2 * dy),
            0,
            0};
  }
  const double ks = cloth.ks.value_or(defaultKs);
  return {structural * ks, structural * ks, shear * ks, bending * 0.2 * ks, bending * 0.2 * ks, 0, 0};
}

// The largest eigenvalue of K of an endless grid whose springs resist in all directions as they do along
// themselves: no shape of the cloth is stiffer, nor is a part of the grid. It is that of a wave, a and b the
// cosines of its angles a cell.
double largestEigenvalue(const GridSprings& k) {
  constexpr int parts = 64;
  double largest = 0;
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; j <= parts; ++j) {
      const double a = 1 - 2.0 * i / parts, b = 1 - 2.0 * j / parts;
      largest =
          std::max(largest, 2 * k.row * (1 - a) + 2 * k.column * (1 - b) + 4 * k.diagonal * (1 - a * b) +
                                4 * k.rowOverTwo * (1 - a * a) + 4 * k.columnOverTwo * (1 - b * b) +
                                4 * k.bendRow * (1 - a) * (1 - a) + 4 * k.bendColumn * (1 - b) * (1 - b));
    }
  constexpr double betweenThem = 1.001;  // of the waves that were looked at
  return betweenThem * largest;
}

// Of a particle inside a grid [kg].
double gridMass(const ClothSettings& cloth, double dx, double dy) {
  if (cloth.material) return cloth.material->density * dx * dy;
  return cloth.mass.value_or(cloth.width * cloth.height * cloth.density) /
         (static_cast<double>(cloth.numWidthPoints) * cloth.numHeightPoints);
}

// Bounds the largest eigenvalue of K/m of the seams alone, by Gershgorin's circles; 0 when the cloth cannot
// be built.
double seamEigenvalueOf(const Scene& scene) {
  try {
    const Cloth cloth(scene);
    std::vector<double> sums(cloth.particleCount());
    for (const SeamSpring& spring : cloth.seams())
      for (const std::uint32_t end : {spring.a, spring.b}) sums[end] += 2 * spring.stiffness;
    double largest = 0;
    for (std::uint32_t i = 0; i < sums.size(); ++i) largest = std::max(largest, sums[i] / cloth.massOf(i));
    return largest;
  } catch (const SceneError&) {
    return 0;
  }
}

// The viewer asks in every frame, and it takes a cloth to know.
double largestSeamEigenvalue(const Scene& scene) {
  if (scene.seams.empty()) return 0;
  thread_local struct {
    std::vector<ClothSettings> cloths;
    std::vector<Seam> seams;
    double largest = 0;
  } known;
  if (known.cloths != scene.cloths || known.seams != scene.seams)
    known = {scene.cloths, scene.seams, seamEigenvalueOf(scene)};
  return known.largest;
}

}  // namespace

double stableStep(const ClothSettings& cloth) {
  if (cloth.isMesh()) return stableStepOfMesh(cloth);
  const double dx = spacing(cloth.width, cloth.numWidthPoints),
               dy = spacing(cloth.height, cloth.numHeightPoints);
  const double largest = largestEigenvalue(springsOf(cloth, dx, dy));
  return largest > 0 ? 2 * std::sqrt(gridMass(cloth, dx, dy) / largest)
                     : std::numeric_limits<double>::infinity();
}

double stableStep(const Scene& scene) {
  if (isImplicit(scene.solver.integrator)) return std::numeric_limits<double>::infinity();
  double smallest = std::numeric_limits<double>::infinity();
  for (const ClothSettings& cloth : scene.cloths) smallest = std::min(smallest, stableStep(cloth));
  const double seams = largestSeamEigenvalue(scene), cloths = 4 / (smallest * smallest);
  return seams > 0 ? 2 / std::sqrt(cloths + seams) : smallest;
}

double bucklingHeight(const Material& material) {
  const double bend = std::min(material.bend, material.bendWarp.value_or(material.bend));
  return std::cbrt(7.8373 * bend / (material.density * 9.81));
}

namespace {

bool buckles(const ClothSettings& cloth) {
  return cloth.material &&
         (cloth.isMesh() || std::max(cloth.width, cloth.height) > bucklingHeight(*cloth.material));
}

// Newton's method does not know how the air's force turns with the cloth: by pressure times the length of an
// edge for a particle's way. Against its inertia that must be little.
double longestPressedStep(const ClothSettings& cloth) {
  if (cloth.pressure == 0) return std::numeric_limits<double>::infinity();
  double mass = 0, edge = 0;  // of a particle, the mean one of a mesh
  if (!cloth.isMesh()) {
    const double dx = spacing(cloth.width, cloth.numWidthPoints),
                 dy = spacing(cloth.height, cloth.numHeightPoints);
    mass = gridMass(cloth, dx, dy);
    edge = std::max(dx, dy);
  } else if (const std::optional<PlacedMesh> mesh = placedMesh(cloth)) {
    for (const double each : mesh->mechanics.masses) mass += each;
    for (const auto& each : mesh->shape->edges) edge += length(mesh->points[each.b] - mesh->points[each.a]);
    mass /= static_cast<double>(mesh->points.size());
    edge /= static_cast<double>(mesh->shape->edges.size());
  }
  const double turning = std::abs(cloth.pressure) * edge;
  return turning > 0 ? std::sqrt(MOST_AIR_AGAINST_INERTIA * mass / turning)
                     : std::numeric_limits<double>::infinity();
}

// How stiff fabric is, against its inertia: by the speed of sound, (Y/rho)^(1/2). Crumpled fabric presses on
// itself by that, and a stiff sheet that turns is stretched by it in every Newton step.
double longestSoundStep(const ClothSettings& cloth) {
  if (!cloth.material) return std::numeric_limits<double>::infinity();
  const Material& material = *cloth.material;
  const double stretch = std::max(material.stretch, material.stretchWarp.value_or(material.stretch));
  return FURTHEST_SOUND * std::sqrt(material.density / stretch);
}

// Newton's method is slow where folds come and go. There, halving the step makes the motion more accurate
// than doubling the Newton steps does.
double longestChosenStep(const Scene& scene) {
  const bool isSolved = isImplicit(scene.solver.integrator),
             touches = scene.solver.selfCollision == SelfCollision::contact,
             folds = isSolved && std::any_of(scene.cloths.begin(), scene.cloths.end(), buckles);
  double longest = folds ? LONGEST_BUCKLING_STEP : LONGEST_CHOSEN_STEP;
  if (touches && (folds || scene.cloths.size() > 1)) longest = LONGEST_FOLDING_STEP;
  if (!isSolved) return longest;
  for (const ClothSettings& cloth : scene.cloths)
    longest = std::min({longest, longestPressedStep(cloth), longestSoundStep(cloth)});
  return longest;
}

}  // namespace

int stableSteps(const Scene& scene) {
  const double longest = std::min(stableStep(scene), longestChosenStep(scene));
  const double steps = std::ceil(1 / (scene.solver.framesPerSec * longest) * (1 - 1e-9));
  return static_cast<int>(std::clamp(steps, 1.0, static_cast<double>(mostSteps)));
}

namespace {

// The longer the step, the further sound comes in it and the more there is to solve. These are caps: most
// linear systems end long before. What 20 iterations leave of how layers press on each other is noise, which
// rubs too much or too little, and takes more Newton steps to solve than it saves (RowLayersThatRub).
int iterationsFor(double step, bool touches) {
  const double iterations = std::ceil(step * ITERATIONS_PER_SECOND * (1 - 1e-9));
  const double fewest = touches ? FEWEST_CONTACT_ITERATIONS : FEWEST_ITERATIONS;
  return static_cast<int>(std::clamp(iterations, fewest, MOST_ITERATIONS));
}

}  // namespace

void chooseCounts(Scene& scene) {
  // The coarse levels do not know what seams join: there are more directions for the iterations to find.
  const int more = scene.seams.empty() ? 1 : 3;
  SolverSettings& solver = scene.solver;
  if (solver.simulationSteps.automatic) solver.simulationSteps.count = stableSteps(scene);
  const bool touches = solver.selfCollision == SelfCollision::contact;
  if (solver.cgIterations.automatic)
    solver.cgIterations.count = more * iterationsFor(stepLength(solver), touches);
}

}  // namespace clothsim

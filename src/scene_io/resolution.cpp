// --resolution: the same cloth with another number of points.
#include <algorithm>
#include <cmath>

#include "cloth/material.h"
#include "cloth/pins.h"
#include "core/error.h"
#include "core/formatted.h"
#include "scene/cloth_name.h"
#include "scene_io/field_table.h"
#include "scene_io/json_tree.h"
#include "scene_io/scene_io.h"

namespace clothsim {

namespace {

double smallerSpacing(const ClothSettings& cloth) {
  return std::min(cloth.width / (cloth.numWidthPoints - 1), cloth.height / (cloth.numHeightPoints - 1));
}

// Point i of n to the nearest of m points; ends stay ends.
int movedIndex(int i, int n, int m) {
  return static_cast<int>(std::lround(static_cast<double>(i) * (m - 1) / (n - 1)));
}

// `cloth` still has as many points as the pins were made for.
void movePins(std::vector<Pin>& pins, const ClothSettings& cloth, int columns, int rows) {
  const auto moved = [&](GridPoint point) {
    return GridPoint{movedIndex(point.column, cloth.numWidthPoints, columns),
                     movedIndex(point.row, cloth.numHeightPoints, rows)};
  };
  for (Pin& pin : pins) {
    if (auto* point = std::get_if<GridPoint>(&pin)) *point = moved(*point);
    if (auto* range = std::get_if<GridRange>(&pin)) *range = {moved(range->from), moved(range->to)};
  }
}

void movePins(ClothSettings& cloth, int columns, int rows) {
  movePins(cloth.pinned, cloth, columns, rows);
  for (PinMotion& motion : cloth.pinMotion) movePins(motion.pinned, cloth, columns, rows);
}

std::string sidesText(int columns, int rows) { return std::to_string(columns) + "x" + std::to_string(rows); }

// On a grid that is too coarse, pins of different motions would fall on one point. `cloth` still has as many
// points as the pins were made for; `asked` is what the user asked for.
void checkPinsStayApart(ClothSettings cloth, int columns, int rows, const std::string& asked) {
  if (cloth.pinMotion.empty() || cloth.isMesh()) return;
  movePins(cloth, columns, rows);
  cloth.numWidthPoints = columns;
  cloth.numHeightPoints = rows;
  const auto conflict = findPinConflict(cloth);
  if (!conflict) return;
  const std::string& point = conflict->point;
  if (conflict->otherMotion)
    throw UsageError(asked + ": two of a cloth's pin motions would meet in point " + point +
                     "; expected a grid fine enough to tell their pins apart");
  throw UsageError(asked + ": a pin motion would move point " + point +
                   ", which is not pinned then; expected \"pinned\" and \"pin_motion\" to name the same "
                   "ranges or points");
}

// How many steps an explicit integrator needs in place of one before the change. In scenes with `ks` a
// particle gets lighter with the square of the spacing ratio while ks stays, and the stable step is
// proportional to sqrt(m/k). With stiffness_reference k grows, too.
int stepFactor(const ClothSettings& cloth, int columns, int rows) {
  if (cloth.material) {
    ClothSettings finer = cloth;
    finer.numWidthPoints = columns;
    finer.numHeightPoints = rows;
    return std::max(1, static_cast<int>(std::ceil(stableStep(cloth) / stableStep(finer) - 1e-9)));
  }
  const double ratio = std::max(static_cast<double>(columns - 1) / (cloth.numWidthPoints - 1),
                                static_cast<double>(rows - 1) / (cloth.numHeightPoints - 1));
  const double needed = cloth.stiffnessReference ? std::pow(ratio, 1.5) : ratio;
  return std::max(1, static_cast<int>(std::ceil(needed - 1e-9)));
}

void checkSides(std::size_t grids, int columns, int rows) {
  if (grids == 0)
    throw UsageError(
        "--resolution: expected a scene with a grid, found only meshes, whose resolution is that of their "
        "files; subdivide them in a modelling program");
  const std::string asked = "--resolution " + sidesText(columns, rows) + ": ";
  for (const int side : {columns, rows})
    if (side < smallestSide || side > largestSide)
      throw UsageError(asked + "expected " + std::to_string(smallestSide) + " to " +
                       std::to_string(largestSide) + " points on each side, found " + std::to_string(side));
  const double particles = static_cast<double>(grids) * columns * rows;
  if (particles > mostParticles)
    throw UsageError(asked + "expected at most " + formatNumber(mostParticles) + " particles, found " +
                     formatNumber(particles));
}

// A number for a remark: rounded, but with all digits of a count of steps.
std::string shortNumber(double value) { return formatted("%.7g", value); }

// One cloth gets that grid. Returns the factor of steps that it needs then.
int changeGrid(Scene& scene, std::size_t index, int columns, int rows) {
  ClothSettings& cloth = scene.cloths[index];
  const int factor = stepFactor(cloth, columns, rows);
  movePins(cloth, columns, rows);
  for (Seam& seam : scene.seams)
    for (SeamSide* side : {&seam.a, &seam.b})
      if (side->cloth == static_cast<int>(index)) movePins(side->points, cloth, columns, rows);
  const double before = smallerSpacing(cloth);
  cloth.numWidthPoints = columns;
  cloth.numHeightPoints = rows;
  if (cloth.ks) cloth.thickness *= smallerSpacing(cloth) / before;
  return factor;
}

void multiplySteps(SolverSettings& solver, int factor) {
  solver.simulationSteps =
      static_cast<int>(std::min(static_cast<double>(solver.simulationSteps) * factor, double{mostSteps}));
}

}  // namespace

void followGrids(Scene& edited, const Scene& before) {
  int factor = 1;
  for (std::size_t i = 0; i < std::min(edited.cloths.size(), before.cloths.size()); ++i) {
    ClothSettings& cloth = edited.cloths[i];
    const ClothSettings& old = before.cloths[i];
    const int columns = cloth.numWidthPoints, rows = cloth.numHeightPoints;
    if (cloth.isMesh() || old.isMesh() || (columns == old.numWidthPoints && rows == old.numHeightPoints))
      continue;
    cloth.numWidthPoints = old.numWidthPoints;
    cloth.numHeightPoints = old.numHeightPoints;
    checkPinsStayApart(cloth, columns, rows, sidesText(columns, rows) + " points");
    factor = std::max(factor, changeGrid(edited, i, columns, rows));
  }
  if (!edited.solver.simulationSteps.automatic && !isImplicit(edited.solver.integrator))
    multiplySteps(edited.solver, factor);
  chooseCounts(edited);
}

std::string changeResolution(Scene& scene, int columns, int rows, bool keepSteps) {
  checkSides(
      static_cast<std::size_t>(std::count_if(scene.cloths.begin(), scene.cloths.end(),
                                             [](const ClothSettings& cloth) { return !cloth.isMesh(); })),
      columns, rows);
  for (const ClothSettings& cloth : scene.cloths)
    checkPinsStayApart(cloth, columns, rows, "--resolution " + sidesText(columns, rows));
  std::string changes;
  const auto add = [&](const std::string& name, double before, double after) {
    if (before != after)
      changes +=
          (changes.empty() ? "" : ", ") + name + " " + shortNumber(before) + " -> " + shortNumber(after);
  };

  keepSteps = keepSteps || isImplicit(scene.solver.integrator);
  int factor = 1;
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const ClothSettings& cloth = scene.cloths[i];
    if (cloth.isMesh()) continue;
    const double thickness = cloth.thickness;
    factor = std::max(factor, changeGrid(scene, i, columns, rows));
    add(nameOfCloth(scene, i) + ".thickness", thickness, cloth.thickness);
  }
  const int before = scene.solver.simulationSteps;
  if (!scene.solver.simulationSteps.automatic && !keepSteps) multiplySteps(scene.solver, factor);
  chooseCounts(scene);
  add("solver.simulation_steps", before, scene.solver.simulationSteps);
  if (changes.empty()) return "";
  return "at " + sidesText(columns, rows) + ": " + changes;
}

}  // namespace clothsim

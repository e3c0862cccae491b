// --resolution: the same cloth with another number of points.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/field_table.h"
#include "scene/json_tree.h"
#include "scene/scene_io.h"

namespace clothsim {

namespace {

double smallerSpacing(const ClothSettings& cloth) {
  return std::min(cloth.width / (cloth.numWidthPoints - 1), cloth.height / (cloth.numHeightPoints - 1));
}

// Point i of n to the nearest of m points; ends stay ends.
int movedIndex(int i, int n, int m) {
  return static_cast<int>(std::lround(static_cast<double>(i) * (m - 1) / (n - 1)));
}

void movePins(ClothSettings& cloth, int columns, int rows) {
  const auto moved = [&](GridPoint point) {
    return GridPoint{movedIndex(point.column, cloth.numWidthPoints, columns),
                     movedIndex(point.row, cloth.numHeightPoints, rows)};
  };
  for (Pin& pin : cloth.pinned) {
    if (auto* point = std::get_if<GridPoint>(&pin)) *point = moved(*point);
    if (auto* range = std::get_if<GridRange>(&pin)) *range = {moved(range->from), moved(range->to)};
  }
}

// How many steps an explicit integrator needs for one of before. In `ks` scenes a particle gets lighter with
// the square of the spacing ratio while ks stays, and the stable step goes with sqrt(m/k); with
// stiffness_reference k grows, too.
int stepFactor(const ClothSettings& cloth, int columns, int rows) {
  const double ratio = std::max(static_cast<double>(columns - 1) / (cloth.numWidthPoints - 1),
                                static_cast<double>(rows - 1) / (cloth.numHeightPoints - 1));
  const double needed = cloth.stiffnessReference ? std::pow(ratio, 1.5) : ratio;
  return std::max(1, static_cast<int>(std::ceil(needed - 1e-9)));
}

void checkSides(std::size_t cloths, int columns, int rows) {
  const std::string asked = "--resolution " + std::to_string(columns) + "x" + std::to_string(rows) + ": ";
  for (const int side : {columns, rows})
    if (side < smallestSide || side > largestSide)
      throw UsageError(asked + "expected " + std::to_string(smallestSide) + " to " +
                       std::to_string(largestSide) + " points on each side, found " + std::to_string(side));
  const double particles = static_cast<double>(cloths) * columns * rows;
  if (particles > mostParticles)
    throw UsageError(asked + "expected at most " + formatNumber(mostParticles) + " particles, found " +
                     formatNumber(particles));
}

}  // namespace

std::string changeResolution(Scene& scene, int columns, int rows, bool keepSteps) {
  checkSides(scene.cloths.size(), columns, rows);
  std::string changes;
  const auto add = [&](const std::string& name, double before, double after) {
    if (before != after)
      changes +=
          (changes.empty() ? "" : ", ") + name + " " + formatNumber(before) + " -> " + formatNumber(after);
  };

  int factor = 1;
  for (ClothSettings& cloth : scene.cloths) {
    factor = std::max(factor, stepFactor(cloth, columns, rows));
    movePins(cloth, columns, rows);
    const double before = smallerSpacing(cloth), thickness = cloth.thickness;
    cloth.numWidthPoints = columns;
    cloth.numHeightPoints = rows;
    if (!cloth.stiffnessReference) cloth.thickness *= smallerSpacing(cloth) / before;
    add("thickness", thickness, cloth.thickness);
  }
  if (!keepSteps) {
    const double steps =
        std::min(static_cast<double>(scene.solver.simulationSteps) * factor, double{mostSteps});
    add("simulation_steps", scene.solver.simulationSteps, steps);
    scene.solver.simulationSteps = static_cast<int>(steps);
  }
  if (changes.empty()) return "";
  return "at " + std::to_string(columns) + "x" + std::to_string(rows) + ": " + changes;
}

}  // namespace clothsim

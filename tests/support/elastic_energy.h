// The elastic energy of cloths as the implicit integrator has it, written down a second time and plainly: a
// sum over springs, the strain limit's second springs and bending lines.
#pragma once

#include <cmath>
#include <vector>

#include "cloth/cuts.h"
#include "shared/interaction.h"
#include "solver/step_params.h"

namespace clothsim::test {

// Of the first cloth of a scene, which is a grid.
class ElasticEnergy {
 public:
  ElasticEnergy(const Scene& scene, const Cloth& cloth, const Cuts& cuts = {}) {
    const StepParams<double> params = makeStepParams<double>(scene, cloth, 0, 0);
    for (const Spring& spring : cloth.springs()) {
      if (isCut(cuts, cloth, spring)) continue;
      const Vec3d d = cloth.positions()[spring.b] - cloth.positions()[spring.a];
      const double rest = cloth.hasRestLengthTable() ? std::sqrt(dot(d, d)) : spring.restLength;
      springs_.push_back({spring.a, spring.b, spring.stiffness, rest, params.limitStiffness,
                          params.limitStiffness > 0 ? params.limitFactor * rest : HUGE_VAL});
    }
    if (params.hasMaterial != 0) addBending(cloth, cuts);
  }

  struct SpringTerm {
    std::uint32_t a, b;
    double stiffness, rest, limitStiffness, limit;
  };
  // b/2 |first - 2 middle + last|^2
  struct BendingTerm {
    std::uint32_t first, middle, last;
    double b;
  };
  [[nodiscard]] const std::vector<SpringTerm>& springs() const { return springs_; }
  [[nodiscard]] const std::vector<BendingTerm>& bending() const { return bending_; }

  [[nodiscard]] double at(const std::vector<Vec3d>& x) const {
    double sum = 0;
    for (const SpringTerm& spring : springs_) {
      const Vec3d d = x[spring.b] - x[spring.a];
      const double length = std::sqrt(dot(d, d)), over = std::fmax(length - spring.limit, 0);
      sum += 0.5 * spring.stiffness * (length - spring.rest) * (length - spring.rest);
      sum += 0.5 * spring.limitStiffness * over * over;
    }
    for (const BendingTerm& line : bending_) {
      const Vec3d k = curvature(line, x);
      sum += 0.5 * line.b * dot(k, k);
    }
    return sum;
  }

  [[nodiscard]] std::vector<Vec3d> gradient(const std::vector<Vec3d>& x) const {
    std::vector<Vec3d> sum(x.size());
    const auto add = [&](std::uint32_t i, Vec3d v) { sum[i] = sum[i] + v; };
    for (const SpringTerm& spring : springs_) {
      const Vec3d d = x[spring.b] - x[spring.a];
      const double length = std::sqrt(dot(d, d)), over = std::fmax(length - spring.limit, 0);
      const double tension = spring.stiffness * (length - spring.rest) + spring.limitStiffness * over;
      add(spring.b, (tension / length) * d);
      add(spring.a, (-tension / length) * d);
    }
    for (const BendingTerm& line : bending_) {
      const Vec3d k = line.b * curvature(line, x);
      add(line.first, k);
      add(line.middle, -2.0 * k);
      add(line.last, k);
    }
    return sum;
  }

 private:
  static Vec3d curvature(const BendingTerm& line, const std::vector<Vec3d>& x) {
    return (x[line.first] - x[line.middle]) + (x[line.last] - x[line.middle]);
  }

  // Lines along a border count half; one whose middle is the last pin of a clamp counts twice.
  void addBending(const Cloth& cloth, const Cuts& cuts) {
    const Piece& piece = cloth.pieces()[0];
    const std::vector<std::uint32_t> masks = makeCutMasks(cloth, cuts);
    const auto pinned = [&](std::uint32_t i) { return cloth.inverseMasses()[i] == 0; };
    const auto add = [&](int column, int row, int columns, int rows, double b, std::uint32_t links) {
      if (!piece.contains(column - columns, row - rows) || !piece.contains(column + columns, row + rows))
        return;
      const std::uint32_t first = piece.particle(column - columns, row - rows),
                          middle = piece.particle(column, row),
                          last = piece.particle(column + columns, row + rows);
      if (!masks.empty() && (masks[middle] & links) != 0) return;
      const bool endOfClamp = pinned(middle) && pinned(first) != pinned(last);
      bending_.push_back({first, middle, last, endOfClamp ? 2 * b : b});
    };
    for (int row = 0; row < piece.rows; ++row)
      for (int column = 0; column < piece.columns; ++column) {
        const bool borderRow = row == 0 || row + 1 == piece.rows,
                   borderColumn = column == 0 || column + 1 == piece.columns;
        add(column, row, 1, 0, (borderRow ? 0.5 : 1) * piece.bendAlongRow, BENDING_ROW);
        add(column, row, 0, 1, (borderColumn ? 0.5 : 1) * piece.bendAlongColumn, BENDING_COLUMN);
      }
  }

  std::vector<SpringTerm> springs_;
  std::vector<BendingTerm> bending_;
};

}  // namespace clothsim::test

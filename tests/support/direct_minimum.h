// Where a sheet has the least energy, by Newton's method with a sparse direct solver: what the implicit
// integrator is compared with.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <utility>
#include <vector>

#include "support/elastic_energy.h"

namespace clothsim::test {

// Of the elastic energy + sum s_i/2 |x_i - anchor_i|^2 - sum load_i . x_i over the particles without pins.
// First with the springs' clamped Hessian, then with the exact one, until steps are rounding.
class DirectMinimum {
 public:
  using Field = std::vector<Vec3d>;

  DirectMinimum(ElasticEnergy energy, const Cloth& cloth)
      : start(cloth.positions().begin(), cloth.positions().end()),
        anchors(start),
        loads(start.size()),
        stiffness(start.size()),
        energy_(std::move(energy)) {
    for (const double w : cloth.inverseMasses()) unknown_.push_back(w > 0 ? unknowns_++ : -1);
  }

  Field start, anchors, loads;
  std::vector<double> stiffness;
  // Of a sheet that begins in a plane and stays in it, however it is compressed: its normal.
  Vec3d normal{};

  [[nodiscard]] Field solve() const {
    Field x = start;
    double step = 1;
    for (int k = 0; k < 400 && step > 1e-14; ++k) step = improve(x, step < 1e-4);
    EXPECT_LT(step, 1e-12) << "the reference has not converged";
    return x;
  }

 private:
  [[nodiscard]] double objective(const Field& x) const {
    double sum = energy_.at(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += 0.5 * stiffness[i] * dot(x[i] - anchors[i], x[i] - anchors[i]) - dot(loads[i], x[i]);
    return sum;
  }

  // A Newton step with back-tracking; returns how far it went.
  double improve(Field& x, bool exact) const {
    Eigen::VectorXd gradient(3 * unknowns_);
    const Field elastic = energy_.gradient(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (unknown_[i] < 0) continue;
      const Vec3d g = elastic[i] + stiffness[i] * (x[i] - anchors[i]) - loads[i];
      gradient.segment<3>(3 * unknown_[i]) << g.x, g.y, g.z;
    }
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(hessian(x, exact));
    if (exact && !(factors.vectorD().minCoeff() > 0)) return improve(x, false);
    const Eigen::VectorXd step = factors.solve(-gradient);
    const double before = objective(x), slope = gradient.dot(step);
    const bool isRounding = step.cwiseAbs().maxCoeff() < 1e-7;
    double size = 1;
    Field moved;
    for (;; size *= 0.5) {
      moved = x;
      for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = unknown_[i]; u >= 0)
          moved[i] = moved[i] + size * Vec3d{step[3 * u], step[3 * u + 1], step[3 * u + 2]};
      if (isRounding || size < 1e-6 || objective(moved) <= before + 1e-4 * size * slope) break;
    }
    x = moved;
    return size * step.cwiseAbs().maxCoeff();
  }

  [[nodiscard]] Eigen::SparseMatrix<double> hessian(const Field& x, bool exact) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](std::size_t a, std::size_t b, const Eigen::Matrix3d& block) {
      if (unknown_[a] < 0 || unknown_[b] < 0) return;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          entries.emplace_back(3 * unknown_[a] + r, 3 * unknown_[b] + c, block(r, c));
    };
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d n(normal.x, normal.y, normal.z);
    const Eigen::Matrix3d held = 1e6 * n * n.transpose();
    for (std::size_t i = 0; i < x.size(); ++i) add(i, i, stiffness[i] * one + held);
    for (const auto& spring : energy_.springs()) {
      const Vec3d d = x[spring.b] - x[spring.a];
      const double l = length(d), over = l - spring.limit;
      const double whole = spring.stiffness + (over > 0 ? spring.limitStiffness : 0);
      const double tension =
          spring.stiffness * (l - spring.rest) + (over > 0 ? spring.limitStiffness * over : 0);
      const double across = exact ? tension / l : std::fmax(tension / l, 0);
      const Eigen::Vector3d along(d.x / l, d.y / l, d.z / l);
      const Eigen::Matrix3d k = across * one + (whole - across) * along * along.transpose();
      add(spring.a, spring.a, k);
      add(spring.b, spring.b, k);
      add(spring.a, spring.b, -k);
      add(spring.b, spring.a, -k);
    }
    for (const auto& line : energy_.bending()) {
      const std::pair<std::uint32_t, double> parts[] = {{line.first, 1}, {line.middle, -2}, {line.last, 1}};
      for (const auto& [a, p] : parts)
        for (const auto& [b, q] : parts) add(a, b, line.b * p * q * one);
    }
    Eigen::SparseMatrix<double> matrix(3 * unknowns_, 3 * unknowns_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  ElasticEnergy energy_;
  std::vector<int> unknown_;
  int unknowns_ = 0;
};

}  // namespace clothsim::test

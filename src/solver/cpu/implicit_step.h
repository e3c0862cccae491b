// An implicit step on the CPU (solver/implicit.h): from the state at the start of a step to the one before
// contacts.
#pragma once

#include <functional>
#include <vector>

#include "cloth/cloth.h"
#include "solver/cpu/implicit_passes.h"

namespace clothsim::cpu {

template <class Real>
class ImplicitStep {
 public:
  // The arguments of the explicit passes for a grid in this step.
  using ArgumentsOf = std::function<PassArguments<Real>(std::size_t grid)>;

  // `cloth` must outlive it.
  ImplicitStep(const Cloth& cloth, bool parallel);

  // `cutMasks`: makeCutMasks().
  void setCutMasks(const std::vector<std::uint32_t>& cutMasks) {
    own_.cutLinks = makeCutLinks(*cloth_, cutMasks, hierarchy_);
  }

  // Solves all grids at once.
  void run(const SolverSettings& settings, const ArgumentsOf& argumentsOf);

  // How far particles went in the last step before contacts [m].
  [[nodiscard]] const Components<Real>& ways() const { return own_.ways; }

 private:
  template <class Pass>
  void forEachRow(const std::vector<ImplicitArguments<Real>>& grids, Pass pass);
  template <class Pass>
  void forEachLevelRow(std::uint32_t columns, std::uint32_t rows, Pass pass);
  void gatherElasticForces(const std::vector<ImplicitArguments<Real>>& grids);
  void coarsen();
  void precondition(const Real* inverseMasses);
  [[nodiscard]] Real product(const Components<Real>& a, const Components<Real>& b);
  void iterate(const std::vector<ImplicitArguments<Real>>& grids, int iterations);
  void searchLine(const std::vector<ImplicitArguments<Real>>& grids);

  const Cloth* cloth_;
  bool parallel_;
  Hierarchy<Real> hierarchy_;
  ImplicitState<Real> own_;
  std::vector<Real> partials_;
  std::vector<ImplicitArguments<Real>> grids_;  // of this step; kept for its memory
};

}  // namespace clothsim::cpu

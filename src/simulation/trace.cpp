#include "simulation/trace.h"

#include <charconv>

#include "export/npz.h"
#include "measure/energies.h"
#include "solver/cpu/synchronized.h"

namespace clothsim {
namespace {

Vec3d momentumOf(const State& state) {
  Vec3d sum;
  for (std::size_t i = 0; i < state.positions.size(); ++i)
    if (const double inverseMass = state.positions[i].w; inverseMass > 0)
      sum = sum + (1 / inverseMass) * vectorOf(state.velocities[i]);
  return sum;
}

std::string shortestText(double number) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

}  // namespace

void Trace::add(const RunSummary& summary, Simulation& simulation) {
  const Cloth& cloth = simulation.cloth();
  const Scene& scene = simulation.scene();
  const State state = synchronized(cloth, scene, summary.state);
  const Energies energy = energies(cloth, cloth.springs(), scene, state.cuts, state);
  const Vec3d momentum = momentumOf(state), centroid = summary.measures.centroid;
  const ConvergenceCounts solved = summary.convergence - before_;
  before_ = summary.convergence;
  rows_.push_back({static_cast<double>(summary.frame),
                   simulation.time(),
                   energy.kinetic,
                   energy.gravity,
                   energy.springs,
                   energy.total(),
                   momentum.x,
                   momentum.y,
                   momentum.z,
                   summary.measures.maxStrain,
                   summary.measures.minY,
                   centroid.x,
                   centroid.y,
                   centroid.z,
                   summary.measures.maxPenetration,
                   summary.measures.seamGap,
                   static_cast<double>(summary.watch.contacts().contacts()),
                   static_cast<double>(solved.steps),
                   static_cast<double>(solved.unconvergedSteps),
                   static_cast<double>(solved.newtonSteps),
                   static_cast<double>(solved.iterations),
                   solved.lastUpdate});
}

std::string Trace::csv() const {
  std::string lines;
  for (std::size_t column = 0; column < columns.size(); ++column)
    lines += (column > 0 ? "," : "") + std::string(columns[column]);
  lines += '\n';
  for (const Row& row : rows_) {
    for (std::size_t column = 0; column < row.size(); ++column)
      lines += (column > 0 ? "," : "") + shortestText(row[column]);
    lines += '\n';
  }
  return lines;
}

std::string Trace::npz() const {
  std::vector<NamedArray> arrays;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    std::vector<double> numbers;
    for (const Row& row : rows_) numbers.push_back(row[column]);
    arrays.push_back(namedArray<double>(columns[column], {numbers.size()}, numbers));
  }
  return formatNpz(arrays);
}

}  // namespace clothsim

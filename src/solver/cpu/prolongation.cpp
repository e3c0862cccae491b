#include "solver/cpu/prolongation.h"

#include <algorithm>
#include <array>
#include <map>

namespace clothsim::cpu {
namespace {

constexpr auto AT_ONCE = static_cast<std::uint32_t>(SIXTEEN);

}  // namespace

template <class Real>
ProlongationBySixteen<Real> prolongationBySixteen(const Hierarchy<Real>& hierarchy) {
  using Weights = std::array<Real, SIXTEEN>;
  ProlongationBySixteen<Real> result;
  std::map<Weights, std::uint32_t> numbers;
  std::map<std::uint32_t, Weights> ofCoarse;
  for (std::uint32_t first = 0; first < hierarchy.particles; first += AT_ONCE) {
    result.starts.push_back(static_cast<std::uint32_t>(result.entries.size()));
    ofCoarse.clear();
    for (std::uint32_t i = first; i < std::min(hierarchy.particles, first + AT_ONCE); ++i)
      for (std::uint32_t n = hierarchy.prolongationStarts[i]; n < hierarchy.prolongationStarts[i + 1]; ++n)
        ofCoarse[hierarchy.prolongation[n].vertex][i - first] = hierarchy.prolongation[n].weight;
    for (const auto& [coarse, weights] : ofCoarse) {
      const auto number = static_cast<std::uint32_t>(result.weights.size());
      const auto [known, isNew] = numbers.try_emplace(weights, number);
      if (isNew) result.weights.push_back({weights});
      result.entries.push_back({coarse, known->second});
    }
  }
  result.starts.push_back(static_cast<std::uint32_t>(result.entries.size()));
  return result;
}

template ProlongationBySixteen<float> prolongationBySixteen(const Hierarchy<float>&);
template ProlongationBySixteen<double> prolongationBySixteen(const Hierarchy<double>&);

}  // namespace clothsim::cpu

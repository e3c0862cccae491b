#include "viewer/pace_advice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cloth/material.h"
#include "core/error.h"
#include "core/formatted.h"
#include "scene_io/scene_io.h"
#include "scene_io/solver_defaults.h"

namespace clothsim {
namespace {

constexpr double heldFrom = 0.9;        // of the wanted pace
constexpr double leastGain = 1.15;      // of what helps at all
constexpr double leastShare = 1.0 / 3;  // of the particles that are left
constexpr int leastSide = 33, sideSteps = 8;
constexpr int fewOnTheGpu = 40'000;  // particles, below which a processor may be faster
constexpr std::size_t mostRemedies = 3;
constexpr std::array tempos{1.0, 0.5, 0.25, 0.1};

const ClothSettings* onlyGrid(const Scene& scene) {
  return scene.cloths.size() == 1 && !scene.cloths[0].isMesh() ? &scene.cloths[0] : nullptr;
}

// On so many points that it would hold its pace, if the scene has one grid that may be made coarser.
std::optional<Scene> coarser(const Scene& scene, double pace) {
  const ClothSettings* cloth = onlyGrid(scene);
  if (cloth == nullptr) return std::nullopt;
  const double factor = std::sqrt(std::clamp(heldFrom * pace, leastShare, 1.0));
  const auto side = [&](int points) {
    const int wanted = static_cast<int>(std::ceil(factor * points / sideSteps)) * sideSteps;
    return std::min(points, std::max(wanted, leastSide));
  };
  const int columns = side(cloth->numWidthPoints), rows = side(cloth->numHeightPoints);
  if (columns == cloth->numWidthPoints && rows == cloth->numHeightPoints) return std::nullopt;
  try {
    Scene result = scene;
    static_cast<void>(changeResolution(result, columns, rows, false));
    return result;
  } catch (const Error&) {
    return std::nullopt;  // its pins would meet
  }
}

// In longer steps: the solver of an implicit step stands them, an explicit one would blow up.
std::optional<Scene> inFewerSteps(const Scene& scene, double pace) {
  const int steps = scene.solver.simulationSteps;
  if (!isImplicit(scene.solver.integrator) || steps < 2) return std::nullopt;
  Scene result = scene;
  result.solver.simulationSteps = std::clamp(static_cast<int>(heldFrom * pace * steps), 1, steps - 1);
  return result;
}

// As the key I does it: one long step costs as much as dozens of short ones.
std::optional<Scene> inImplicitSteps(const Scene& scene) {
  if (isImplicit(scene.solver.integrator)) return std::nullopt;
  Scene result = scene;
  setIntegrator(result, Integrator::implicit);
  result.solver.simulationSteps.automatic = true;
  chooseCounts(result);
  return result;
}

std::string gridText(const Scene& scene) {
  return std::to_string(scene.cloths[0].numWidthPoints) + " \u00d7 " +
         std::to_string(scene.cloths[0].numHeightPoints) + " particles";
}

std::string stepsText(const Scene& scene) {
  const int steps = scene.solver.simulationSteps;
  return std::to_string(steps) + (steps == 1 ? " step a frame" : " steps a frame");
}

double particlesOf(const Scene& scene) {
  double sum = 0;
  for (const ClothSettings& cloth : scene.cloths)
    sum += cloth.isMesh() ? 0 : double{1} * cloth.numWidthPoints * cloth.numHeightPoints;
  return sum;
}

}  // namespace

bool isSlow(const PaceFigures& figures) { return figures.pace < heldFrom; }

std::string causeOf(const PaceFigures& figures) {
  const bool draws = figures.drawing > figures.stepping;
  return (draws ? "Drawing" : "Stepping") +
         formatted(" takes %.0f %% of the time",
                   100 * std::min(1.0, draws ? figures.drawing : figures.stepping));
}

std::vector<PaceRemedy> remediesFor(const PaceFigures& figures, const Scene& scene, Quality quality,
                                    bool software, const std::string& backend) {
  std::vector<PaceRemedy> remedies;
  if (!isSlow(figures)) return remedies;
  const bool draws = figures.drawing > figures.stepping;
  if (draws && quality != Quality::draft) {
    const auto lower = static_cast<Quality>(static_cast<int>(quality) - 1);
    remedies.push_back({.name = std::string(nameOf(lower)) + " quality", .quality = lower});
  }
  if (!draws) {
    // A software renderer is the processor by a detour.
    if (backend == "gpu" && (software || particlesOf(scene) < fewOnTheGpu))
      remedies.push_back({.name = "Simulate on the CPU", .backend = "cpu"});
    if (backend == "cpu" && !software) remedies.push_back({.name = "Simulate on the GPU", .backend = "gpu"});
    const std::optional<Scene> smaller = coarser(scene, figures.pace),
                               longer = inFewerSteps(scene, figures.pace);
    if (smaller) remedies.push_back({.name = gridText(*smaller), .scene = smaller});
    if (const auto implicit = inImplicitSteps(scene))
      remedies.push_back({.name = "Implicit steps, " + stepsText(*implicit), .scene = implicit});
    if (longer) remedies.push_back({.name = stepsText(*longer), .scene = longer});
    if (smaller && longer)
      if (const auto both = inFewerSteps(*smaller, figures.pace * particlesOf(scene) / particlesOf(*smaller)))
        remedies.push_back({.name = gridText(*both) + ", " + stepsText(*both), .scene = both});
  }
  const double now = figures.pace * figures.tempo;  // as it runs anyway, and evenly
  for (const double tempo : tempos)
    if (tempo < figures.tempo && heldFrom * tempo <= now) {
      remedies.push_back({.name = formatted("Slow motion %g\u00d7", tempo), .tempo = tempo, .pace = tempo});
      break;
    }
  return remedies;
}

std::vector<PaceRemedy> bestOf(std::vector<PaceRemedy> tried, const PaceFigures& figures) {
  const double now = figures.pace * figures.tempo;
  std::erase_if(tried, [&](const PaceRemedy& remedy) {
    return !remedy.tempo && remedy.pace && *remedy.pace < leastGain * now;
  });
  const auto holds = [&](const PaceRemedy& remedy) {
    return remedy.tempo || !remedy.pace || *remedy.pace >= heldFrom * figures.tempo;
  };
  const auto others = std::ranges::stable_partition(tried, holds);
  std::ranges::stable_sort(others,
                           [](const PaceRemedy& a, const PaceRemedy& b) { return *a.pace > *b.pace; });
  // Slow motion changes nothing of the scene and stays the last resort.
  std::ranges::stable_partition(tried, [](const PaceRemedy& remedy) { return !remedy.tempo; });
  while (tried.size() > mostRemedies) tried.erase(tried.end() - (tried.back().tempo ? 2 : 1));
  return tried;
}

double nextTempo(double tempo) {
  const auto* const next =
      std::find_if(tempos.begin(), tempos.end(), [&](double each) { return each < tempo; });
  return next == tempos.end() ? tempos.front() : *next;
}

}  // namespace clothsim

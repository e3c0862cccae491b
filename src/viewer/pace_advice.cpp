#include "viewer/pace_advice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/formatted.h"
#include "scene_io/scene_io.h"

namespace clothsim {
namespace {

constexpr double heldFrom = 0.9;  // of the wanted pace
constexpr int smallestSide = 16, grain = 8;

// The scene on so many points that it would hold its pace, if it has one grid that can be made coarser.
std::optional<Scene> coarser(const Scene& scene, double pace) {
  if (scene.cloths.size() != 1 || scene.cloths[0].isMesh()) return std::nullopt;
  const ClothSettings& cloth = scene.cloths[0];
  const double factor = std::sqrt(0.9 * pace);
  const auto side = [&](int points) {
    const int wanted = static_cast<int>(factor * points) / grain * grain;
    return std::min(points, std::max(wanted, smallestSide));
  };
  const int columns = side(cloth.numWidthPoints), rows = side(cloth.numHeightPoints);
  if (columns == cloth.numWidthPoints && rows == cloth.numHeightPoints) return std::nullopt;
  try {
    Scene result = scene;
    static_cast<void>(changeResolution(result, columns, rows, false));
    return result;
  } catch (const Error&) {
    return std::nullopt;  // its pins would meet
  }
}

std::string share(const char* what, double part) {
  return std::string(what) + formatted(" takes %.0f %% of the time", 100 * std::min(1.0, part));
}

}  // namespace

std::optional<PaceAdvice> adviceFor(const PaceFigures& figures, const Scene& scene, Quality quality,
                                    bool software, const std::string& backend) {
  if (figures.pace >= heldFrom) return std::nullopt;
  if (figures.drawing > figures.stepping) {
    if (quality == Quality::draft) return std::nullopt;
    const auto lower = static_cast<Quality>(static_cast<int>(quality) - 1);
    return PaceAdvice{share("Drawing", figures.drawing), std::string(nameOf(lower)) + " quality", lower,
                      std::nullopt, std::nullopt};
  }
  const std::string cause = share("Stepping", figures.stepping);
  if (software && backend == "gpu")  // which is the processor by a detour
    return PaceAdvice{cause, "Simulate on the CPU", std::nullopt, std::nullopt, "cpu"};
  if (const std::optional<Scene> other = coarser(scene, figures.pace)) {
    const ClothSettings& cloth = other->cloths[0];
    return PaceAdvice{cause,
                      std::to_string(cloth.numWidthPoints) + " \u00d7 " +
                          std::to_string(cloth.numHeightPoints) + " particles",
                      std::nullopt, other, std::nullopt};
  }
  // The solver of an implicit step stands longer ones; an explicit one would blow up.
  const int steps = scene.solver.simulationSteps;
  if (isImplicit(scene.solver.integrator) && steps > 1) {
    Scene fewer = scene;
    fewer.solver.simulationSteps = std::max(1, steps / 2);
    return PaceAdvice{cause,
                      std::to_string(static_cast<int>(fewer.solver.simulationSteps)) + " steps a frame",
                      std::nullopt, fewer, std::nullopt};
  }
  return std::nullopt;
}

double nextTempo(double tempo) {
  constexpr std::array tempos{1.0, 0.5, 0.25, 0.1};
  const auto* const next =
      std::find_if(tempos.begin(), tempos.end(), [&](double each) { return each < tempo; });
  return next == tempos.end() ? tempos.front() : *next;
}

}  // namespace clothsim

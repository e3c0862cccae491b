#include "simulation/compare.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "simulation/simulation.h"

namespace clothsim {
namespace {

void compareFloat(float a, float b, StateDifference& result) {
  ++result.floats;
  result.finite = result.finite && std::isfinite(a) && std::isfinite(b);
  if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b)) return;
  ++result.differing;
  result.maxAbs = std::max(result.maxAbs, std::abs(static_cast<double>(a) - static_cast<double>(b)));
}

// Repeats the frame on both backends step by step, from the last state that was equal.
std::uint64_t firstDifferingStep(Simulation& cpu, Simulation& gpu, const State& equal) {
  cpu.solver().setState(equal);
  gpu.solver().setState(equal);
  for (int step = 1; step < cpu.scene().solver.simulationSteps; ++step) {
    cpu.solver().step(1);
    gpu.solver().step(1);
    if (difference(cpu.solver().state(), gpu.solver().state()).differing > 0) break;
  }
  return std::max(cpu.solver().stepIndex(), equal.clock.step + 1);
}

}  // namespace

StateDifference difference(const State& a, const State& b) {
  StateDifference result;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    const Particle4 &xa = a.positions[i], &xb = b.positions[i], &va = a.velocities[i], &vb = b.velocities[i];
    compareFloat(xa.x, xb.x, result);
    compareFloat(xa.y, xb.y, result);
    compareFloat(xa.z, xb.z, result);
    compareFloat(va.x, vb.x, result);
    compareFloat(va.y, vb.y, result);
    compareFloat(va.z, vb.z, result);
  }
  return result;
}

Comparison compareBackends(const Shared<Scene>& scene, int frames, SolverFactory makeSolver,
                           const std::function<void(int, const State&)>& atFrame) {
  Simulation cpu(scene, "cpu", makeSolver), gpu(scene, "gpu", makeSolver);
  Comparison result;
  result.device = gpu.solver().device();
  State cpuState = cpu.solver().state(), gpuState = gpu.solver().state();
  StateDifference now = difference(cpuState, gpuState);
  if (atFrame) atFrame(0, cpuState);
  while (result.frames < frames && now.differing == 0 && now.finite) {
    const State equal = std::move(cpuState);
    gpu.stepFrame();
    cpu.stepFrame();
    result.cpuDivergence = cpu.checkFrame();
    result.gpuDivergence = gpu.checkFrame();
    cpuState = cpu.solver().state();
    gpuState = gpu.solver().state();
    if (result.cpuDivergence || result.gpuDivergence) {
      now.finite = false;
      break;
    }
    now = difference(cpuState, gpuState);
    if (now.differing > 0) result.firstDifferingStep = firstDifferingStep(cpu, gpu, equal);
    ++result.frames;
    if (atFrame) atFrame(result.frames, cpuState);
  }
  result.steps = cpuState.clock.step;
  result.contacts = cpu.solver().contactCounts();
  result.floats = now.floats;
  result.differingFloats = now.differing;
  result.maxAbsDifference = now.maxAbs;
  result.finite = now.finite;
  result.cpuHash = hashText(stateHash(cpuState));
  result.gpuHash = hashText(stateHash(gpuState));
  return result;
}

}  // namespace clothsim

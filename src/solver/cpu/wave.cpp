#include "solver/cpu/wave.h"

#include <cstdlib>

#include "cloth/cloth.h"

namespace clothsim::cpu {
namespace {

// What lies by rows: an entry belongs to the row of its particle. Others may be sums over all particles.
constexpr Arrays byRows{Array::positions, Array::velocities, Array::newPositions, Array::newVelocities,
                        Array::forces};

bool isOfRows(const PassTraits& pass) {
  constexpr Arrays known = byRows | Arrays{Array::watch};
  const bool runsByRows = pass.domain == Domain::gridPoints || pass.domain == Domain::springs;
  return runsByRows && pass.gate == Gate::none && (pass.gathers | pass.reads | pass.writes | known) == known;
}

// The rows, relative to its own, at which a pass touches an array.
struct Rows {
  int first = 0, last = 0;
};

Rows rowsOf(const WavePass& pass, Array array) {
  const PassTraits& traits = pass.call.traits();
  if (!traits.gathers.contains(array)) return {};
  // A spring moves its owner, in the row of the pass, and its other end.
  if (pass.color != nullptr) return {springOffsets[pass.color->slot].rows, 0};
  return {-traits.reach, traits.reach};
}

// So that `later` comes to what `earlier` writes, and overwrites what that reads, only afterwards.
void follow(const WavePass& earlier, WavePass& later) {
  const PassTraits &before = earlier.call.traits(), &after = later.call.traits();
  for (int i = 0; i < ARRAY_COUNT; ++i) {
    const auto array = static_cast<Array>(i);
    const bool isShared = before.writes.contains(array) || after.writes.contains(array);
    const bool isTouchedBefore = (before.gathers | before.reads | before.writes).contains(array);
    const bool isTouchedAfter = (after.gathers | after.reads | after.writes).contains(array);
    if (!isShared || !isTouchedBefore || !isTouchedAfter) continue;
    const Rows first = rowsOf(earlier, array), second = rowsOf(later, array);
    later.behind = std::max(later.behind, earlier.behind + second.last - first.first);
    later.inside = std::max(later.inside, earlier.inside + first.last - second.first);
  }
}

}  // namespace

std::size_t waveLength(std::span<const PassCall> passes) {
  const auto ownRows = sweepLength(passes);
  std::size_t count = 0;
  while (count < passes.size() && isOfRows(passes[count].traits())) ++count;
  return std::max(ownRows, count);
}

Wave makeWave(std::span<const PassCall> passes, std::span<const LimitColor> colors) {
  Wave wave;
  for (const PassCall& call : passes) {
    WavePass pass{call, nullptr, 0, 0};
    if (call.traits().domain == Domain::springs) {
      if (call.index >= colors.size()) continue;
      pass.color = &colors[call.index];
    }
    for (const WavePass& earlier : wave.passes) follow(earlier, pass);
    wave.behind = std::max(wave.behind, pass.behind);
    wave.inside = std::max(wave.inside, pass.inside);
    wave.passes.push_back(pass);
  }
  return wave;
}

}  // namespace clothsim::cpu

// The order of a step, written once: which passes it is made of, for a scene. Both backends execute the list.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/cuts.h"
#include "scene/scene.h"
#include "solver/pass.h"

namespace clothsim {

// A pass of a list. It runs over all cloths.
struct PassCall {
  Pass pass;
  // limit: the colour; findCenters, coarsen, restrict, prolong: the level, 0 the finest; buildHash:
  // HASHES_START or HASHES_END; guard and pressOut: the round; findTouching: 0 at the start, 1 in later
  // rounds.
  std::uint16_t index = 0;

  [[nodiscard]] const PassTraits& traits() const { return traitsOf(pass); }
  friend bool operator==(const PassCall&, const PassCall&) = default;
};
inline constexpr std::uint16_t HASHES_START = 0, HASHES_END = 1;  // positions at the start or end of the step

// Which of the new arrays are the state once a list is done.
enum class Outcome : std::uint8_t { nothing, velocities, state };

struct PassList {
  // Passes that are done several times: `times` times `count` passes from `first` on. Loops may contain
  // others; the outer one comes first.
  struct Loop {
    std::string name;
    std::size_t first = 0, count = 0, times = 0;
  };

  std::vector<PassCall> passes;  // in order, loops unrolled
  std::vector<Loop> loops;       // for people
  Outcome outcome = Outcome::nothing;
  // Of each pass, the first one behind it with a gate that closes later: where a pass does nothing since its
  // gate is closed, so do all before that one. A step may take thousands of passes and need a few.
  std::vector<std::uint32_t> gateEnds;
  // Behind the rounds of contact: where the first `settle` finds nothing to go on with, they do nothing.
  std::uint32_t settledEnd = 0;
  std::bitset<PASS_COUNT> kinds;  // of passes in it
  void findGateEnds();            // finds all three; to be called once the passes stand

  [[nodiscard]] bool contains(Pass pass) const { return kinds.test(static_cast<std::size_t>(pass)); }
};

// How many coarser levels the finest of the cloths has for implicit steps.
[[nodiscard]] std::size_t mostLevels(const Cloth& cloth, const Cuts& cuts);
// A step of the scene. Of explicit steps, `levels` does not matter.
[[nodiscard]] PassList makeStep(const Scene& scene, const Cloth& cloth, std::size_t levels);
// The same step with the matrices of the preconditioner's levels that the step before has made.
[[nodiscard]] PassList keepingLevels(PassList step);
[[nodiscard]] PassList listOf(std::initializer_list<Pass> passes, Outcome outcome);
// Turns the velocities into those of the scene's integrator.
[[nodiscard]] PassList makeConversion();
// Looks at a state that was handed in.
[[nodiscard]] PassList makeStartCheck();

// How many of the passes, from the first on, may share a sweep: an executor may take a row through all of
// them before the next row.
[[nodiscard]] std::size_t sweepLength(std::span<const PassCall> passes);

// The names of passes that are done in one go: "forces, integrate"; one that runs over levels once.
[[nodiscard]] std::string nameOf(std::span<const PassCall> passes);

// The list for people, a line a pass, with what it runs over, its reach, what it reads and writes, and the
// features of the scene that it depends on; loops once, with how often they run.
[[nodiscard]] std::string describe(const PassList& list);

}  // namespace clothsim

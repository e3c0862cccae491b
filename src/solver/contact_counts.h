// What contact of cloth with itself has come to.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clothsim {

// Since the solver was made.
struct ContactCounts {
  std::uint64_t hashBuilds = 0;
  std::uint64_t clampedSteps = 0;  // in which motion had to be cut short
  std::uint64_t fastSteps = 0;     // in which some particle moved farther than the search reaches
  // Of the surface (solver/surface.h):
  std::uint64_t pairs = 0;         // most pairs of parts that may touch, in a step
  std::uint64_t shortened = 0;     // motions of particles that were cut short, of all steps
  std::uint64_t crowdedSteps = 0;  // in which there were too many pairs, so that none pushed
  double leastGap = INFINITY;      // between parts that may touch [m]
  double pinLag = 0;               // how far a pin was kept from its path at the end of a step, at most [m]
  double largestCorrection = 0;  // of parts that were too near [m]: colliders do not know of it in that step
  std::uint64_t passages = 0;    // of triangles by small colliders, which went through them
  std::uint64_t passageSteps = 0;  // in which there were some

  friend ContactCounts operator+(const ContactCounts& a, const ContactCounts& b) {
    return {a.hashBuilds + b.hashBuilds,
            a.clampedSteps + b.clampedSteps,
            a.fastSteps + b.fastSteps,
            std::max(a.pairs, b.pairs),
            a.shortened + b.shortened,
            a.crowdedSteps + b.crowdedSteps,
            std::min(a.leastGap, b.leastGap),
            std::max(a.pinLag, b.pinLag),
            std::max(a.largestCorrection, b.largestCorrection),
            a.passages + b.passages,
            a.passageSteps + b.passageSteps};
  }
};

}  // namespace clothsim

// The watchdog (solver/divergence.h) in the passes of the CPU backend. Loops along a row only gather the
// largest bits of a sum of squares; which particle it was is looked up once something is wrong.
#pragma once

#include <atomic>
#include <limits>

#include "core/exact_math.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

inline void noteDivergence(WatchRow& watch, std::uint32_t pass, std::ptrdiff_t particle,
                           std::uint32_t reason) {
  const std::uint32_t code = static_cast<std::uint32_t>(particle) * 4 + reason;
  const std::atomic_ref<std::uint32_t> entry(watch[pass]);
  std::uint32_t before = entry.load(std::memory_order_relaxed);
  while (code < before && !entry.compare_exchange_weak(before, code, std::memory_order_relaxed)) {
  }
}

// By bits without the sign: -0 is finite, too.
template <class Real>
bool finite(Real x) {
  const auto bits = bitsOf(x);
  const auto magnitude = bits & ~bitsOf(Real(-0.0));
  return magnitude <= bitsOf(std::numeric_limits<Real>::max());
}

// For what a pass stored as a particle's velocity.
template <class Real>
[[gnu::noinline, gnu::cold]] void watchVelocity(const PassArguments<Real>& arguments, std::uint32_t pass,
                                                std::ptrdiff_t i) {
  const Components<Real>& v = arguments.after.velocities;
  const Real speedSquared =
      dot(load(v.x.data(), v.y.data(), v.z.data(), i), load(v.x.data(), v.y.data(), v.z.data(), i));
  if (isBeyond(speedSquared, arguments.step.maxSpeedSquared))
    noteDivergence(arguments.watch, pass, i, finite(speedSquared) ? REASON_RUNAWAY_SPEED : REASON_NON_FINITE);
}

// For what a pass stored as velocities of a row. They answer for the positions, too: those move along, by h v
// or by h times the change.
template <class Real>
INLINE void watchVelocities(const PassArguments<Real>& arguments, std::uint32_t pass, int row) {
  const Components<Real>& v = arguments.after.velocities;
  const Real *vx = v.x.data(), *vy = v.y.data(), *vz = v.z.data();
  const Range particles = rangeOf(arguments.step, row);
  auto largest = bitsOf(Real(0));
#pragma GCC ivdep
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> velocity = load(vx, vy, vz, i);
    largest = larger(largest, bitsOf(dot(velocity, velocity)));
  }
  if (largest <= bitsOf(arguments.step.maxSpeedSquared)) return;
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) watchVelocity(arguments, pass, i);
}

}  // namespace clothsim::cpu

// The incident springs of a row of particles, in stretches that share a kind and a stiffness.
#pragma once

#include "cloth/cloth.h"
#include "solver/cpu/passes.h"
#include "solver/cpu/rows.h"

namespace clothsim::cpu {

// Which of its incident springs a pass works on, for the particles of a stretch.
struct SpringPlace {
  std::uint32_t bit;     // in incidentSprings
  std::ptrdiff_t other;  // from a particle to the other end
};

// Rest lengths of a slot: the nominal one for all, or from the table.
template <class Real>
struct NominalLength {
  Real length;
  Real operator[](std::ptrdiff_t) const { return length; }
};

// Where the second spring of `implicit` begins.
template <class Real>
INLINE Real limitLength(NominalLength<Real>, std::ptrdiff_t, Real, Real nominal) {
  return nominal;
}
template <class Real>
INLINE Real limitLength(const Real* rest, std::ptrdiff_t i, Real limitFactor, Real) {
  return limitFactor * rest[i];
}

// Whether the row, or column, is a border of the grid.
INLINE bool isBorder(std::int64_t place, std::uint32_t count) { return place == 0 || place + 1 == count; }

template <class Real, class Visit>
INLINE void visitRange(const PassArguments<Real>& arguments, Range particles, std::uint32_t k, Real stiffness,
                       Visit visit) {
  const StepParams<Real>& step = arguments.step;
  const IncidentSpring& incident = incidentSprings[k];
  const SpringPlace place{k, indexOffset(step, incident.columns, incident.rows)};
  SpringParams<Real> spring = step.springs[incident.slot];
  spring.stiffness = stiffness;
  if (step.useRestLengthTable != 0) {
    const Real* rest = arguments.restLengths + static_cast<std::size_t>(incident.slot) * step.totalParticles +
                       (incident.owned ? 0 : place.other);
    visit(particles, place, spring, rest);
  } else {
    visit(particles, place, spring, NominalLength<Real>{spring.restLength});
  }
}

// Calls visit(particles, place, spring, rest) for a row's incident springs of number k: `spring` has the
// stiffness of all in the stretch, `rest[i]` is the rest length of particle i's. A material's springs along a
// border count half: the whole row, or its first and last particle. Returns whether there are any.
template <class Real, class Visit>
INLINE bool forEachStretch(const PassArguments<Real>& arguments, int row, std::uint32_t k, Visit visit) {
  const StepParams<Real>& step = arguments.step;
  const IncidentSpring& incident = incidentSprings[k];
  const int otherRow = row + incident.rows, rows = static_cast<int>(step.rows);
  const bool enabled = (step.enabledSlots >> incident.slot & 1u) != 0;
  if (!enabled || row >= rows || otherRow < 0 || otherRow >= rows) return false;
  const bool halvesRow = step.hasMaterial != 0 && incident.slot == toLeft && isBorder(row, step.rows),
             halvesEnds = step.hasMaterial != 0 && incident.slot == toUpper;
  const Real inside = step.springs[incident.slot].stiffness, halved = Real(0.5) * inside;
  forEachPart(
      rangeOf(step, row, incident.columns, incident.columns),
      halvesEnds, [&](Range particles, bool isEnd) __attribute__((always_inline)) {
        visitRange(arguments, particles, k, isEnd || halvesRow ? halved : inside, visit);
      });
  return true;
}

// The same for all incident springs of a row, in ascending number.
template <class Real, class Visit>
INLINE void forEachSpringRange(const PassArguments<Real>& arguments, int row, Visit visit) {
  for (std::uint32_t k = 0; k < incidentSprings.size(); ++k) forEachStretch(arguments, row, k, visit);
}

}  // namespace clothsim::cpu

#include "solver/cpu/passes.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "core/exact_math.h"
#include "solver/cpu/arrays.h"
#include "solver/cpu/collider_frames.h"
#include "solver/cpu/rows.h"
#include "solver/cpu/spring_rows.h"
#include "solver/cpu/watch.h"

namespace clothsim::cpu {
namespace {

// canonical(x) where the mask is all ones, 0 where it is 0. By bits: with conditions the compiler stores each
// number up to three times, under masks.
template <class Real>
INLINE auto canonicalBits(Real x, decltype(bitsOf(Real(0))) mask) {
  using Bits = decltype(mask);
  if constexpr (sizeof(Real) == sizeof(double)) return bitsOf(x) & mask;
  const bool isSmall = (bitsOf(x) & ~bitsOf(Real(-0.0))) < bitsOf(static_cast<Real>(0x1p-40));
  return bitsOf(x) & mask & (isSmall ? Bits(0) : ~Bits(0));
}

// One component of x' = x + h v', v' = (1 - damping) v + h (g + w f); `isFree` is all ones, or 0 of a
// particle that is pinned and rests, unless movePinsOf() follows. Returns v'.
template <class Real>
INLINE Real integrateComponent(const StepParams<Real>& step, Real gravity, Real inverseMass, Real force,
                               Real position, Real velocity, decltype(bitsOf(Real(0))) isFree,
                               Real& newPosition, Real& newVelocity) {
  const Real acceleration = gravity + inverseMass * force;
  const Real v = step.velocityKept * velocity + step.timeStep * acceleration;
  const Real x = position + step.timeStep * v;
  const Real kept = std::bit_cast<Real>(canonicalBits(v, isFree));
  newVelocity = kept;
  newPosition = std::bit_cast<Real>(canonicalBits(x, isFree) | (bitsOf(position) & ~isFree));
  return kept;
}
// Of some particles of a row. Returns the largest bits of a new velocity's square.
template <class Real>
INLINE auto integrateParticles(const PassArguments<Real>& arguments, Range particles) {
  using Bits = decltype(bitsOf(Real(0)));
  const StepParams<Real> step = arguments.step;  // which no store to a particle changes
  const Arrays<const Real> x = arraysOf(arguments.before.positions),
                           v = arraysOf(arguments.before.velocities),
                           f = arraysOf(std::as_const(arguments.forces));
  const Arrays<Real> newX = arraysOf(arguments.after.positions), newV = arraysOf(arguments.after.velocities);
  const Real* inverseMasses = arguments.inverseMasses;
  Bits fastest[SIXTEEN]{};  // of every sixteenth
  forEachSixteen(
      particles, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const Real w = inverseMasses[i];
          const Bits isFree = w == Real(0) ? Bits(0) : ~Bits(0);
          const Real vx = integrateComponent(step, step.gravityX, w, f.x[i], x.x[i], v.x[i], isFree,
                                             newX.x[i], newV.x[i]);
          const Real vy = integrateComponent(step, step.gravityY, w, f.y[i], x.y[i], v.y[i], isFree,
                                             newX.y[i], newV.y[i]);
          const Real vz = integrateComponent(step, step.gravityZ, w, f.z[i], x.z[i], v.z[i], isFree,
                                             newX.z[i], newV.z[i]);
          fastest[i - begin] = larger(fastest[i - begin], bitsOf((vx * vx + vy * vy) + vz * vz));
        }
      });
  return largestOf(fastest);
}

// What an interaction does to the particles of the row that it holds, after integrateParticles()
// (solver/interaction.h).
template <class Real>
void pullGrabbed(const PassArguments<Real>& arguments, int row) {
  const InteractionParams<Real>& interaction = arguments.interaction;
  const bool isMesh = arguments.step.isMesh != 0;  // whose block is a part of its one row
  const std::uint32_t blockRow = isMesh ? 0 : static_cast<std::uint32_t>(row) - interaction.firstRow;
  if (blockRow >= interaction.rows) return;
  const Range particles = rangeOf(arguments.step, row);
  const std::ptrdiff_t first =
      (isMesh ? static_cast<std::ptrdiff_t>(arguments.step.firstParticle) : particles.begin) +
      interaction.firstColumn;
  const Components<Real>& old = arguments.before.positions;
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  for (std::uint32_t k = 0; k < interaction.columns; ++k) {
    const std::ptrdiff_t i = first + k;
    if (i < particles.begin || i >= particles.end) continue;
    if (arguments.inverseMasses[i] == Real(0)) continue;
    const GrabSpring::Point& point = arguments.grabbed[blockRow * interaction.columns + k];
    const Vec3<Real> own{v.x[i], v.y[i], v.z[i]}, x{old.x[i], old.y[i], old.z[i]};
    const Vec3<Real> goal =
        Vec3<Real>{interaction.goalX, interaction.goalY, interaction.goalZ} + point.offset.cast<Real>();
    const Vec3<Real> towards = goal - x;
    Vec3<Real> pulled = (interaction.velocityKept * own + interaction.pull * towards) +
                        Vec3<Real>{interaction.pushX, interaction.pushY, interaction.pushZ};
    const Real speedSquared = dot(pulled, pulled);
    const Real slower = interaction.largestSpeed * inverseSquareRoot(speedSquared);
    if (interaction.largestSpeedSquared < speedSquared) pulled = slower * pulled;
    const Vec3<Real> newV = own + static_cast<Real>(point.weight) * (pulled - own);
    const Vec3<Real> newX = x + arguments.step.timeStep * newV;
    p.x[i] = canonical(newX.x);
    p.y[i] = canonical(newX.y);
    p.z[i] = canonical(newX.z);
    v.x[i] = canonical(newV.x);
    v.y[i] = canonical(newV.y);
    v.z[i] = canonical(newV.z);
  }
}

// Of a pin that is held for a while (solver/pin_paths.h).
template <class Real>
Vec3<Real> nearer(Vec3<Real> x, Vec3<Real> goal, const PinMotionParams<Real>& motion) {
  Vec3<Real> way = motion.follow * (goal - x);
  const Real waySquared = dot(way, way);
  const Real part = motion.reach * inverseSquareRoot(waySquared);
  if (waySquared > motion.reachSquared) way = part * way;
  const Vec3<Real> sum = x + way;
  return {canonical(sum.x), canonical(sum.y), canonical(sum.z)};
}

// Where their paths take the pins from their start positions, or nearer to there, at the velocity that leads
// there.
template <class Real>
void movePinsOf(const PassArguments<Real>& arguments, Range particles) {
  const Components<Real>&s = arguments.pinStarts, &old = arguments.before.positions;
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const std::uint32_t number = arguments.pinPathNumbers[i];
    if (number == 0 || arguments.inverseMasses[i] != Real(0)) continue;
    const PinMotionParams<Real>& motion = arguments.pinMotions[number - 1];
    const Vec3<Real> sum = carried(motion, Vec3<Real>{s.x[i], s.y[i], s.z[i]});
    const Vec3<Real> place{canonical(sum.x), canonical(sum.y), canonical(sum.z)};
    cpu::put(p, i, motion.follow == Real(0) ? place : nearer({old.x[i], old.y[i], old.z[i]}, place, motion));
    const Real inverseTimeStep = arguments.step.inverseTimeStep;
    v.x[i] = canonical(inverseTimeStep * (p.x[i] - old.x[i]));
    v.y[i] = canonical(inverseTimeStep * (p.y[i] - old.y[i]));
    v.z[i] = canonical(inverseTimeStep * (p.z[i] - old.z[i]));
  }
}

template <class Real>
INLINE void integrateRow(const PassArguments<Real>& arguments, int row) {
  const Range particles = rangeOf(arguments.step, row);
  const auto fastest = integrateParticles(arguments, particles);
  if (arguments.grabbed != nullptr) pullGrabbed(arguments, row);
  if (arguments.pinPathNumbers != nullptr) movePinsOf(arguments, particles);
  const bool moreMoved = arguments.grabbed != nullptr || arguments.pinPathNumbers != nullptr;
  if (moreMoved || fastest > bitsOf(arguments.step.maxSpeedSquared))
    watchVelocities(arguments, PASS_INTEGRATE, row);
}

template <class Real>
INLINE void kickComponent(const StepParams<Real>& step, Range particles, Real gravity,
                          const Real* inverseMass, const Real* force, const Real* velocity,
                          Real* newVelocity) {
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Real acceleration = gravity + inverseMass[i] * force[i];
    const Real v = velocity[i] + step.kickTime * acceleration;
    newVelocity[i] = inverseMass[i] == Real(0) ? velocity[i] : canonical(v);
  }
}

// The spring from `a`, its owner, to `b`: when longer than the limit, both ends move half of the excess
// towards each other, or the free end all of it.
template <class Real>
INLINE void limitSpring(const PassArguments<Real>& arguments, std::ptrdiff_t a, std::ptrdiff_t b,
                        Real limit) {
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  const Vec3<Real> xa{p.x[a], p.y[a], p.z[a]}, xb{p.x[b], p.y[b], p.z[b]};
  const Vec3<Real> d = xb - xa;
  const Real lengthSquared = dot(d, d);
  const Real limitSquared = limit * limit;
  const bool freeA = arguments.inverseMasses[a] > Real(0), freeB = arguments.inverseMasses[b] > Real(0);
  if (!(limitSquared < lengthSquared) || !(freeA || freeB)) return;
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real length = lengthSquared * inverseLength;
  const Real excess = (length - limit) * inverseLength;
  const Real share = freeA && freeB ? Real(0.5) * excess : excess;
  const Vec3<Real> move = share * d;
  const Vec3<Real> kick = arguments.step.inverseTimeStep * move;
  if (freeA) {
    p.x[a] = canonical(xa.x + move.x);
    p.y[a] = canonical(xa.y + move.y);
    p.z[a] = canonical(xa.z + move.z);
    v.x[a] = canonical(v.x[a] + kick.x);
    v.y[a] = canonical(v.y[a] + kick.y);
    v.z[a] = canonical(v.z[a] + kick.z);
  }
  if (freeB) {
    p.x[b] = canonical(xb.x - move.x);
    p.y[b] = canonical(xb.y - move.y);
    p.z[b] = canonical(xb.z - move.z);
    v.x[b] = canonical(v.x[b] - kick.x);
    v.y[b] = canonical(v.y[b] - kick.y);
    v.z[b] = canonical(v.z[b] - kick.z);
  }
}

template <class Real>
struct SpringEnd {
  Real *x, *v;
};
// What limitSpring() does to one component of one end, or nothing where the mask is 0.
template <class Real, class Bits>
INLINE void moveEnd(const SpringEnd<Real>& end, std::ptrdiff_t i, Real move, Real kick, Bits mask) {
  const Real x = end.x[i], v = end.v[i];
  end.x[i] = std::bit_cast<Real>(canonicalBits(x + move, mask) | (bitsOf(x) & ~mask));
  end.v[i] = std::bit_cast<Real>(canonicalBits(v + kick, mask) | (bitsOf(v) & ~mask));
}

// limitSpring() for those of sixteen owners side by side that `isOwner` tells, in vectors: first all moves
// are worked out, then the ends move. Springs of a colour share no end. a + -b rounds as a - b does.
template <bool hasCuts, class Real, class RestLengths, class IsOwner>
INLINE void limitSixteen(const PassArguments<Real>& arguments, std::uint32_t slot, std::ptrdiff_t first,
                         std::ptrdiff_t other, RestLengths rest, Real nominal, IsOwner isOwner) {
  using Bits = decltype(bitsOf(Real(0)));
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  const SpringEnd<Real> x{p.x.data(), v.x.data()}, y{p.y.data(), v.y.data()}, z{p.z.data(), v.z.data()};
  const Real factor = arguments.step.limitFactor, inverseTimeStep = arguments.step.inverseTimeStep;
  const Real* inverseMasses = arguments.inverseMasses;
  const std::uint32_t* cutMasks = arguments.cutMasks;
  Real moveX[SIXTEEN], moveY[SIXTEEN], moveZ[SIXTEEN];
  Bits actsOnA[SIXTEEN], actsOnB[SIXTEEN];
#pragma GCC ivdep
  for (int lane = 0; lane < SIXTEEN; ++lane) {
    const std::ptrdiff_t a = first + lane, b = a + other;
    const Vec3<Real> d = load(x.x, y.x, z.x, b) - load(x.x, y.x, z.x, a);
    const Real lengthSquared = dot(d, d);
    const Real limit = limitLength(rest, a, factor, nominal);
    const bool isTooLong =
        isOwner(lane) & (limit * limit < lengthSquared) & !isCutAt<hasCuts>(cutMasks, a, slot);
    const Bits freeA = inverseMasses[a] > Real(0) ? ~Bits(0) : Bits(0);
    const Bits freeB = inverseMasses[b] > Real(0) ? ~Bits(0) : Bits(0);
    const Bits acts = isTooLong ? ~Bits(0) : Bits(0);
    const Real inverseLength = inverseSquareRoot(lengthSquared);
    const Real length = lengthSquared * inverseLength;
    const Real excess = (length - limit) * inverseLength;
    const Real share = (freeA & freeB) != 0 ? Real(0.5) * excess : excess;
    moveX[lane] = share * d.x;
    moveY[lane] = share * d.y;
    moveZ[lane] = share * d.z;
    actsOnA[lane] = acts & freeA;
    actsOnB[lane] = acts & freeB;
  }
  const auto moveEnds = [&](const SpringEnd<Real>& end, const Real* moves) __attribute__((always_inline)) {
#pragma GCC ivdep
    for (int lane = 0; lane < SIXTEEN; ++lane)
      moveEnd(end, first + lane, moves[lane], inverseTimeStep * moves[lane], actsOnA[lane]);
#pragma GCC ivdep
    for (int lane = 0; lane < SIXTEEN; ++lane)
      moveEnd(end, first + lane + other, -moves[lane], -(inverseTimeStep * moves[lane]), actsOnB[lane]);
  };
  moveEnds(x, moveX);
  moveEnds(y, moveY);
  moveEnds(z, moveZ);
}

// Of a mesh: the springs of the colour from number `first` on, MESH_ROW of them.
template <class Real>
void limitMesh(const PassArguments<Real>& arguments, const LimitColor& color, std::uint32_t first) {
  const std::uint32_t end = std::min(color.endColumn, first + MESH_ROW);
  for (std::uint32_t n = first; n < end; ++n) {
    const auto& spring = arguments.lists.limited[n];
    const Real limit = arguments.step.limitFactor * spring.restLength;
    limitSpring(arguments, spring.a, spring.b, limit);
  }
}

// Whether a spring of some owner, of this colour or not, is longer than its limit.
template <class Real, class RestLengths>
INLINE bool anyTooLong(const PassArguments<Real>& arguments, Range owners, std::ptrdiff_t other,
                       RestLengths rest, Real nominal) {
  const Arrays<const Real> x = arraysOf(std::as_const(arguments.after.positions));
  const Real factor = arguments.step.limitFactor;
  std::uint32_t any[SIXTEEN]{};  // of every sixteenth
  forEachSixteen(
      owners, [&](std::ptrdiff_t begin, std::ptrdiff_t end) __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::ptrdiff_t i = begin; i < end; ++i) {
          const Vec3<Real> d = at(x, i + other) - at(x, i);
          const Real limit = limitLength(rest, i, factor, nominal);
          any[i - begin] |= limit * limit < dot(d, d) ? 1u : 0u;
        }
      });
  return largestOf(any) != 0;
}

// Most springs are not too long: a row of owners is looked at first, then sixteen of them together. The last
// sixteen begin among the ones before, which are no owners any more.
template <bool hasCuts, class Real, class RestLengths>
INLINE void limitOwners(const PassArguments<Real>& arguments, const LimitColor& color, std::ptrdiff_t first,
                        RestLengths rest) {
  const StepParams<Real>& step = arguments.step;
  const SpringOffset& offset = springOffsets[color.slot];
  const std::ptrdiff_t other = indexOffset(step, offset.columns, offset.rows);
  const Real nominal = step.springs[color.slot].limitLength;
  const Range owners{first + color.firstColumn, first + color.endColumn};
  if (!anyTooLong(arguments, owners, other, rest, nominal)) return;
  const auto isOwner = [&](std::ptrdiff_t i) __attribute__((always_inline)) {
    const auto place = static_cast<std::uint32_t>(i - owners.begin);
    return (place & (color.columnStep - 1)) < color.columnRun;  // steps are powers of two
  };
  const std::ptrdiff_t last = owners.end - SIXTEEN;
  if (last < owners.begin) {
    for (std::ptrdiff_t i = owners.begin; i < owners.end; ++i)
      if (isOwner(i) && !isCutAt<hasCuts>(arguments.cutMasks, i, color.slot))
        limitSpring(arguments, i, i + other, limitLength(rest, i, step.limitFactor, nominal));
    return;
  }
  for (std::ptrdiff_t begin = owners.begin; begin < owners.end; begin += SIXTEEN) {
    const std::ptrdiff_t from = std::min(begin, last);
    if (!anyTooLong(arguments, Range{from, from + SIXTEEN}, other, rest, nominal)) continue;
    const int done = static_cast<int>(begin - from);
    limitSixteen<hasCuts>(
        arguments, color.slot, from, other, rest, nominal, [&](int lane) __attribute__((always_inline)) {
          return (lane >= done) & isOwner(from + lane);
        });
  }
}

template <bool hasCuts, class Real>
INLINE void limitGridRow(const PassArguments<Real>& arguments, const LimitColor& color, int row) {
  const StepParams<Real>& step = arguments.step;
  const std::ptrdiff_t first = rangeOf(step, row).begin;
  if (step.useRestLengthTable != 0)
    limitOwners<hasCuts>(arguments, color, first,
                         arguments.restLengths + static_cast<std::size_t>(color.slot) * step.totalParticles);
  else
    limitOwners<hasCuts>(arguments, color, first, NominalLength<Real>{step.springs[color.slot].restLength});
}
template <class Real>
INLINE void limitGridRow(const PassArguments<Real>& arguments, const LimitColor& color, int row) {
  arguments.cutMasks != nullptr ? limitGridRow<true>(arguments, color, row)
                                : limitGridRow<false>(arguments, color, row);
}
VECTOR_CLONES(void, limitFloatRow, (const PassArguments<float>& arguments, const LimitColor& color, int row),
              (arguments, color, row), limitGridRow(arguments, color, row))

// Row number j of those that the colour has owners in, and whether a row is one of them.
int ownerRow(const LimitColor& color, std::uint32_t j) {
  return static_cast<int>(color.firstRow + color.rowStep * (j / color.rowRun) + j % color.rowRun);
}
bool hasOwners(const LimitColor& color, int row) {
  const int place = row - static_cast<int>(color.firstRow);
  return place >= 0 && row < static_cast<int>(color.endRow) &&
         static_cast<std::uint32_t>(place) % color.rowStep < color.rowRun;
}

template <class Real>
void checkStartRow(const PassArguments<Real>& arguments, int row) {
  const Components<Real>&p = arguments.before.positions, &v = arguments.before.velocities;
  const Range particles = rangeOf(arguments.step, row);
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const bool sound = finite(p.x[i]) && finite(p.y[i]) && finite(p.z[i]) && finite(v.x[i]) &&
                       finite(v.y[i]) && finite(v.z[i]) && finite(arguments.inverseMasses[i]);
    if (!sound) noteDivergence(arguments.watch, PASS_START, i, REASON_NON_FINITE);
  }
}

}  // namespace

void checkStart(const PassArguments<float>& arguments, int row) { checkStartRow(arguments, row); }
void checkStart(const PassArguments<double>& arguments, int row) { checkStartRow(arguments, row); }

VECTOR_CLONES(void, integrate, (const PassArguments<float>& arguments, int row), (arguments, row),
              integrateRow(arguments, row))
void integrate(const PassArguments<double>& arguments, int row) { integrateRow(arguments, row); }

template <class Real>
void kick(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Range particles = rangeOf(step, row);
  const auto& [before, after, f] = std::tie(arguments.before, arguments.after, arguments.forces);
  kickComponent(step, particles, step.gravityX, arguments.inverseMasses, f.x.data(),
                before.velocities.x.data(), after.velocities.x.data());
  kickComponent(step, particles, step.gravityY, arguments.inverseMasses, f.y.data(),
                before.velocities.y.data(), after.velocities.y.data());
  kickComponent(step, particles, step.gravityZ, arguments.inverseMasses, f.z.data(),
                before.velocities.z.data(), after.velocities.z.data());
  watchVelocities(arguments, PASS_KICK, row);
}

void limitRow(const PassArguments<float>& arguments, const LimitColor& color, int row) {
  if (hasOwners(color, row)) limitFloatRow(arguments, color, row);
}
void limitRow(const PassArguments<double>& arguments, const LimitColor& color, int row) {
  if (hasOwners(color, row)) limitGridRow(arguments, color, row);
}

void limitStrain(const PassArguments<float>& arguments, const LimitColor& color, std::uint32_t j) {
  arguments.step.isMesh != 0 ? limitMesh(arguments, color, color.firstColumn + j * MESH_ROW)
                             : limitFloatRow(arguments, color, ownerRow(color, j));
}
void limitStrain(const PassArguments<double>& arguments, const LimitColor& color, std::uint32_t j) {
  arguments.step.isMesh != 0 ? limitMesh(arguments, color, color.firstColumn + j * MESH_ROW)
                             : limitGridRow(arguments, color, ownerRow(color, j));
}

std::uint32_t limitRows(const Piece& piece, const LimitColor& color) {
  if (piece.isMesh) return (color.endColumn - color.firstColumn + MESH_ROW - 1) / MESH_ROW;
  return ownerCount(color.firstRow, color.rowStep, color.rowRun, color.endRow);
}

VECTOR_CLONES(void, watchLimit, (const PassArguments<float>& arguments, int row), (arguments, row),
              watchVelocities(arguments, arguments.step.limitPass, row))
void watchLimit(const PassArguments<double>& arguments, int row) {
  watchVelocities(arguments, arguments.step.limitPass, row);
}

template <class Real>
void movePins(const PassArguments<Real>& arguments, int row) {
  if (arguments.pinPathNumbers != nullptr) movePinsOf(arguments, rangeOf(arguments.step, row));
}

template void movePins(const PassArguments<float>&, int);
template void movePins(const PassArguments<double>&, int);
template void kick(const PassArguments<float>&, int);
template void kick(const PassArguments<double>&, int);

}  // namespace clothsim::cpu

#include "solver/cpu/surface_contact.h"

#include <atomic>
#include <cmath>
#include <limits>

#include "core/thread_team.h"
#include "solver/cpu/implicit_contact.h"
#include "solver/cpu/small_colliders.h"
#include "solver/cpu/surface_pairs.h"

namespace clothsim::cpu {
namespace {

// By how much of the margin the list of near parts looks farther than a step: lists last longer, and are
// longer.
constexpr double MORE_THAN_NEAR = 0.25;
// It leaves out what is flat for so many times the distance in which parts may touch: then it lasts, too.
constexpr double SURELY_FLAT = 1.2;

// A smaller number among those that threads bring to the same place.
template <class Number>
void lower(Number& place, Number to) {
  std::atomic_ref<Number> least(place);
  Number known = least.load(std::memory_order_relaxed);
  while (to < known && !least.compare_exchange_weak(known, to, std::memory_order_relaxed)) {
  }
}

// The mean of some particles: where the cloth is as a whole.
constexpr std::uint32_t MEAN_SAMPLES = 64;
template <class Real>
Vec3<Real> meanOf(const Components<Real>& values) {
  const auto particles = static_cast<std::uint32_t>(values.x.size());
  Vec3<Real> sum{};
  for (std::uint32_t k = 0; k < MEAN_SAMPLES; ++k) sum = sum + at(values, k * particles / MEAN_SAMPLES);
  return canonical((Real(1) / MEAN_SAMPLES) * sum);
}

template <class Real>
Real lengthOf(Vec3<Real> v) {
  const Real squared = dot(v, v);
  return canonical(squared * inverseSquareRoot(squared));
}
template <class Number>
void add(Number& place, Number more) {
  std::atomic_ref<Number>(place).fetch_add(more, std::memory_order_relaxed);
}
// In two halves, each of which converts exactly.
template <class Real>
Real fromQuanta(std::int32_t sum) {
  return static_cast<Real>(sum >> 12) * Real(4096) + static_cast<Real>(sum & 4095);
}

}  // namespace

// Boxes around the motions of particles.
template <class Real>
void SurfaceContact<Real>::boxParticles(const Components<Real>& starts, Real around) {
  const Four<Real> r{around, around, around, Real(0)};
  const Arrays<const Real> from = arraysOf(starts), motions = arraysOf(std::as_const(motions_));
  boxes_.particles.resize(starts.x.size());
  ThreadTeam::shared().forEach(0, static_cast<std::uint32_t>(boxes_.particles.size()), BOXES_AT_ONCE,
                               [&](std::uint32_t i) {
                                 const auto place = static_cast<std::ptrdiff_t>(i);
                                 const Four<Real> a = fourAt(from, place), b = a + fourAt(motions, place);
                                 boxes_.particles[i] = {{a - r, a + r}, {b - r, b + r}};
                               });
}

template <class Real>
void SurfaceContact<Real>::listNear(const Components<Real>& starts, Real around) {
  const Vec3<Real> origin = meanOf(starts);
  nearParts_.update(surface_, boxes_, origin, origin + meanOf(motions_), around,
                    static_cast<Real>(MORE_THAN_NEAR) * surface_.margin, flatBlocks_);
}

template <class Real>
void SurfaceContact<Real>::findFlat(const Components<Real>& starts, const Components<Real>& ends,
                                    Real reach) {
  flatBlocks_.update(surface_, starts, ends, reach, static_cast<Real>(SURELY_FLAT) * surface_.touchingReach);
}

// What the motion surely leaves of the distance of two parts, across any plane that separates them by it at
// the start.
template <class Real>
Real SurfaceContact<Real>::leftOf(Real distance, const Parts& parts) const {
  const Vec3<Real> first = at(motions_, parts.particles[0]);
  Real squared = 0;
  for (const std::uint32_t i : parts.particles) {
    const Vec3<Real> motion = at(motions_, i) - first;
    squared = larger(squared, dot(motion, motion));
  }
  constexpr Real rounding = static_cast<Real>(0.01);
  return (Real(1) - rounding) * distance - (Real(1) + rounding) * (Real(2) * std::sqrt(squared));
}

// test(parts, nearest) for the pairs of parts that a triangle looks for: their boxes meet, and the cloth is
// not flat there, or flat parts are looked at, too. Pairs are left out of which the motion surely leaves more
// than `reach`. test() says whether to go on.
template <class Real>
template <bool looksAtFlat, class Test>
void SurfaceContact<Real>::forEachPair(std::uint32_t triangle, const Components<Real>& starts, Real reach,
                                       Test test) {
  const auto visit = [&](const Parts& parts, Real& apart) {
    if (!overlap(boxes_.triangles[parts.first], boxes_.triangles[parts.second]) || !boxes_.meet(parts)) {
      // In findTouching() boxes reach half as far as parts may touch, so these stay apart. In guard() the
      // boxes of triangles may be older ones.
      if (reach == surface_.touchingReach && apart < Real(0))
        apart = nearParts_.apartIn(parts, leftOf(reach, parts));
      return true;
    }
    if constexpr (!looksAtFlat)
      if (flatBlocks_.areFlat(surface_, triangle, parts.first == triangle ? parts.second : parts.first))
        return true;
    const auto nearest = nearestOf<Real>(parts, starts);
    const Real left = leftOf(lengthOf(nearest.way), parts);
    apart = nearParts_.apartIn(parts, left);
    // Where flat parts are looked at, some may keep less of their motion than others.
    return (!looksAtFlat && reach < left) || test(parts, nearest);
  };
  nearParts_.forEachPair(surface_, triangle, reach, visit);
  if constexpr (looksAtFlat) nearParts_.forEachFlatPair(surface_, triangle, reach, visit);
}

template <class Real>
void SurfaceContact<Real>::findTouching(const CpuState<Real>& before, ImplicitState<Real>& implicit,
                                        const PassArguments<Real>& arguments) {
  const Components<Real>& starts = startsOf(before);
  const auto particles = static_cast<std::uint32_t>(starts.x.size()),
             triangles = static_cast<std::uint32_t>(surface_.triangles.size()),
             chunks = (triangles + NearParts<Real>::TRIANGLES - 1) / NearParts<Real>::TRIANGLES;
  const bool isLater = state_.isLater != 0;
  state_.tooMany = 0;
  motions_ = implicit.displacements;
  if (isLater)
    for (Component<Real>* c : {&motions_.x, &motions_.y, &motions_.z})
      std::fill_n(c->data(), c->size(), Real(0));
  // Small colliders find flat cloth, too.
  if (surface_.touchesItself)
    findFlat(starts, isLater ? starts : implicit.iterate.positions, surface_.touchingReach);
  const bool mayTouchItself = surface_.touchesItself && !flatBlocks_.isAllFlat();
  if (mayTouchItself) {
    boxParticles(starts, surface_.around);
    boxes_.joinTriangles(surface_);
    listNear(starts, surface_.around);
  }
  foundPairs_.resize(chunks);
  ThreadTeam::shared().forEach(0, chunks, 1, [&](std::uint32_t chunk) {
    std::vector<SurfacePair<Real>>& found = foundPairs_[chunk];
    found.clear();
    if (!mayTouchItself && surface_.colliders.empty()) return;
    const std::uint32_t first = chunk * NearParts<Real>::TRIANGLES;
    for (std::uint32_t i = first; i < std::min(first + NearParts<Real>::TRIANGLES, triangles); ++i) {
      const std::size_t firstFound = found.size(), most = firstFound + MOST_PAIRS_A_TRIANGLE;
      if (mayTouchItself)
        forEachPair<false>(i, starts, surface_.touchingReach, [&](const Parts& parts, const auto& nearest) {
          const SurfacePair<Real> pair = pairOf(surface_, parts, nearest, starts, implicit, isLater);
          if (pair.stiffness > Real(0)) found.push_back(pair);
          return found.size() <= most;
        });
      addNearColliders(surface_, arguments, implicit, surface_.triangles[i], found);
      for (std::size_t k = firstFound; k < found.size(); ++k)
        found[k].place = placeOf(i, found[k].collider, surface_.colliders.size());
      if (found.size() > most) std::atomic_ref(state_.tooMany).store(1, std::memory_order_relaxed);
    }
  });
  TouchingPairs<Real>& touching = implicit.touching;
  touching.pairs.clear();
  std::size_t count = 0;
  for (const auto& found : foundPairs_) count += found.size();
  state_.mostPairs = std::max(state_.mostPairs, static_cast<std::uint32_t>(count));
  if (count > surface_.pairLimit) state_.tooMany = 1;
  if (!surface_.touchesItself && state_.tooMany != 0) ++state_.crowdedSteps;
  if (state_.tooMany == 0)
    for (const auto& found : foundPairs_)
      touching.pairs.insert(touching.pairs.end(), found.begin(), found.end());
  for (const SurfacePair<Real>& pair : touching.pairs) {
    if (pair.collider != NO_COLLIDER) continue;
    state_.leastGap = std::min(state_.leastGap, gapBits(pair.distance));
    if (pair.held > Real(0)) implicit.scalars.isDisturbed = 1;
  }
  implicit.scalars.pairs = static_cast<std::uint32_t>(touching.pairs.size());
  touching.forces.resize(touching.pairs.size());
  listPairs(touching, particles);
  recallSlips(implicit);
  if (!surface_.colliders.empty()) meetColliders(surface_, arguments, implicit);
}

template <class Real>
typename SurfaceContact<Real>::Sides SurfaceContact<Real>::sidesOf(const Parts& parts, Vec3<Real> way,
                                                                   const Components<Real>& starts) const {
  const Vec3<Real> normal = inverseSquareRoot(dot(way, way)) * way, origin = at(starts, parts.particles[0]);
  Sides sides{};
  for (std::size_t k = 0; k < 4; ++k) {
    sides.places[k] = dot(normal, at(starts, parts.particles[k]) - origin);
    sides.motions[k] = dot(normal, at(motions_, parts.particles[k]));
  }
  const Real* p = sides.places;
  const Real last = larger(p[2], p[3]);
  sides.first = parts.areSides && p[1] < p[0] ? p[1] : p[0];
  sides.second = parts.areSides ? last : larger(p[1], last);
  return sides;
}

// Whether the motion so far leaves less than `least` between the parts. All moves linearly, so that no less
// is left on the way than at its ends.
template <class Real>
bool SurfaceContact<Real>::isTooNear(const Parts& parts, const Sides& sides, Real least) const {
  Real p[4];
  for (std::size_t k = 0; k < 4; ++k) p[k] = sides.places[k] + kept_[parts.particles[k]] * sides.motions[k];
  const Real first = parts.areSides && p[1] < p[0] ? p[1] : p[0], last = larger(p[2], p[3]),
             second = parts.areSides ? last : larger(p[1], last);
  const Real slack = static_cast<Real>(KEPT_GAP) * least;
  return !(first - second > slack) || !(widthOf(sides) > slack);
}

// Across the triangle, or both sides: parts that slide over each other keep their distance that way.
template <class Real>
Vec3<Real> SurfaceContact<Real>::acrossBoth(const Parts& parts, Vec3<Real> way,
                                            const Components<Real>& starts) const {
  const auto& [i, j, k, l] = parts.particles;
  const Vec3<Real> along = parts.areSides ? at(starts, j) - at(starts, i) : at(starts, k) - at(starts, j),
                   other = parts.areSides ? at(starts, l) - at(starts, k) : at(starts, l) - at(starts, j),
                   normal = cross(along, other);
  return dot(normal, way) < Real(0) ? Vec3<Real>{} - normal : normal;
}

// The same across planes that turn along with the parts.
template <class Real>
bool SurfaceContact<Real>::turnsTooNear(const Parts& parts, Vec3<Real> way, const Components<Real>& starts,
                                        Real least) const {
  Vec3<Real> x[4], y[4];
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t i = parts.particles[k];
    x[k] = at(starts, i);
    y[k] = x[k] + kept_[i] * at(motions_, i);
  }
  const Real slack = static_cast<Real>(KEPT_GAP) * least;
  return !SurfaceLaws<Real>::staysApart(parts.areSides, x, y, way, slack, 1) &&
         !SurfaceLaws<Real>::staysApart(parts.areSides, x, y, way, slack, int{FINE_PARTS});
}

// Cuts the motions of all four particles short, so that both parts keep to their shares of the budget, by
// their speeds. Parts that no plane across the way separates, as far as binary32 knows, do not move.
template <class Real>
void SurfaceContact<Real>::keepToSides(const Parts& parts, const Sides& sides) {
  const std::size_t firsts = parts.areSides ? 2 : 1;
  Real firstMotion = 0, secondMotion = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k < firsts)
      firstMotion = larger(firstMotion, -sides.motions[k]);
    else
      secondMotion = larger(secondMotion, sides.motions[k]);
  }
  const Real width = widthOf(sides), both = firstMotion + secondMotion;
  const Real budget = SurfaceLaws<Real>::budgetOf(larger(width, Real(0)), surface_.leastGap);
  const Real share = budget * (firstMotion * reciprocal(larger(both, Real(LEAST_APPROACH))));
  for (std::size_t k = 0; k < 4; ++k) {
    const bool isFirst = k < firsts;
    const Real towards = isFirst ? -sides.motions[k] : sides.motions[k];
    const Real room = isFirst ? share + (sides.places[k] - sides.first)
                              : (budget - share) + (sides.second - sides.places[k]);
    Real kept = room * reciprocal(larger(towards, Real(LEAST_APPROACH)));
    if (!(width > Real(0)))
      kept = 0;
    else if (!(room < towards) || !(towards > Real(LEAST_APPROACH)))
      continue;
    lower(newlyKept_[parts.particles[k]], canonical(kept));
  }
}

// Round by round, pairs that the motion so far brings too near keep to their sides; what this takes from
// particles may bring others too near.
template <class Real>
void SurfaceContact<Real>::guard(const CpuState<Real>& before, CpuState<Real>& after,
                                 const StepParams<Real>& step, const std::vector<Real>& inverseMasses,
                                 std::uint32_t round) {
  const Components<Real>& starts = startsOf(before);
  const auto particles = static_cast<std::uint32_t>(starts.x.size()),
             triangles = static_cast<std::uint32_t>(surface_.triangles.size());
  if (round == 0) {
    std::fill(std::begin(state_.tooNear), std::end(state_.tooNear), 0u);
    state_.wasPushedFar = 0;
    kept_.assign(particles, Real(1));
    newlyKept_ = kept_;
    corrections_.assign(particles, {});
  }
  // What was pushed apart may be too near to what no round has seen so far.
  if (round > 0 && state_.tooNear[round == CORRECTION_ROUNDS ? 0 : round - 1] == 0) return;
  if (round <= CORRECTION_ROUNDS) {
    motions_.resize(particles);
    for (std::uint32_t i = 0; i < particles; ++i) put(motions_, i, at(after.positions, i) - at(starts, i));
  }
  // Whatever the first rounds move, the first of the others looks at everything again.
  if (round == 0)
    findFlat(starts, after.positions, static_cast<Real>(LEAST_GAPS_OF_FLAT) * surface_.leastGap);
  const bool looksAtFlat = round >= CORRECTION_ROUNDS;
  if (!looksAtFlat && flatBlocks_.isAllFlat()) return;
  if (round <= CORRECTION_ROUNDS) boxParticles(starts, surface_.leastGap);
  if (round == 0 || round == CORRECTION_ROUNDS) boxes_.joinTriangles(surface_);
  // What was held back may be anywhere on its way while others go on.
  if (round == CORRECTION_ROUNDS + 1)
    for (auto* boxes : {&boxes_.particles, &boxes_.triangles})
      for (MovingBounds<Real>& box : *boxes) box = atAnyTime(box);
  if (round <= CORRECTION_ROUNDS + 1) listNear(starts, surface_.leastGap);
  if (looksAtFlat) nearParts_.listFlat(surface_);
  const bool corrects = round < CORRECTION_ROUNDS, all = round + 1 == GUARD_ROUNDS;
  const Real reach = all ? std::numeric_limits<Real>::infinity() : surface_.leastGap;
  const auto look = [&](const Parts& parts, const auto& nearest) {
    const Sides sides = sidesOf(parts, nearest.way, starts);
    const Real width = larger(widthOf(sides), Real(0)),
               least = corrects ? surface_.leastGap : SurfaceLaws<Real>::leastOf(width, surface_.leastGap);
    if (!all && !isTooNear(parts, sides, least)) return true;
    const Sides sliding = sidesOf(parts, acrossBoth(parts, nearest.way, starts), starts);
    if (!all && !isTooNear(parts, sliding, least)) return true;
    if (!all && !turnsTooNear(parts, nearest.way, starts, least)) return true;
    std::atomic_ref(state_.tooNear[round]).store(1, std::memory_order_relaxed);
    if (corrects)
      pushApart(parts, nearest.way, after.positions, least, inverseMasses);
    else
      keepToSides(parts, widthOf(sliding) > Real(0.5) * width ? sliding : sides);
    return true;
  };
  ThreadTeam::shared().forEach(0, triangles, NearParts<Real>::TRIANGLES, [&](std::uint32_t i) {
    looksAtFlat ? forEachPair<true>(i, starts, reach, look) : forEachPair<false>(i, starts, reach, look);
  });
  if (corrects)
    correct(after, step, inverseMasses);
  else
    kept_ = newlyKept_;
}

// Where the pair is nearest at the end, across the parts as they are then: all four go apart, by their
// weights and masses, until a little more than the least distance is left.
template <class Real>
void SurfaceContact<Real>::pushApart(const Parts& parts, Vec3<Real> way, const Components<Real>& ends,
                                     Real least, const std::vector<Real>& inverseMasses) {
  const auto nearest = nearestOf<Real>(parts, ends);
  const Vec3<Real> across = acrossBoth(parts, way, ends);
  const Real along = dot(across, way), squared = dot(across, across) * dot(way, way);
  const Vec3<Real> towards = Real(0.25) * squared < along * along ? across : way,
                   normal = inverseSquareRoot(dot(towards, towards)) * towards;
  const std::array<Real, 4> weights = weightsOf<Real>(parts, nearest);
  Real mobility = 0, inverses[4];
  for (std::size_t k = 0; k < 4; ++k) {
    inverses[k] = inverseMasses[parts.particles[k]];
    mobility = mobility + (weights[k] * weights[k]) * inverses[k];
  }
  const Real missing = Real(2) * least - dot(normal, nearest.way);
  if (!(missing > Real(0)) || !(mobility > Real(0))) return;
  const Real push = surface_.perQuantum * (missing < surface_.largestPush ? missing : surface_.largestPush);
  for (std::size_t k = 0; k < 4; ++k) {
    const Real whole = (weights[k] * inverses[k]) * reciprocal(mobility), one = 1,
               part = push * (whole < -one  ? -one
                              : one < whole ? one
                                            : whole);
    Correction& sum = corrections_[parts.particles[k]];
    const Real size = weights[k] < Real(0) ? -weights[k] : weights[k];
    add(sum.x, static_cast<std::int32_t>(part * normal.x));
    add(sum.y, static_cast<std::int32_t>(part * normal.y));
    add(sum.z, static_cast<std::int32_t>(part * normal.z));
    add(sum.weight, static_cast<std::int32_t>(Real(CORRECTION_WEIGHT) * size));
  }
}

// The mean of what pairs want of a particle, where they want more than all of it.
template <class Real>
void SurfaceContact<Real>::correct(CpuState<Real>& after, const StepParams<Real>& step,
                                   const std::vector<Real>& inverseMasses) {
  for (std::uint32_t i = 0; i < corrections_.size(); ++i) {
    const Correction sum = corrections_[i];
    if (sum.weight == 0 || !(inverseMasses[i] > Real(0))) continue;
    const Real weight = reciprocal(static_cast<Real>(std::max(sum.weight, CORRECTION_WEIGHT)));
    const Real part = (surface_.quantum * Real(CORRECTION_WEIGHT)) * weight;
    const Vec3<Real> moved =
        part * Vec3<Real>{fromQuanta<Real>(sum.x), fromQuanta<Real>(sum.y), fromQuanta<Real>(sum.z)};
    const Real far = lengthOf(moved);
    state_.largestCorrection = std::max(state_.largestCorrection, gapBits(far));
    if (far > static_cast<Real>(FAR_PUSH) * surface_.largestPush) state_.wasPushedFar = 1;
    put(after.positions, i, canonical(at(after.positions, i) + moved));
    put(after.velocities, i, canonical(at(after.velocities, i) + step.inverseTimeStep * moved));
    corrections_[i] = {};
  }
}

template <class Real>
void SurfaceContact<Real>::shorten(const CpuState<Real>& before, CpuState<Real>& after,
                                   const StepParams<Real>& step, const std::vector<Real>& inverseMasses) {
  const Components<Real>& starts = startsOf(before);
  std::uint32_t shortened = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (!(kept_[i] < Real(1))) continue;
    ++shortened;
    const auto place = static_cast<std::ptrdiff_t>(i);
    const Vec3<Real> motion = at(motions_, place), lost = (Real(1) - kept_[i]) * motion;
    put(after.positions, place, canonical(at(starts, place) + kept_[i] * motion));
    if (inverseMasses[i] > Real(0))
      put(after.velocities, place, canonical(at(after.velocities, place) - step.inverseTimeStep * lost));
    else
      state_.pinLag = std::max(state_.pinLag, gapBits(lengthOf(lost)));
  }
  state_.isGuarded = shortened > 0 ? 1 : 0;
  state_.shortened += shortened;
  state_.guardedSteps += shortened > 0 ? 1 : 0;
  state_.crowdedSteps += state_.tooMany != 0 ? 1 : 0;
}

template <class Real>
void SurfaceContact<Real>::settle(const CpuState<Real>& before, const CpuState<Real>& after,
                                  ImplicitState<Real>& implicit) {
  state_.isLater = 1;
  const bool goesOn = state_.isGuarded != 0 || state_.wasPushedFar != 0;
  state_.isSettled = goesOn ? 0 : 1;
  std::uint32_t& isSolved = implicit.scalars.isStepSolved;
  isSolved = goesOn ? 0 : isSolved == 1 ? 1 : STEP_ENDED;
  safePositions_ = after.positions;
  safeVelocities_ = after.velocities;
  if (state_.isSettled != 0) return;
  implicit.iterate.positions = after.positions;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const auto place = static_cast<std::ptrdiff_t>(i);
    put(implicit.displacements, place, canonical(at(after.positions, place) - at(before.positions, place)));
  }
}

template <class Real>
void SurfaceContact<Real>::run(PassCall call, const CpuState<Real>& before, CpuState<Real>& after,
                               ImplicitState<Real>& implicit, const PassArguments<Real>& arguments,
                               const std::vector<Real>& inverseMasses) {
  const StepParams<Real>& step = arguments.step;
  if (call.pass == Pass::findTouching && call.index == 0)
    state_.isLater = state_.isSettled = state_.isPressed = 0;
  if (call.pass == Pass::pressOut && call.index == PRESS_ROUNDS)
    return pressOut(surface_, arguments, implicit, state_, PRESS_ROUNDS);
  if (call.pass == Pass::settle) return settle(before, after, implicit);
  if (state_.isSettled != 0) {
    // The end of the step has been done once more, without what the guard has corrected.
    if (call.pass != Pass::shorten || (state_.tooNear[0] == 0 && state_.isPressed == 0)) return;
    after.positions = safePositions_;
    after.velocities = safeVelocities_;
    return;
  }
  switch (call.pass) {
    case Pass::findTouching:
      return findTouching(before, implicit, arguments);
    case Pass::weighPairs:
      if (!surface_.colliders.empty()) meetColliders(surface_, arguments, implicit);
      return weighPairs(implicit, step);
    case Pass::multiplyPairs:
      return multiplyPairs(implicit);
    case Pass::keepSlips:
      return keepSlips(implicit, step);
    case Pass::pressOut:
      return pressOut(surface_, arguments, implicit, state_, call.index);
    case Pass::guard:
      return guard(before, after, step, inverseMasses, call.index);
    default:
      return shorten(before, after, step, inverseMasses);
  }
}

template class SurfaceContact<float>;
template class SurfaceContact<double>;

}  // namespace clothsim::cpu

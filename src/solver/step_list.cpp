#include "solver/step_list.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

#include "solver/hierarchy.h"
#include "solver/self_collision.h"
#include "solver/step_params.h"
#include "solver/surface.h"

namespace clothsim {
namespace {

class ListBuilder {
 public:
  void add(Pass pass, std::size_t index = 0) {
    list_.passes.push_back({pass, static_cast<std::uint16_t>(index)});
  }
  template <class Body>
  void repeat(const char* name, int times, Body body) {
    const std::size_t loop = list_.loops.size(), first = list_.passes.size();
    list_.loops.push_back({name, first, 0, static_cast<std::size_t>(std::max(times, 0))});
    for (int k = 0; k < times; ++k) {
      const std::size_t loops = list_.loops.size();
      body();
      if (k == 0)
        list_.loops[loop].count = list_.passes.size() - first;
      else
        list_.loops.resize(loops);  // those inside are told of once
    }
    if (list_.loops[loop].count == 0) list_.loops.resize(loop);
  }
  PassList finish(Outcome outcome) {
    list_.outcome = outcome;
    list_.findGateEnds();
    return std::move(list_);
  }

 private:
  PassList list_;
};

// Of a strain limit.
std::size_t mostColors(const Cloth& cloth) {
  std::size_t most = 0;
  for (const Piece& piece : cloth.pieces()) most = std::max(most, makeLimitColors(piece).size());
  return most;
}

// Newton steps of a step, after which its linear systems may take so many times the iterations.
constexpr int QUICK_NEWTON_STEPS = 10, LATE_ITERATIONS = 5;

class StepBuilder {
 public:
  StepBuilder(const Scene& scene, const Cloth& cloth, std::size_t levels)
      : solver_(scene.solver),
        hasColliders_(!scene.colliders.empty()),
        isImplicit_(isImplicit(scene.solver.integrator)),
        touchesItself_(isImplicit_ && hasSurfaceContact(scene)),
        hasSmallColliders_(hasSmallColliders(scene, cloth)),
        contacts_(collidesWithItself(scene, cloth) ? scene.solver.selfCollision : SelfCollision::off),
        rounds_(contactRounds(scene)),
        levels_(levels),
        colors_(limitsInPasses(scene) ? mostColors(cloth) : 0) {}

  PassList step() {
    isImplicit_ ? moveImplicitly() : moveExplicitly();
    finishMotion();
    if (touchesItself_) list_.repeat("round of contact", CONTACT_ROUNDS - 1, [&] { goOnAfterContact(); });
    if (hasSmallColliders_) list_.add(Pass::pressOut, PRESS_ROUNDS);
    if (solver_.integrator == Integrator::bdf2) list_.add(Pass::remember);
    if (isImplicit_) list_.add(Pass::countStep);
    return list_.finish(Outcome::state);
  }

 private:
  void moveExplicitly() {
    list_.add(Pass::forces);
    list_.add(Pass::integrate);
  }

  void moveImplicitly() {
    if (hasColliders_) list_.add(Pass::predictPlanes);
    list_.add(Pass::begin);
    if (hasPairs()) list_.add(Pass::findTouching, 0);
    makeLevels();
    newtonStep(solver_.cgIterations);
    furtherNewtonSteps(solver_.newtonSteps - 1);
    endStep();
  }

  // Where a few Newton steps have not solved the step, linear systems that were cut short are in the way:
  // layer upon layer of cloth needs more iterations than anything else.
  void furtherNewtonSteps(int count) {
    const int usual = std::min(count, QUICK_NEWTON_STEPS), most = solver_.cgIterations;
    const auto repeat = [&](const char* name, int times, int iterations) {
      list_.repeat(name, times, [&] {
        findPlanes();
        newtonStep(iterations);
      });
    };
    repeat("further Newton step", usual, most);
    repeat("late Newton step", count - usual, solver_.cgIterations.automatic ? LATE_ITERATIONS * most : most);
  }

  void finishMotion() {
    contacts_ == SelfCollision::robust ? endRobustly() : endAsCs184Does();
    if (hasSmallColliders_)
      for (std::size_t round = 0; round < PRESS_ROUNDS; ++round) list_.add(Pass::pressOut, round);
    if (touchesItself_) guardMotion();
  }

  void endStep() {
    list_.add(Pass::end);
    if (hasPairs()) list_.add(Pass::keepSlips);
  }

  // Where motion was cut short, or parts were pushed far apart, the step goes on from there, with the
  // contacts that are there. Otherwise this changes nothing.
  void goOnAfterContact() {
    list_.add(Pass::settle);
    list_.add(Pass::findTouching, 1);
    furtherNewtonSteps(std::max(solver_.newtonSteps / 2, 1));
    endStep();
    finishMotion();
  }

  void newtonStep(int iterations) {
    list_.add(Pass::elasticForces);
    if (hasPairs()) list_.add(Pass::weighPairs);
    list_.add(Pass::linearize);
    solve(iterations);
    if (hasColliders_) list_.add(Pass::stopAtPlanes);
    searchLine();
    list_.add(Pass::measureUpdate);
  }

  // The preconditioner; it is kept for all Newton steps.
  void makeLevels() {
    for (std::size_t level = 0; level < levels_; ++level) {
      list_.add(Pass::findCenters, level);
      list_.add(Pass::coarsen, level);
    }
    list_.add(Pass::invertDense);
  }

  // Conjugate gradients. The last iteration needs no new direction.
  void solve(int iterations) {
    const auto iterate = [&] {
      list_.add(Pass::updateDirection);
      if (hasPairs()) list_.add(Pass::multiplyPairs);
      list_.add(Pass::multiply);
      list_.add(Pass::sumCurvature);
      list_.add(Pass::updateSolution);
    };
    precondition();
    list_.add(Pass::sumFirstResidual);
    list_.repeat("iteration", iterations - 1, [&] {
      iterate();
      precondition();
      list_.add(Pass::sumNextResidual);
    });
    if (iterations > 0) iterate();
  }

  void precondition() {
    for (std::size_t level = 0; level < levels_; ++level) list_.add(Pass::restrict, level);
    list_.add(Pass::solveCoarsest);
    for (std::size_t level = levels_; level-- > 0;) list_.add(Pass::prolong, level);
  }

  void searchLine() {
    list_.add(Pass::tryLengths);
    list_.add(Pass::sumEnergies);
    list_.add(Pass::accept);
  }

  void findPlanes() {
    if (hasColliders_) list_.add(Pass::findPlanes);
  }

  void limitStrain() {
    for (std::size_t color = 0; color < colors_; ++color) list_.add(Pass::limit, color);
    if (colors_ > 0) list_.add(Pass::watchLimit);
  }
  void collide() {
    if (hasColliders_) list_.add(Pass::collide);
  }

  void resolveContacts() {
    list_.add(Pass::checkHash);
    list_.add(Pass::buildHash, HASHES_END);
    list_.add(Pass::findCandidates);
    list_.add(Pass::resolveContacts);
  }

  // Contacts between particles come last but for the colliders: nothing may move particles through the cloth
  // after them.
  void endRobustly() {
    list_.repeat("round of limits and colliders", rounds_, [&] {
      limitStrain();
      collide();
    });
    resolveContacts();
    list_.add(Pass::checkMotion);
    list_.add(Pass::buildHash, HASHES_START);
    list_.add(Pass::findCandidates);
    list_.add(Pass::clampMotion);
    collide();
  }

  void endAsCs184Does() {
    if (contacts_ == SelfCollision::averaged) resolveContacts();
    collide();
    limitStrain();
    list_.repeat("round of colliders and limits", rounds_ - 1, [&] {
      collide();
      limitStrain();
    });
    if (rounds_ > 1) collide();
  }

  // Last of all: nothing may move particles after it.
  void guardMotion() {
    for (std::size_t round = 0; round < GUARD_ROUNDS; ++round) list_.add(Pass::guard, round);
    list_.add(Pass::shorten);
  }

  [[nodiscard]] bool hasPairs() const { return touchesItself_ || hasSmallColliders_; }

  const SolverSettings& solver_;
  bool hasColliders_, isImplicit_, touchesItself_, hasSmallColliders_;
  SelfCollision contacts_;
  int rounds_;
  std::size_t levels_, colors_;
  ListBuilder list_;
};

template <class Enum>
std::string namesIn(SetOf<Enum> set, int count) {
  std::string names;
  for (int i = 0; i < count; ++i)
    if (set.contains(static_cast<Enum>(i)))
      names += (names.empty() ? "" : ", ") + std::string(nameOf(static_cast<Enum>(i)));
  return names;
}

std::string nameOf(const PassCall& call) {
  std::string name(call.traits().name);
  if (call.pass == Pass::limit) return name + ", colour " + std::to_string(call.index);
  if (call.pass == Pass::findCenters || call.pass == Pass::coarsen || call.pass == Pass::restrict ||
      call.pass == Pass::prolong)
    return name + ", level " + std::to_string(call.index);
  if (call.pass == Pass::buildHash)
    return name + (call.index == HASHES_START ? " of the start" : " of the end");
  return name;
}

// Columns, of which the last two may be of any length.
std::string line(int indent, const std::string& name, const std::string& domain, const std::string& reach,
                 const std::string& arrays, const std::string& features) {
  std::ostringstream text;
  text << std::left << std::string(static_cast<std::size_t>(indent), ' ') << std::setw(26 - indent) << name
       << std::setw(21) << domain << std::setw(7) << reach << arrays << features << '\n';
  return text.str();
}

std::string line(int indent, const PassCall& call) {
  const PassTraits& traits = call.traits();
  const std::string features = namesIn(traits.features, FEATURE_COUNT);
  return line(
      indent, nameOf(call), std::string(nameOf(traits.domain)), std::to_string(traits.reach),
      namesIn(traits.gathers | traits.reads, ARRAY_COUNT) + " -> " + namesIn(traits.writes, ARRAY_COUNT),
      features.empty() ? "" : "  (" + features + ")");
}

// The passes [first, end), which the loops from `loop` on are in; returns the first loop behind them.
std::size_t describe(const PassList& list, std::size_t first, std::size_t end, std::size_t loop, int indent,
                     std::string& text) {
  for (std::size_t i = first; i < end;) {
    if (loop == list.loops.size() || list.loops[loop].first != i) {
      text += line(indent, list.passes[i++]);
      continue;
    }
    const PassList::Loop& own = list.loops[loop];
    text += std::string(static_cast<std::size_t>(indent), ' ') + std::to_string(own.times) + " x " +
            own.name + ":\n";
    loop = describe(list, i, i + own.count, loop + 1, indent + 2, text);
    i += own.count * own.times;
  }
  return loop;
}

}  // namespace

// From the last pass on: behind one with a gate that closes as early, the search goes on at that one's end.
void PassList::findGateEnds() {
  gateEnds.resize(passes.size());
  for (std::size_t i = passes.size(); i-- > 0;) {
    std::size_t end = i + 1;
    while (end < passes.size() && passes[end].traits().gate >= passes[i].traits().gate) end = gateEnds[end];
    gateEnds[i] = static_cast<std::uint32_t>(end);
  }
  const auto last = std::find_if(passes.rbegin(), passes.rend(),
                                 [](const PassCall& call) { return call.pass == Pass::shorten; });
  settledEnd = static_cast<std::uint32_t>(passes.rend() - last);
  kinds.reset();
  for (const PassCall& call : passes) kinds.set(static_cast<std::size_t>(call.pass));
}

std::size_t mostLevels(const Cloth& cloth, const Cuts& cuts) {
  std::size_t most = 0;
  for (const auto& levels : makeHierarchy<float>(cloth, cuts).pieces) most = std::max(most, levels.size());
  return most;
}

PassList makeStep(const Scene& scene, const Cloth& cloth, std::size_t levels) {
  return StepBuilder(scene, cloth, levels).step();
}

// The aggregates still have to be where the cloth is: their centers are found in every step.
PassList keepingLevels(PassList step) {
  const auto makesMatrices = [](const PassCall& call) {
    return call.pass == Pass::coarsen || call.pass == Pass::invertDense;
  };
  for (PassList::Loop& loop : step.loops) {
    const auto first = step.passes.begin() + static_cast<std::ptrdiff_t>(loop.first);
    loop.first -= static_cast<std::size_t>(std::count_if(step.passes.begin(), first, makesMatrices));
  }
  std::erase_if(step.passes, makesMatrices);
  step.findGateEnds();
  return step;
}

PassList listOf(std::initializer_list<Pass> passes, Outcome outcome) {
  ListBuilder list;
  for (const Pass pass : passes) list.add(pass);
  return list.finish(outcome);
}

PassList makeConversion() { return listOf({Pass::forces, Pass::kick}, Outcome::velocities); }

PassList makeStartCheck() { return listOf({Pass::checkStart}, Outcome::nothing); }

std::size_t sweepLength(std::span<const PassCall> passes) {
  const auto fits = [&](std::size_t count) {
    return std::all_of(
        passes.begin(), passes.begin() + static_cast<std::ptrdiff_t>(count),
        [&](const PassCall& earlier) { return canShareSweep(earlier.traits(), passes[count].traits()); });
  };
  std::size_t count = 1;
  while (count < passes.size() && fits(count)) ++count;
  return count;
}

std::string nameOf(std::span<const PassCall> passes) {
  std::string names;
  for (std::size_t i = 0; i < passes.size(); ++i)
    if (i == 0 || passes[i].pass != passes[i - 1].pass)
      names += (names.empty() ? "" : ", ") + nameOf(passes[i].pass);
  return names;
}

std::string describe(const PassList& list) {
  std::string text = line(0, "pass", "runs over", "reach", "reads -> writes", "  (depends on)");
  describe(list, 0, list.passes.size(), 0, 0, text);
  return text;
}

}  // namespace clothsim

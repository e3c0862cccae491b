#include "measure/run_watch.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cloth/material.h"
#include "core/error.h"
#include "core/formatted.h"
#include "scene/cloth_name.h"
#include "scene/pose.h"
#include "solver/pin_paths.h"
#include "solver/self_collision.h"
#include "solver/surface.h"

namespace clothsim {
namespace {

constexpr double DOUBTFUL_TURN = 5;  // degrees in one step
// Springs do not resist in all directions at once, and damping helps: pinned2 does not boil in steps 1.13
// times as long as the stable one (cloth.density 4), in those of 1.31 times (3) it does.
constexpr double DOUBTFUL_STEP = 1.1;

// Half the smallest spacing: pins that jump so far stretch their springs by half.
double doubtfulDistance(const Cloth& cloth) {
  constexpr double least = 1e-3;  // [m]
  return std::max(0.5 * smallestSpacing(cloth), least);
}

double degreesBetween(const Pose& a, const Pose& b) {
  double trace = 0;
  for (std::size_t i = 0; i < 3; ++i) trace += dot(a.rotation[i], b.rotation[i]);
  return std::acos(std::clamp(0.5 * (trace - 1), -1.0, 1.0)) * 180 / std::numbers::pi;
}

// The jump from the end of a loop to its beginning, if it is too large.
std::optional<Warning> jumpOf(const Motion& motion, const std::string& name, double doubtful) {
  if (!motion.loop || motion.keys.size() < 2) return std::nullopt;
  const Motion::Key& last = motion.keys.back();
  const Pose end{last.position, rotationMatrix(last.rotation)}, begin = poseAt(motion, 0);
  const double distance = length(begin.position - end.position), degrees = degreesBetween(end, begin);
  if (distance < doubtful && degrees < DOUBTFUL_TURN) return std::nullopt;
  const std::string far = formatted("%.3g m", distance) + " and " + formatted("%.3g degrees", degrees);
  return Warning{"path", std::nullopt, name + " jumps by " + far,
                 name + " jumps by " + far + " within one step whenever its loop begins again, first at " +
                     formatted("%.3g s", last.t) + ": let its last key equal its first"};
}

// The largest distance from the pins of a path, counted over all cloths, to where the path puts them now [m].
double distanceFromPath(const Cloth& cloth, const State& state, const PinPaths& paths, std::size_t path) {
  const Pose pose = poseAt(paths.paths[path].motion, state.clock.time());
  const Vec3d center = paths.paths[path].center;
  double largest = 0;
  for (std::size_t i = 0; i < paths.numbers.size(); ++i) {
    if (paths.numbers[i] != path + 1) continue;
    const Particle4& x = state.positions[i];
    const Vec3d onPath = pose.position + rotate(pose.rotation, cloth.positions()[i] - center);
    largest = std::max(largest, length(onPath - Vec3f{x.x, x.y, x.z}.cast<double>()));
  }
  return largest;
}

std::string stepsAdvice(const Scene& scene) {
  return "raise solver.simulation_steps (now " + std::to_string(scene.solver.simulationSteps) + ")";
}

Warning contactWarning(const ContactFailure& failure, const Scene& scene) {
  if (failure.condition == ContactFailure::Condition::startCrossings) {
    const std::string pairs = std::to_string(failure.pairs);
    return {"contact", 0, "crosses itself at the start",
            "the cloth crosses itself at the start (" + pairs + (failure.pairs == 1 ? " pair" : " pairs") +
                " of a side and a triangle): contact keeps it so; begin with the layers apart"};
  }
  Warning warning{"contact", failure.frame, "", ""};
  const bool averaged = scene.solver.selfCollision == SelfCollision::averaged,
             isSolved =
                 isImplicit(scene.solver.integrator) && scene.solver.selfCollision != SelfCollision::contact;
  const std::string better = isSolved ? "self_collision=contact" : averaged ? "self_collision=robust" : "";
  const bool isFast = failure.condition == ContactFailure::Condition::fastStep;
  warning.brief = (isFast ? "not certain since frame " : "lost, seen in frame ") +
                  std::to_string(failure.frame) + ": " +
                  (better.empty() ? "raise simulation_steps" : "set " + better);
  const std::string advice =
      better.empty() ? stepsAdvice(scene)
                     : "set solver." + better +
                           (isSolved ? ", which implicit steps solve for" : ", which keeps layers apart");
  if (isFast)
    warning.text =
        "contact is not certain: a particle moved farther in a step than the search for contacts reaches; " +
        advice;
  else
    warning.text = "contact was lost: " + formatted("%.0f", static_cast<double>(failure.pairs)) +
                   (failure.pairs == 1 ? " pair" : " pairs") + " of particles nearer than " +
                   formatted("%.3g mm", 1000 * failure.neededDistance) +
                   ", below which triangles can cross; nearest " +
                   formatted("%.3g mm", 1000 * failure.distance) + "; " +
                   (failure.frame == 0 ? "begin with the layers farther apart" : advice);
  return warning;
}

Warning energyWarning(const EnergyWatch::Gain& gain, const Scene& scene) {
  const bool isExplicit = !isImplicit(scene.solver.integrator);
  const bool pushes = isExplicit && scene.solver.selfCollision != SelfCollision::off;
  return {"energy", gain.frame, "the cloth gains energy",
          formatted("the cloth moves with up to %.2g J, of which falling has given %.2g J; ", gain.kinetic,
                    gain.fallen) +
              (pushes ? "self_collision pushes it: set solver.integrator=implicit and "
                        "solver.self_collision=contact"
                      : stepsAdvice(scene))};
}

// "31 %", "0.4 %"
std::string percent(std::uint64_t part, std::uint64_t whole) {
  const double share = 100 * static_cast<double>(part) / static_cast<double>(whole);
  return formatted(share < 1 ? "%.1g %%" : "%.0f %%", share);
}

// Whether planes have a friction that does not act.
bool hasSlipperyPlanes(const Scene& scene) {
  return isImplicit(scene.solver.integrator) && scene.solver.frictionLaw == FrictionLaw::cs184 &&
         std::ranges::any_of(scene.colliders, [](const Collider& collider) {
           const auto* plane = std::get_if<Plane>(&collider);
           return plane != nullptr && plane->friction > 0;
         });
}

}  // namespace

double doubtfulStrain(const Scene& scene) { return usesMaterial(scene) ? 0.5 : 1; }

std::vector<Warning> pathWarnings(const Cloth& cloth, const Scene& scene, const State& state) {
  std::vector<Warning> warnings;
  const double doubtful = doubtfulDistance(cloth);
  const auto addJump = [&](const Motion& motion, const std::string& name) {
    if (std::optional<Warning> jump = jumpOf(motion, name, doubtful)) warnings.push_back(std::move(*jump));
  };
  const PinPaths paths = makePinPaths(scene, cloth, state.offPath);
  std::size_t path = 0;
  for (std::size_t i = 0; i < scene.cloths.size(); ++i)
    for (std::size_t k = 0; k < scene.cloths[i].pinMotion.size(); ++k, ++path) {
      const std::string name = nameOfCloth(scene, i) + ".pin_motion." + std::to_string(k);
      if (!paths.paths[path].isFree.empty()) continue;  // which are drawn to their path and do not jump
      const double distance = distanceFromPath(cloth, state, paths, path);
      if (distance > doubtful) {
        const std::string far = name + " is " + formatted("%.3g m", distance) + " away from its pins";
        warnings.push_back({"path", 0, far,
                            far + formatted(" at %.3g s", state.clock.time()) +
                                ", and the first step moves them there: let it begin where they are"});
      }
      addJump(paths.paths[path].motion, name);
    }
  for (std::size_t i = 0; i < scene.colliders.size(); ++i)
    std::visit(
        [&](const auto& shape) {
          if (shape.motion) addJump(*shape.motion, "colliders." + std::to_string(i) + ".motion");
        },
        scene.colliders[i]);
  return warnings;
}

Warning convergenceWarning(const ConvergenceCounts& counts, double largestUpdate, const Scene& scene) {
  const std::string share = percent(counts.unconvergedSteps, counts.steps);
  // Small updates do not count where their linear systems ended early.
  const bool endedEarly = largestUpdate <= scene.solver.tolerance;
  const std::string cap = endedEarly ? "cg_iterations (now " + std::to_string(scene.solver.cgIterations.count)
                                     : "newton_steps (now " + std::to_string(scene.solver.newtonSteps);
  return {"convergence", std::nullopt,
          share + formatted(" of steps not solved (last update up to %.1g)", largestUpdate),
          std::to_string(counts.unconvergedSteps) + " of " + std::to_string(counts.steps) + " steps (" +
              share + ") ended before they were solved (" +
              formatted("last update up to %.2g, tolerance %.2g", largestUpdate, scene.solver.tolerance) +
              "); " + stepsAdvice(scene) + " or solver." + cap + ")"};
}

std::optional<Warning> longStepsWarning(const Scene& scene) {
  const double h = stepLength(scene.solver), stable = stableStep(scene);
  if (h <= DOUBTFUL_STEP * stable) return std::nullopt;
  return Warning{"step", std::nullopt, "steps may be too long: raise simulation_steps",
                 formatted("steps of %.3g s may be too long for these springs, which are sure to be stable "
                           "in steps up to %.3g s; ",
                           h, stable) +
                     "set solver.simulation_steps=" + std::to_string(stableSteps(scene)) + " (now " +
                     std::to_string(scene.solver.simulationSteps) + "), or solver.integrator=implicit"};
}

std::optional<Warning> thinLayersWarning(const Scene& scene, const Cloth& cloth) {
  double asked = 0, kept = 0;
  std::string where;
  if (const ThinnedLayers thinned = thinnedLayers(scene, cloth); thinned.particles > 0) {
    asked = thinned.fabric;
    kept = thinned.least;
    where = " at " + std::to_string(thinned.particles) + " of " + std::to_string(cloth.particleCount()) +
            " particles, half the shortest side there";
  } else if (collidesWithItself(scene, cloth)) {
    asked = thicknessDistance(scene);
    kept = contactDistance(scene, cloth);
    where = ", 7 of the shortest spacings";
  }
  if (!(kept < asked)) return std::nullopt;
  const auto millimeters = [](double x) { return formatted("%.3g mm", 1000 * x); };
  return Warning{"contact", 0, "layers are thinner than the cloth",
                 "layers meet at " + millimeters(kept) + " instead of " + millimeters(asked) + where +
                     "; use fewer points or a smaller thickness"};
}

std::optional<Warning> farFromOriginWarning(const Scene& scene, const State& state) {
  constexpr double doubtfulSpeed = 0.005;   // [m/s]
  constexpr double doubtfulDigit = 1.5e-4;  // of strains and contacts [m]
  float farthest = 0;
  for (const Particle4& x : state.positions)
    farthest = std::max({farthest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  const double digit = std::nextafter(farthest, 2 * farthest) - farthest;
  const std::string place =
      formatted("the cloth begins %.3g m from the origin, where binary32 holds places to %.1g m: ",
                static_cast<double>(farthest), digit);
  if (isImplicit(scene.solver.integrator)) {  // which takes velocities from displacements
    if (!(digit > doubtfulDigit)) return std::nullopt;
    return Warning{"start", 0, "far from the origin, where places are rounded",
                   place +
                       "strains and contacts are wrong by that, and steps may not be solved; move the scene "
                       "nearer to the origin"};
  }
  // A step adds to a coordinate what is more than half of its last digit.
  const double lost = 0.5 * digit / stepLength(scene.solver);
  if (!(lost > doubtfulSpeed)) return std::nullopt;
  return Warning{"start", 0, "far from the origin, where explicit steps lose slow motions",
                 place +
                     formatted("explicit steps of %.2g s lose motions below %.2g m/s there; ",
                               stepLength(scene.solver), lost) +
                     "move the scene nearer to the origin, or set solver.integrator=implicit"};
}

std::optional<Warning> seamWarning(int frame, const Cloth& cloth, const Scene& scene, const State& state) {
  constexpr double settled = 0.2;  // what swings when a seam closes has come to rest [s]
  const SeamGap gap = seamGap(cloth, scene, state, settled);
  if (gap.distance <= doubtfulDistance(cloth)) return std::nullopt;
  const std::string far = formatted("%.3g mm", 1000 * gap.distance),
                    name = "seams." + std::to_string(gap.seam);
  return Warning{"seam", frame, name + " gapes by " + far,
                 "points that " + name + " joins are " + far + " apart though it is closed; raise " + name +
                     ".stiffness" + formatted(" (now %.3g N/m)", gap.stiffness) +
                     ", or see that it joins the borders you mean"};
}

void RunWatch::start(const Cloth& cloth, const Scene& scene, const State& state) {
  startInColliders_ = overlapsWithColliders(cloth, scene, state);
  coincidentPoints_ = hasSurfaceContact(scene) ? coincidentPoints(cloth, state) : 0;
  paths_ = pathWarnings(cloth, scene, state);
  farFromOrigin_ = farFromOriginWarning(scene, state);
  startWithoutState(cloth, scene);
}

void RunWatch::startWithoutState(const Cloth& cloth, const Scene& scene) {
  unseenColliders_ = unseenColliders(scene, cloth);
  thinLayers_ = thinLayersWarning(scene, cloth);
}

void RunWatch::add(int frame, const Cloth& cloth, const Scene& scene, const State& state, double strain,
                   const ContactCounts& counts) {
  contacts_.add(frame, cloth, scene, state, strain, counts);
  seams_ = seamWarning(frame, cloth, scene, state);
  peakStrain_ = std::max(peakStrain_, strain);
  if (frame == 0) startStrain_ = strain;
  crowdedSteps_ = counts.crowdedSteps;
  passages_ = counts.passages;
  if (passages_ > 0 && !passedFrame_) passedFrame_ = frame;
  pinLag_ = counts.pinLag;
  if (pinLag_ > doubtfulDistance(cloth) && !laggingFrame_) laggingFrame_ = frame;
  if (crowdedSteps_ > 0 && !crowdedFrame_) crowdedFrame_ = frame;
  if (strain > doubtfulStrain(scene) && !doubtfulFrame_) doubtfulFrame_ = frame;
}

void RunWatch::addConvergence(int frame, const ConvergenceCounts& counts) {
  if (counts.unconvergedSteps > 0 && !unsolvedFrame_) unsolvedFrame_ = frame;
  convergence_ = counts;
  largestUpdate_ = std::max(largestUpdate_, counts.lastUpdate);
}

std::vector<Warning> RunWatch::warnings(const Scene& scene) const {
  std::vector<Warning> warnings;
  addStart(warnings, scene);
  addContacts(warnings, scene);
  if (seams_) warnings.push_back(*seams_);
  addStrains(warnings, scene);
  if (energy_ && energy_->gain()) warnings.push_back(energyWarning(*energy_->gain(), scene));
  if (100 * convergence_.unconvergedSteps > convergence_.steps) {
    warnings.push_back(convergenceWarning(convergence_, largestUpdate_, scene));
    warnings.back().frame = unsolvedFrame_;
  }
  return warnings;
}

void RunWatch::addStart(std::vector<Warning>& warnings, const Scene& scene) const {
  if (startInColliders_.particles > 0)
    warnings.push_back({"start", 0, "starts inside a collider",
                        std::to_string(startInColliders_.particles) +
                            (startInColliders_.particles == 1 ? " particle starts" : " particles start") +
                            " inside a collider, up to " +
                            formatted("%.3g mm", 1000 * startInColliders_.depth) +
                            " deep; the first step pushes them out"});
  if (coincidentPoints_ > 0)
    warnings.push_back(
        {"start", 0, "points of the cloth coincide",
         std::to_string(coincidentPoints_) +
             " points lie on others, to which no seam joins them: contact holds them fast, since it cannot "
             "tell one side of the cloth from the other there; weld or sew them, or begin with "
             "borders 1 mm apart"});
  if (farFromOrigin_) warnings.push_back(*farFromOrigin_);
  if (std::optional<Warning> longSteps = longStepsWarning(scene)) warnings.push_back(std::move(*longSteps));
  warnings.insert(warnings.end(), paths_.begin(), paths_.end());
  if (unseenColliders_ > 0)
    warnings.push_back(
        {"start", 0, "a collider is smaller than a cell",
         std::to_string(unseenColliders_) + (unseenColliders_ == 1 ? " collider is" : " colliders are") +
             " thinner than a cell and may pass through the cloth. Raise the resolution, or set "
             "solver.integrator=implicit (this does not help mesh colliders)."});
  if (thinLayers_) warnings.push_back(*thinLayers_);
}

void RunWatch::addContacts(std::vector<Warning>& warnings, const Scene& scene) const {
  if (passedFrame_)
    warnings.push_back({"contact", passedFrame_, "a collider went through the cloth",
                        "small colliders went through triangles " + std::to_string(passages_) +
                            (passages_ == 1 ? " time" : " times") + "; " + stepsAdvice(scene)});
  if (const auto& failure = contacts_.failure()) warnings.push_back(contactWarning(*failure, scene));
  if (scene.solver.selfCollision == SelfCollision::contact && !isImplicit(scene.solver.integrator))
    warnings.push_back(
        {"contact", std::nullopt, "layers do not meet: contact needs integrator=implicit",
         "solver.self_collision \"contact\" needs implicit steps, and nothing keeps layers apart now; "
         "set solver.integrator to \"implicit\" or \"bdf2\", or self_collision to \"robust\""});
  if (hasSlipperyPlanes(scene))
    warnings.push_back({"start", std::nullopt, "planes have no friction in implicit steps",
                        "CS184's friction acts where a step ends behind a plane, and implicit steps end "
                        "before it: cloth slides "
                        "there; set solver.friction_law to \"coulomb\""});
  if (laggingFrame_)
    warnings.push_back(
        {"path", laggingFrame_, "pins were kept back by layers of cloth",
         formatted("pins ended steps up to %.3g mm behind their paths, since layers of cloth were "
                   "in the way; lead them around, or slower",
                   1000 * pinLag_)});
  if (crowdedFrame_)
    warnings.push_back(
        {"contact", crowdedFrame_, "too many contacts at once",
         "layers, or cloth and small colliders, touched at hundreds of places a particle in " +
             std::to_string(crowdedSteps_) + (crowdedSteps_ == 1 ? " step" : " steps") +
             ", and nothing pushed them apart there (layers do not cross); make the fabric thinner, or "
             "spread the cloth at the start"});
}

void RunWatch::addStrains(std::vector<Warning>& warnings, const Scene& scene) const {
  if (startStrain_ > 1)
    warnings.push_back({"start", 0, formatted("springs begin stretched by %.0f %%", 100 * startStrain_),
                        formatted("springs begin stretched by up to %.0f %%: ", 100 * startStrain_) +
                            "is the state that was loaded of another scene or resolution?"});
  else if (doubtfulFrame_)
    warnings.push_back({"strain", doubtfulFrame_,
                        formatted("springs stretched by %.0f %%: raise simulation_steps", 100 * peakStrain_),
                        "a spring is stretched by " + formatted("%.0f %%", 100 * doubtfulStrain(scene)) +
                            " or more, in this run by up to " + formatted("%.0f %%", 100 * peakStrain_) +
                            "; " + stepsAdvice(scene) + ", or set solver.strain_limit"});
}

void print(const std::vector<Warning>& warnings, const std::string& which) {
  for (const Warning& warning : warnings) {
    std::cerr << "clothsim: warning: " << which;
    if (warning.frame) std::cerr << "frame " << *warning.frame << ": ";
    std::cerr << warning.text << '\n';
  }
}

void printLater(const std::vector<Warning>& warnings, const std::vector<Warning>& printed) {
  std::vector<Warning> later;
  std::ranges::copy_if(warnings, std::back_inserter(later), [&](const Warning& warning) {
    return std::ranges::find(printed, warning) == printed.end();
  });
  print(later);
}

nlohmann::ordered_json toJson(const std::vector<Warning>& warnings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Warning& warning : warnings) {
    const nlohmann::ordered_json frame =
        warning.frame ? nlohmann::ordered_json(*warning.frame) : nlohmann::ordered_json(nullptr);
    list.push_back({{"kind", warning.kind}, {"frame", frame}, {"text", warning.text}});
  }
  return list;
}

void checkStrict(bool strict, const std::vector<Warning>& warnings) {
  if (!strict || warnings.empty()) return;
  throw SimulationError("--strict: the run ended with " + std::to_string(warnings.size()) +
                        (warnings.size() == 1 ? " warning" : " warnings"));
}

}  // namespace clothsim

#include "measure/contact_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "measure/surface_crossings.h"
#include "solver/self_collision.h"
#include "solver/surface.h"

namespace clothsim {

namespace {

using Condition = ContactFailure::Condition;

nlohmann::ordered_json toJson(const std::optional<ContactFailure>& failure) {
  if (!failure) return nullptr;
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  const bool fast = failure->condition == Condition::fastStep,
             crosses = failure->condition == Condition::startCrossings;
  json["condition"] = fast ? "fast_step" : crosses ? "start_crossings" : "pairs_too_near";
  json["frame"] = failure->frame;
  if (fast) return json;
  json["pairs"] = failure->pairs;
  if (crosses) return json;
  json["distance"] = failure->distance;
  json["needed_distance"] = failure->neededDistance;
  return json;
}

}  // namespace

void ContactReport::add(int frame, const Cloth& cloth, const Scene& scene, const State& state, double strain,
                        const ContactCounts& counts) {
  last_ = measureContacts(cloth, scene, state, strain);
  lastFrame_ = frame;
  if (frame == 0) overlapsAtStart_ = last_.overlaps;
  if (frame == 0 && scene.solver.selfCollision == SelfCollision::contact) {
    overlapsAtStart_ = crossingSides(cloth, scene, state);
    if (overlapsAtStart_ > 0) failure_ = {Condition::startCrossings, 0, overlapsAtStart_, 0, 0};
  }
  isCut_ = isCut_ || !state.cuts.empty();
  // What was lost before a cut stays lost.
  if (!failure_ && !isCut_ && last_.overlaps > 0)
    failure_ = {Condition::pairsTooNear, frame, last_.overlaps, last_.smallestDistance.value_or(0),
                last_.neededDistance};
  else if (!failure_ && !isCut_ && counts.fastSteps > 0)
    failure_ = {Condition::fastStep, frame, 0, 0, 0};
  largestStrain_ = std::max(largestStrain_, strain);
  worst_.contacts = std::max(worst_.contacts, last_.contacts);
  worst_.overlaps = std::max(worst_.overlaps, last_.overlaps);
  worst_.relativeMotion = std::max(worst_.relativeMotion, last_.relativeMotion);
  worst_.neededDistance = std::max(worst_.neededDistance, last_.neededDistance);
  if (last_.smallestDistance)
    worst_.smallestDistance = std::min(worst_.smallestDistance.value_or(INFINITY), *last_.smallestDistance);
}

void ContactReport::write(nlohmann::ordered_json& json, const Cloth& cloth, const Scene& scene,
                          const ContactCounts& counts) const {
  json["self_collision"] = selfCollisionName(scene.solver.selfCollision);
  json["self_contacts"] = last_.contacts;
  if (const std::size_t small = smallColliders(scene, cloth); small > 0)
    json["small_colliders"] = {
        {"number", small}, {"passages", counts.passages}, {"steps_with_passages", counts.passageSteps}};
  if (scene.solver.selfCollision == SelfCollision::contact) {
    json["contact_sound"] = !failure_;
    if (isCut_ && !failure_) json["contact_sound"] = nullptr;
    nlohmann::ordered_json& contact = json["contact"] = nlohmann::ordered_json::object();
    contact["failed"] = toJson(failure_);
    contact["most_pairs"] = counts.pairs;
    contact["guarded_steps"] = counts.clampedSteps;
    contact["shortened_motions"] = counts.shortened;
    contact["crowded_steps"] = counts.crowdedSteps;
    contact["pin_lag"] = counts.pinLag;
    contact["largest_correction"] = counts.largestCorrection;
    if (counts.pairs > 0)
      contact["least_gap"] = counts.leastGap;
    else
      contact["least_gap"] = nullptr;
    return;
  }
  if (!collidesWithItself(scene, cloth)) {
    json["contact_sound"] = nullptr;
    return;
  }
  std::optional<ContactFailure> failure = failure_;
  if (!failure && !isCut_ && counts.fastSteps > 0) failure = {Condition::fastStep, lastFrame_, 0, 0, 0};
  json["contact_sound"] = !failure;
  if (isCut_ && !failure) json["contact_sound"] = nullptr;
  nlohmann::ordered_json& contact = json["contact"] = nlohmann::ordered_json::object();
  contact["failed"] = toJson(failure);
  contact["distance"] = contactDistance(scene, cloth);
  contact["needed_distance"] = worst_.neededDistance;
  if (worst_.smallestDistance)
    contact["smallest_distance"] = *worst_.smallestDistance;
  else
    contact["smallest_distance"] = nullptr;
  contact["largest_stretch"] = largestStrain_;
  contact["largest_relative_motion"] = worst_.relativeMotion;
  contact["most_overlaps"] = worst_.overlaps;
  contact["guarded_steps"] = counts.clampedSteps;
  contact["fast_steps"] = counts.fastSteps;
  contact["hash_builds"] = counts.hashBuilds;
}

}  // namespace clothsim

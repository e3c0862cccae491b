#include "app/contact_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "solver/self_collision.h"

namespace clothsim {

void ContactReport::add(const Cloth& cloth, const Scene& scene, const State& state, double stretch) {
  last_ = measureContacts(cloth, scene, state, stretch);
  if (!started_) overlapsAtStart_ = last_.overlaps;
  started_ = true;
  isCut_ = isCut_ || !state.cuts.empty();
  sound_ = sound_ && last_.overlaps == 0;
  stretch_ = std::max(stretch_, stretch);
  worst_.contacts = std::max(worst_.contacts, last_.contacts);
  worst_.overlaps = std::max(worst_.overlaps, last_.overlaps);
  worst_.relativeMotion = std::max(worst_.relativeMotion, last_.relativeMotion);
  worst_.neededDistance = std::max(worst_.neededDistance, last_.neededDistance);
  if (last_.smallestDistance)
    worst_.smallestDistance = std::min(worst_.smallestDistance.value_or(INFINITY), *last_.smallestDistance);
}

std::string ContactReport::remark(const Scene& scene) const {
  if (scene.solver.selfCollision != SelfCollision::averaged || worst_.contacts == 0) return "";
  return "the cloth touched itself, and self-collision \"averaged\", CS184's rule, lets fast cloth through; "
         "--set solver.self_collision=robust does not";
}

void ContactReport::write(nlohmann::ordered_json& json, const Cloth& cloth, const Scene& scene,
                          const ContactCounts& counts) const {
  json["self_collision"] = selfCollisionName(scene.solver.selfCollision);
  json["self_contacts"] = last_.contacts;
  if (!collidesWithItself(scene, cloth)) {
    json["contact_sound"] = nullptr;
    return;
  }
  json["contact_sound"] = sound_ && counts.fastSteps == 0;
  if (isCut_) json["contact_sound"] = nullptr;
  nlohmann::ordered_json& contact = json["contact"];
  contact["distance"] = contactDistance(scene, cloth);
  contact["needed_distance"] = worst_.neededDistance;
  if (worst_.smallestDistance)
    contact["smallest_distance"] = *worst_.smallestDistance;
  else
    contact["smallest_distance"] = nullptr;
  contact["largest_stretch"] = stretch_;
  contact["largest_relative_motion"] = worst_.relativeMotion;
  contact["most_overlaps"] = worst_.overlaps;
  contact["guarded_steps"] = counts.guardedSteps;
  contact["fast_steps"] = counts.fastSteps;
  contact["hash_builds"] = counts.hashBuilds;
}

}  // namespace clothsim

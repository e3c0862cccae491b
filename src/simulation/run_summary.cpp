#include "simulation/run_summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "solver/cpu/synchronized.h"

namespace clothsim {

void RunSummary::add(Simulation& simulation, int number) {
  const bool isFirst = frame < 0;
  frame = number;
  state = simulation.solver().state();
  measures = measure(simulation.cloth(), simulation.scene(), state);
  if (isFirst) watch.start(simulation.cloth(), simulation.scene(), state);
  if (isFirst && watchesEnergy) watch.watchEnergy(simulation.cloth(), simulation.scene(), state);
  watch.addEnergy(frame, simulation.cloth(), state, measures.kineticEnergy);
  watch.add(frame, simulation.cloth(), simulation.scene(), state, measures.maxStrain,
            simulation.contactCounts());
  convergence = simulation.convergenceCounts();
  watch.addConvergence(frame, convergence);
  peakStrain = std::max(peakStrain, measures.maxStrain);
  maxPenetration = std::max(maxPenetration, measures.maxPenetration);
}

void RunSummary::write(nlohmann::ordered_json& json, Simulation& simulation) const {
  const Cloth& cloth = simulation.cloth();
  const Scene& scene = simulation.scene();
  json["state_hash"] = hashText(stateHash(state));
  json["max_strain"] = measures.maxStrain;
  json["peak_strain"] = peakStrain;
  json["min_y"] = measures.minY;
  json["centroid"] = {measures.centroid.x, measures.centroid.y, measures.centroid.z};
  json["kinetic_energy"] = measure(cloth, scene, synchronized(cloth, scene, state)).kineticEnergy;
  json["max_penetration"] = maxPenetration;
  if (!scene.seams.empty()) json["seam_gap"] = measures.seamGap;
  json["start_overlaps"] = {{"colliders", watch.startInColliders().particles},  // particles,
                            {"self", watch.contacts().overlapsAtStart()}};      // pairs
  if (isImplicit(scene.solver.integrator) || convergence.steps > 0) {
    json["convergence"] = {{"steps", convergence.steps},
                           {"unconverged_steps", convergence.unconvergedSteps},
                           {"newton_steps", convergence.newtonSteps},
                           {"cg_iterations", convergence.iterations},
                           {"last_update", convergence.lastUpdate}};
    if (scene.solver.integrator == Integrator::bdf2)
      json["convergence"]["second_order_steps"] = convergence.secondOrderSteps;
  }
  json["finite"] = true;
  json["warnings"] = toJson(watch.warnings(scene));
  watch.contacts().write(json, cloth, scene, simulation.contactCounts());
}

}  // namespace clothsim

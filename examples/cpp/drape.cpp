// Drops a cotton sheet on a sphere, prints how low it hangs, and saves it for other programs.
#include <cstdio>
#include <iostream>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
#include "measure/measure.h"
#include "scene_io/scene_options.h"
#include "simulation/simulation.h"
using namespace clothsim;

int main(int argc, char** argv) try {
  beginResourceSearchAt(CLOTHSIM_RESOURCES);  // where the bundled scenes are
  const SceneOptions options{
      .scene = "sphere", .resolution = {{40, 40}}, .settings = {"cloth.material=cotton"}};
  Simulation simulation(readScene(options).scene);
  for (int frame = 0; frame < 60; ++frame) {
    simulation.stepFrame();
    if (const auto divergence = simulation.checkFrame())
      throw SimulationError(blowUpText(*divergence, simulation.cloth(), simulation.scene()));
  }
  const State state = simulation.state();
  const Measures measures = measure(simulation.cloth(), simulation.scene(), state);
  std::printf("after %.3f s: lowest point %.4f m, largest strain %.2f %%, state %s\n", simulation.time(),
              measures.minY, 100 * measures.maxStrain, hashText(stateHash(state)).c_str());
  if (argc > 1) saveState(state, simulation.cloth(), argv[1]);  // .obj, .ply, .csv, .glb, .npz or .state
} catch (const Error& error) {
  std::cerr << "drape: " << error.what() << '\n';
  return static_cast<int>(error.exitCode());
}

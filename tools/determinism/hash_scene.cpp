// What the CPU backend makes of a scene, as a hash: hash_scene FRAMES SCENE [KEY=VALUE...]
// Prints particles, steps and the hash of the last frame's state. Links no OpenGL, so that any compiler
// builds it from a few files (tools/validate determinism).
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "core/error.h"
#include "scene_io/scene_io.h"
#include "simulation/simulation.h"

using namespace clothsim;

int main(int count, char** words) {
  if (count < 3) {
    std::fprintf(stderr, "usage: hash_scene FRAMES SCENE [KEY=VALUE...]\n");
    return 2;
  }
  try {
    Scene scene = loadSceneByName(words[2]);
    for (int i = 3; i < count; ++i) setSceneValue(scene, words[i]);
    Simulation simulation(std::move(scene));
    const int frames = std::stoi(words[1]);
    simulation.stepFrames(frames);
    if (simulation.checkFrame())
      throw SimulationError("the scene blows up: its hash would be that of garbage");
    std::printf("%u %d %s\n", simulation.cloth().particleCount(),
                frames * simulation.scene().solver.simulationSteps,
                hashText(stateHash(simulation.state())).c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hash_scene: %s\n", error.what());
    return 1;
  }
}

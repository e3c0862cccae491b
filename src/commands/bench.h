// Timings for `clothsim bench` and `doctor`: the rate at which a backend steps a scene, and the largest demo
// that runs in real time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene/scene.h"
#include "solver/solver.h"

namespace clothsim {

struct StepRate {
  std::string backend, device;
  std::string points;  // of the first cloth: "64x64", or "4151" of a mesh
  std::size_t cloths = 1;
  bool limiter = false;
  SelfCollision selfCollision = SelfCollision::off;
  int repetitions = 0;  // number of timings, of which the median is taken
  double secondsPerStep = 0;
  double submitSecondsPerStep =
      0;  // until the calls of a step return; what is asked for may not be done then
  std::uint64_t dispatchesPerStep = 0;  // of compute shaders; 0 on the CPU
  double particleStepsPerSecond = 0;
  std::vector<PassTime> passes;  // seconds a step
  // On the CPU only:
  double bytesPerParticle = 0;       // that the solver has taken of memory; 0 where the system does not say
  double copiedBytesPerSecond = 0;   // roof of memory: of a loop over as many bytes
  double operationsPerSecond = 0;    // roof of arithmetic (solver/cpu/roof.h)
  double operationsPerParticle = 0;  // of springs, integration and strain limit; 0 for implicit steps
  [[nodiscard]] double memoryShare() const;      // of the roofs; contacts, wind and colliders are
  [[nodiscard]] double arithmeticShare() const;  // not counted
};

// Steps the scene for about `seconds` after a warm-up. It begins with `state`, or at the start where `state`
// is empty. The GPU needs a current context.
[[nodiscard]] StepRate measureStepRate(const Scene& scene, const std::string& backend, double seconds,
                                       const State& state = {});

struct DrawRate {
  std::string shader;
  Quality quality = Quality::final;
  double scale = 1;              // of the pixels that the scene is drawn in, where that adapts
  double seconds = 0;            // for a picture, as the viewer draws it
  double leastSeconds = 0;       // for the quickest one: others may use the cores, too
  double processorSeconds = 0;   // of all threads of this program, for a picture
  std::vector<DrawTime> passes;  // each timed on its own
};
// The median times of so many repetitions to draw a picture of the scene with `state` while the camera rests.
// Needs a current context.
[[nodiscard]] DrawRate measureDrawing(const Scene& scene, const State& state, Quality quality, int width,
                                      int height, int repetitions = 7);

struct DemoRate {
  int size = 0;                  // N of N x N
  double simulationSeconds = 0;  // wall time to simulate a 30th of a second
  double drawSeconds = 0;        // wall time to draw one picture
  [[nodiscard]] double perFrame() const { return simulationSeconds + drawSeconds; }
};
// Times the demo scene at size x size, drawn into width x height pixels. With 0 x 0 it is not drawn, which
// needs no context on the CPU.
[[nodiscard]] DemoRate measureDemo(int size, const std::string& backend, int width, int height);

// The largest N, a multiple of 16, at which the demo runs in real time at 30 frames a second. `size` is 0
// where even the smallest is too slow.
[[nodiscard]] DemoRate largestRealTimeDemo(const std::string& backend, int width, int height);

}  // namespace clothsim

// Measurements behind `clothsim bench` and `doctor`: how fast a backend steps a scene, and how large a demo
// it holds in real time.
#pragma once

#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene/scene.h"
#include "solver/solver.h"

namespace clothsim {

struct StepRate {
  std::string backend, device;
  int columns = 0, rows = 0;  // of each cloth
  std::size_t cloths = 1;
  bool limiter = false;
  SelfCollision selfCollision = SelfCollision::off;
  int repetitions = 0;  // timed stretches of steps; the median counts
  double secondsPerStep = 0;
  double particleStepsPerSecond = 0;
  std::vector<PassTime> passes;  // seconds a step
};

// Steps the scene for about `seconds`, after a warm-up, beginning with `state`, or at the start when it is
// empty. The GPU needs a current context.
[[nodiscard]] StepRate measureStepRate(const Scene& scene, const std::string& backend, double seconds,
                                       const State& state = {});

struct DrawRate {
  std::string shader;
  int samples = 0;               // of each pixel
  double seconds = 0;            // for a picture, as the viewer draws it
  std::vector<DrawTime> passes;  // each waited for
};
// Of a picture of the scene with `state`; medians. Needs a current context.
[[nodiscard]] DrawRate measureDrawing(const Scene& scene, const State& state, int samples, int width,
                                      int height);

struct DemoRate {
  int size = 0;                  // N of N x N
  double simulationSeconds = 0;  // wall time for one 30th of a second of the demo,
  double drawSeconds = 0;        // and for drawing one picture of it
  [[nodiscard]] double perFrame() const { return simulationSeconds + drawSeconds; }
};
// Of the demo scene at size x size, drawn into width x height pixels; 0 x 0: not drawn, which needs no
// context on the CPU.
[[nodiscard]] DemoRate measureDemo(int size, const std::string& backend, int width, int height);

// The largest N (a multiple of 16) at which the demo holds 30 frames a second in real time; `size` 0: none
// does.
[[nodiscard]] DemoRate largestRealTimeDemo(const std::string& backend, int width, int height);

}  // namespace clothsim

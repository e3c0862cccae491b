// What a picture costs the processor: draw_cost SCENE COLUMNSxROWS|- FRAMES QUALITY rests|orbits PICTURES
// [KEY=VALUE...] After so many frames it draws 1280 x 720 pixels, of the last two states by turns, with the
// camera at rest or a little farther around the scene each time, and prints the median of the milliseconds
// that all threads of the program took together. It also builds against older commits (tools/validate
// drawing).
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/context.h"
#include "gl/framebuffer.h"
#include "render/renderer.h"
#include "scene_io/scene_io.h"
#include "simulation/simulation.h"

using namespace clothsim;

namespace {

double milliseconds(Renderer& renderer, const gl::Buffer<Particle4>& positions, const Camera& camera,
                    const gl::Framebuffer& target) {
  const std::clock_t before = std::clock();
  renderer.draw(positions.name(), camera, 0, target.name(), 1280, 720);
  glFinish();
  return 1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double measured(char** words, int count) {
  Scene scene = loadSceneByName(words[1]);
  const std::string size = words[2];
  if (const std::size_t x = size.find('x'); x != std::string::npos)
    static_cast<void>(
        changeResolution(scene, std::stoi(size.substr(0, x)), std::stoi(size.substr(x + 1)), false));
  for (int i = 7; i < count; ++i) setSceneValue(scene, words[i]);
  const Quality quality = qualityNamed(words[4]).value();
  const bool orbits = std::string(words[5]) == "orbits";

  const gl::HeadlessContext context;
  Simulation simulation(scene, "cpu");
  simulation.stepFrames(std::stoi(words[3]));
  std::vector<gl::Buffer<Particle4>> positions;
  for (int k = 0; k < 2; ++k) {
    positions.emplace_back("positions", simulation.state().positions);
    simulation.stepFrame();
  }
  const bool software = gl::currentContextInfo().software;
  Renderer renderer(simulation.cloth(), simulation.scene(), withQuality({}, quality, software));
  const gl::Framebuffer target("picture", {.width = 1280, .height = 720, .color = GL_RGBA8});
  Camera camera(simulation.scene(), simulation.cloth());
  std::vector<double> times;
  for (int k = 0; k < 4 + std::stoi(words[6]); ++k) {  // the first ones compile shaders
    if (orbits) camera.orbit(0.002, 0);
    const double time = milliseconds(renderer, positions[static_cast<std::size_t>(k % 2)], camera, target);
    if (k >= 4) times.push_back(time);
  }
  return median(times);
}

}  // namespace

int main(int count, char** words) {
  if (count < 7) {
    std::fprintf(
        stderr,
        "usage: draw_cost SCENE COLUMNSxROWS|- FRAMES QUALITY rests|orbits PICTURES [KEY=VALUE...]\n");
    return 2;
  }
  try {
    std::printf("%.3f\n", measured(words, count));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_cost: %s\n", error.what());
    return 1;
  }
}

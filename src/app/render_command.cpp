#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>

#include "app/blow_up.h"
#include "app/commands.h"
#include "app/simulation.h"
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "export/export.h"
#include "gl/context.h"
#include "render/renderer.h"

namespace clothsim {
namespace {

constexpr double radians = std::numbers::pi / 180;  // in a degree

bool endsWith(const std::string& text, const std::string& end) { return text.ends_with(end); }

// One --out: a still of the last frame, numbered pictures, or a film.
class Output {
 public:
  Output(const std::string& name, const RenderCommandOptions& options, const Scene& scene)
      : name_(name), frames_(options.frames) {
    if (endsWith(name, ".mp4")) {
      // A film plays in real time: every so many frames that it stays at or below the rate asked for.
      every_ = std::max(
          1, static_cast<int>(std::ceil(scene.solver.framesPerSec / options.framesPerSecond - 1e-9)));
      video_ = std::make_unique<VideoWriter>(name, options.width, options.height,
                                             scene.solver.framesPerSec / every_);
    } else if (hasFrameNumber(name)) {
      every_ = options.every;
    } else {
      every_ = 0;
    }
  }

  [[nodiscard]] bool wants(int frame) const { return every_ > 0 ? frame % every_ == 0 : frame == frames_; }
  void add(const Image& image, int frame) {
    if (video_)
      video_->addFrame(image.rgb);
    else
      savePng(every_ > 0 ? numberedName(name_, frame) : name_, image.width, image.height, image.rgb);
  }
  void close() {
    if (video_) video_->close();
  }

 private:
  std::string name_;
  int frames_, every_ = 1;  // 0: only the last frame
  std::unique_ptr<VideoWriter> video_;
};

void checkOutputs(const RenderCommandOptions& options) {
  for (const std::string& out : options.outs) {
    if (!endsWith(out, ".png") && !endsWith(out, ".mp4"))
      throw UsageError("--out " + out +
                       ": expected a name ending in .png or .mp4, as still.png, frame_%04d.png, clip.mp4");
    if (endsWith(out, ".mp4") && (options.width % 2 != 0 || options.height % 2 != 0))
      throw UsageError("--out " + out + ": a film needs an even width and height, not " +
                       std::to_string(options.width) + "x" + std::to_string(options.height));
  }
  for (const std::string& out : options.outs) checkWritable(out);
}

}  // namespace

int renderCommand(const RenderCommandOptions& options) {
  checkOutputs(options);
  Scene scene = loadScene(options.scene);
  if (!options.shader.empty()) scene.render.shader = options.shader;
  const gl::HeadlessContext context;
  Simulation simulation(scene, options.backend);
  if (!options.from.empty()) simulation.solver().setState(loadState(options.from, simulation.cloth()));
  Renderer renderer(simulation.cloth(), scene, {options.sphereSegmentsAround, options.sphereSegmentsDown});
  Camera camera(scene, simulation.cloth());
  camera.orbit(options.view.right * radians, options.view.up * radians);

  std::vector<Output> outputs;
  for (const std::string& out : options.outs) outputs.emplace_back(out, options, scene);
  Progress progress("rendering", options.frames);
  for (int frame = 0; frame <= options.frames; ++frame) {
    stopIfInterrupted();
    if (frame > 0) simulation.stepFrame();
    if (const std::optional<Trouble> trouble = simulation.checkFrame())
      stopBlownUp(*trouble, simulation,
                  {options.scene, options.backend, frame, options.frames,
                   std::filesystem::path(options.outs.front()).parent_path()});
    if (std::any_of(outputs.begin(), outputs.end(),
                    [&](const Output& output) { return output.wants(frame); })) {
      const Image image = renderImage(renderer, simulation.positionsBuffer(), camera, simulation.time(),
                                      options.width, options.height);
      for (Output& output : outputs)
        if (output.wants(frame)) output.add(image, frame);
    }
    progress.update(frame);
  }
  for (Output& output : outputs) output.close();
  progress.finish();
  for (const std::string& out : options.outs) std::printf("%s\n", out.c_str());
  return 0;
}

}  // namespace clothsim

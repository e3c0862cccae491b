#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "commands/blow_up.h"
#include "commands/commands.h"
#include "commands/run_files.h"
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "export/export.h"
#include "gl/context.h"
#include "output/picture_output.h"
#include "simulation/gpu/simulation_renderer.h"
#include "simulation/gpu/solvers.h"
#include "simulation/run_summary.h"

namespace clothsim {
namespace {

PictureSettings settingsOf(const RenderCommandOptions& options) {
  return {options.frames, options.width,           options.height,
          options.every,  options.framesPerSecond, options.firstFrame};
}

void checkOutputs(const RenderCommandOptions& options) {
  for (const std::string& out : options.outs) {
    if (!isPicture(out))
      throw UsageError(
          "--out " + out +
          ": expected a name ending in .png, .mp4 or .webp, as still.png, frame_%04d.png, clip.mp4");
    checkFrameNumber("--out", out);
    checkPicture("--out", out, settingsOf(options));
  }
  const bool hasNumbers = std::ranges::any_of(options.outs, hasFrameNumber);
  if (options.every != 1 && !hasNumbers)
    throw UsageError("--every " + std::to_string(options.every) +
                     ": no picture is saved every so many frames; give --out a name as frame_%04d.png");
  if (options.firstFrame != 0 && !hasNumbers)
    throw UsageError("--first-frame " + std::to_string(options.firstFrame) +
                     ": no picture has the number of its frame; give --out a name as frame_%04d.png");
  for (const std::string& out : options.outs)
    checkWritable(numberedName(out, options.firstFrame + options.frames));
}

int exposuresOf(const RenderCommandOptions& options) {
  if (options.exposures > 0) return options.exposures;
  if (options.quality == "auto") return usualExposures(options.outs);
  return options.quality == "final" ? FINAL_EXPOSURES : 1;
}

// Films are complete with the pictures up to `frame`. Returns earlyEndText(), or why they could not be.
std::string finishEarly(std::vector<PictureOutput>& outputs, const std::vector<std::string>& names,
                        int frame) {
  if (frame < 0) return "";
  try {
    for (PictureOutput& output : outputs) output.close();
    return earlyEndText(names, frame);
  } catch (const Error& error) {
    return std::string("\nThe film could not be finished: ") + error.what();
  }
}

}  // namespace

int renderCommand(const RenderCommandOptions& options) {
  checkOutputs(options);
  Scene scene = loadScene(options.scene);
  if (!options.shader.empty()) scene.render.shader = options.shader;
  const gl::HeadlessContext context;
  Simulation simulation(scene, announcedBackend(options.backend), makeSolver);
  if (!options.from.empty()) continueFrom(options.from, simulation);
  const int exposures = exposuresOf(options);
  const RenderOptions drawing =
      withQuality({options.sphereSegmentsAround, options.sphereSegmentsDown},
                  qualityNamed(options.quality).value_or(Quality::final), gl::currentContextInfo().software);
  SimulationRenderer renderer(simulation, forExposures(drawing, exposures));
  Camera camera = pictureCamera(scene, simulation.cloth(), options.width, options.height);
  camera.orbit(options.view.right * radians, options.view.up * radians);
  camera.zoom(1 / options.view.zoom);

  std::vector<PictureOutput> outputs;
  for (const std::string& out : options.outs) outputs.emplace_back(out, settingsOf(options), scene);
  RunSummary summary;
  summary.watchesEnergy = options.from.empty();
  std::vector<Warning> atStart;
  Progress progress("rendering", options.frames);
  int lastFrame = -1;  // of which the pictures are there
  const auto renderFrame = [&](int frame) {
    stopIfInterrupted();
    if (frame > 0) simulation.stepFrame();
    if (const std::optional<Divergence> divergence = simulation.checkFrame())
      stopBlownUp(*divergence, simulation,
                  {options.scene, options.backend, frame, options.frames,
                   std::filesystem::path(options.outs.front()).parent_path(),
                   finishEarly(outputs, options.outs, frame - 1), nullptr});
    summary.add(simulation);
    if (frame == 0) print(atStart = summary.watch.warnings(scene));
    if (std::any_of(outputs.begin(), outputs.end(),
                    [&](const PictureOutput& output) { return output.wants(frame); })) {
      Progress exposing("exposing", exposures);
      const Image image = renderer.picture(camera, options.width, options.height, exposures, [&](int done) {
        stopIfInterrupted();
        exposing.update(done);
      });
      exposing.finish();
      for (PictureOutput& output : outputs)
        if (output.wants(frame)) output.add(image, frame);
    }
    progress.update(lastFrame = frame);
  };
  try {
    for (int frame = 0; frame <= options.frames; ++frame) renderFrame(frame);
  } catch (const Interrupted&) {
    if (lastFrame < 0) throw;
    stopInterrupted(lastFrame, options.frames, [&] { return finishEarly(outputs, options.outs, lastFrame); });
  }
  for (PictureOutput& output : outputs) output.close();
  progress.finish();
  for (const std::string& out : options.outs) std::printf("%s\n", out.c_str());
  const std::vector<Warning> warnings = summary.watch.warnings(scene);
  printLater(warnings, atStart);
  checkStrict(options.strict, warnings);
  return 0;
}

}  // namespace clothsim

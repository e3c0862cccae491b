#include "commands/saves.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"

namespace clothsim {

void checkSaves(const RunOptions& options) {
  for (const std::string& save : options.saves) {
    if (isSequence(save) && hasFrameNumber(save))
      throw UsageError("--save " + save +
                       ": a file of this kind holds all frames; leave the number out of its name");
    if (!isSequence(save) && !isPicture(save) && !canSaveStateAs(save))
      throw UsageError("--save " + save +
                       ": the extension is none of .csv, .ply, .obj, .state, .pc2, .usda, .png, .mp4");
  }
  for (const std::string& save : options.saves) {
    checkWritable(numberedName(save, options.frames.value_or(0)));
    if (isPointCache(save)) checkWritable(restMeshBeside(save));
  }
}

bool savesPictures(const RunOptions& options) {
  return std::any_of(options.saves.begin(), options.saves.end(), isPicture);
}

Saves::Saves(const RunOptions& options, const Simulation& simulation, int frames)
    : options_(options), frames_(frames) {
  const int every = options.every;
  pictureSettings_.frames = frames;
  pictureSettings_.every = every;
  for (const std::string& save : options.saves) {
    if (isSequence(save))
      sequences_.push_back(makeSequenceWriter(
          save, simulation.cloth(), {simulation.scene().solver.framesPerSec, every, frames / every * every}));
    if (isPicture(save)) pictures_.emplace_back(save, pictureSettings_, simulation.scene());
  }
}

void Saves::add(Simulation& simulation, std::uint64_t clothGeneration, const State& state, int frame) {
  const bool isDue = frame % options_.every == 0;
  for (const auto& sequence : sequences_)
    if (isDue) sequence->addFrame(state);
  for (const std::string& save : options_.saves) {
    if (isSequence(save) || isPicture(save)) continue;
    if (hasFrameNumber(save) ? isDue : frame == frames_)
      saveState(state, simulation.cloth(), numberedName(save, frame));
  }
  draw(simulation, clothGeneration, state, frame);
}

void Saves::draw(Simulation& simulation, std::uint64_t clothGeneration, const State& state, int frame) {
  const auto wants = [&](const PictureOutput& picture) { return picture.wants(frame); };
  if (std::none_of(pictures_.begin(), pictures_.end(), wants)) return;
  const Scene& scene = simulation.scene();
  if (!renderer_ || drawnCloth_ != clothGeneration) {
    renderer_.emplace(simulation.cloth(), scene, RenderOptions{});
    if (!camera_) camera_.emplace(scene, simulation.cloth());
    drawnCloth_ = clothGeneration;
  } else if (!options_.replay.empty()) {
    renderer_->configure(scene);  // hands may have changed it
  }
  if (!options_.replay.empty()) renderer_->setCuts(state.cuts);
  const Image image = renderImage(*renderer_, simulation.positionsBuffer(), *camera_, simulation.time(),
                                  pictureSettings_.width, pictureSettings_.height);
  for (PictureOutput& picture : pictures_)
    if (picture.wants(frame)) picture.add(image, frame);
}

void Saves::finish() {
  for (const auto& sequence : sequences_) sequence->close();
  for (PictureOutput& picture : pictures_) picture.close();
}

}  // namespace clothsim

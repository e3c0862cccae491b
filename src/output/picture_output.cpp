#include "output/picture_output.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "render/quality.h"

namespace clothsim {

bool isPicture(const std::string& name) { return name.ends_with(".png") || isFilm(name); }

int usualExposures(const std::vector<std::string>& names) {
  const bool areStills = std::all_of(names.begin(), names.end(), [](const std::string& name) {
    return name.ends_with(".png") && !hasFrameNumber(name);
  });
  return areStills ? FINAL_EXPOSURES : 1;
}

void checkPicture(const std::string& flag, const std::string& name, const PictureSettings& settings) {
  if (name.ends_with(".mp4") && (settings.width % 2 != 0 || settings.height % 2 != 0))
    throw UsageError(flag + " " + name + ": a film needs an even width and height, not " +
                     std::to_string(settings.width) + "x" + std::to_string(settings.height));
}

PictureOutput::PictureOutput(std::string name, const PictureSettings& settings, const Scene& scene)
    : name_(std::move(name)), frames_(settings.frames), first_(settings.first) {
  if (isFilm(name_)) {
    // A film plays in real time. Frames are left out to stay at or below the given rate.
    const double rate = scene.solver.framesPerSec;
    every_ = std::max(1, static_cast<int>(std::ceil(rate / settings.picturesPerSecond - 1e-9)));
    video_ = std::make_unique<VideoWriter>(name_, settings.width, settings.height, rate / every_);
  } else if (hasFrameNumber(name_)) {
    every_ = settings.every;
  }
}

void PictureOutput::add(const Image& image, int frame) {
  hasPictures_ = true;
  if (video_)
    video_->addFrame(image.rgb);
  else
    savePng(every_ > 0 ? numberedName(name_, first_ + frame) : name_, image.width, image.height, image.rgb);
}

void PictureOutput::close() {
  if (video_ && hasPictures_) video_->close();
}

}  // namespace clothsim

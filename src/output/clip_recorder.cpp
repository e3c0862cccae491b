#include "output/clip_recorder.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"
#include "output/numbered_files.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

constexpr int mostAtOnce = 8;  // limits the copies of a picture after the window has hung

int evenBelow(int size) { return std::max(2, size - size % 2); }

}  // namespace

ClipRecorder::ClipRecorder(const fs::path& folder, const std::string& stem, int width, int height)
    : width_(evenBelow(width)), height_(evenBelow(height)), path_(freeName(folder, stem, ".mp4")) {
  try {
    film_ = std::make_unique<VideoWriter>(path_, width_, height_, framesPerSecond);
  } catch (const InputOutputError&) {
    // Without ffmpeg pictures are saved, from which a film can be made elsewhere.
    path_ = freeName(folder, stem + "-frames", "");
    std::error_code failure;
    if (!fs::create_directory(path_, failure))
      throw InputOutputError(path_.string() + ": the folder cannot be made: " + failure.message());
  }
}

void ClipRecorder::add(double shown, const std::function<Image()>& takePicture) {
  due_ += shown;
  const int count = static_cast<int>(due_ * framesPerSecond + 1e-6);
  if (count == 0) return;
  due_ -= count / framesPerSecond;
  const Image image = takePicture();
  for (int i = 0; i < std::min(count, mostAtOnce); ++i) write(image);
}

void ClipRecorder::write(const Image& image) {
  if (film_)
    film_->addFrame(image.rgb);
  else
    savePng(path_ / numberedName("frame_%04d.png", pictures_), image.width, image.height, image.rgb);
  ++pictures_;
}

std::string ClipRecorder::finish() {
  if (film_) film_->close();
  return path_.string() +
         (film_ ? "" : ": " + std::to_string(pictures_) + " pictures (with ffmpeg installed: one MP4)");
}

}  // namespace clothsim

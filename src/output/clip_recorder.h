// Records a film of what the window shows, without its panels: an MP4, or numbered PNGs in a folder where
// ffmpeg is not installed. It plays at the speed of the simulation, however slow the machine was.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "export/export.h"
#include "render/image.h"

namespace clothsim {

class ClipRecorder {
 public:
  static constexpr double framesPerSecond = 30;

  // `stem` is the name without its extension, as "pinned2-gpu". @throws InputOutputError
  ClipRecorder(const std::filesystem::path& folder, const std::string& stem, int width, int height);

  // To be called when a picture has been shown for `shown` seconds. Adds it as often as a film at this rate
  // needs it. @throws InputOutputError
  void add(double shown, const std::function<Image()>& takePicture);

  // Ends the film and returns its path. @throws InputOutputError
  std::string finish();

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double seconds() const { return pictures_ / framesPerSecond; }

 private:
  void write(const Image& image);

  int width_, height_;  // even, as the format of films demands
  int pictures_ = 0;
  double due_ = 1 / framesPerSecond;  // so that the first picture is added at once [s]
  std::filesystem::path path_;        // of the film, or of the folder of pictures
  std::unique_ptr<VideoWriter> film_;
};

}  // namespace clothsim

// A film of what the window shows, without its panels: an MP4 where ffmpeg is installed, else numbered PNGs
// in a folder. It plays at the speed of the simulation, however slow the machine was.
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

  // `stem`: the name without its ending, as "pinned2-gpu". @throws InputOutputError
  ClipRecorder(const std::filesystem::path& folder, const std::string& stem, int width, int height);

  // `shown` seconds have been shown since the last call; takes as many pictures as are due, all the same one.
  // @throws InputOutputError
  void add(double shown, const std::function<Image()>& takePicture);

  // Ends the film; says where it is. @throws InputOutputError
  std::string finish();

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double seconds() const { return pictures_ / framesPerSecond; }

 private:
  void write(const Image& image);

  int width_, height_;  // even, as the film's format wants
  int pictures_ = 0;
  double due_ = 1 / framesPerSecond;  // the first picture is taken at once [s]
  std::filesystem::path path_;        // of the film, or of the folder of pictures
  std::unique_ptr<VideoWriter> film_;
};

}  // namespace clothsim

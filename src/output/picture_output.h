// Saves the pictures of a run: still.png gets the last frame, frame_%04d.png, clip.mp4 and clip.webp
// many.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "export/export.h"
#include "render/image.h"
#include "scene/scene.h"

namespace clothsim {

struct PictureSettings {
  int frames = 0;                  // of the run
  int width = 1280, height = 720;  // [pixels]
  int every = 1;                   // numbered pictures: every so many frames
  double picturesPerSecond = 30;   // of a film, at most
  int first = 0;                   // number of frame 0 in numbered names
};

// Whether the name ends in .png, .mp4 or .webp.
[[nodiscard]] bool isPicture(const std::string& name);

class PictureOutput {
 public:
  // @throws InputOutputError when a film cannot be started
  PictureOutput(std::string name, const PictureSettings& settings, const Scene& scene);

  [[nodiscard]] bool wants(int frame) const { return every_ > 0 ? frame % every_ == 0 : frame == frames_; }
  // @throws InputOutputError, as close() does
  void add(const Image& image, int frame);
  void close();  // A film is complete with the pictures that were added; there is none without any.

 private:
  std::string name_;
  int frames_, first_, every_ = 0;  // 0: only the last frame
  bool hasPictures_ = false;
  std::unique_ptr<VideoWriter> video_;
};

// Of how many exposures a picture is the mean where nobody says: FINAL_EXPOSURES where all are stills, 1 of
// many.
[[nodiscard]] int usualExposures(const std::vector<std::string>& names);

// To be called before long work; `flag` is named in messages. @throws UsageError for an .mp4 of an odd width
// or height
void checkPicture(const std::string& flag, const std::string& name, const PictureSettings& settings);

}  // namespace clothsim

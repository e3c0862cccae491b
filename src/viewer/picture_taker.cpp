#include "viewer/picture_taker.h"

#include "export/export.h"
#include "output/numbered_files.h"

namespace clothsim {

std::string PictureTaker::screenshot(OpenScene& open, int width, int height, int exposures) {
  const std::string stem =
      open.name() + "-" + open.backend() + "-" + std::to_string(open.session().frameSinceStart());
  const std::filesystem::path path = freeName(outputFolder(), stem, ".png");
  const Image image = open.picture(width, height, exposures);
  savePng(path, image.width, image.height, image.rgb);
  return "Saved " + path.string();
}

std::string PictureTaker::toggleClip(OpenScene& open, int width, int height) {
  if (!clip_) {
    clip_.emplace(outputFolder(), open.name() + "-" + open.backend(), width, height);
    shown(open, 0);  // a clip has a picture, however soon it ends
    return "Recording; Ctrl+R stops";
  }
  return endClip();
}

std::string PictureTaker::endClip() {
  if (!clip_) return "";
  ClipRecorder clip = std::move(*clip_);
  clip_.reset();
  return "Saved " + clip.finish();
}

void PictureTaker::shown(OpenScene& open, double seconds) {
  if (!clip_) return;
  try {
    clip_->add(seconds, [&] { return open.picture(clip_->width(), clip_->height()); });
  } catch (...) {
    clip_.reset();  // after a failed write the clip is given up
    throw;
  }
}

}  // namespace clothsim

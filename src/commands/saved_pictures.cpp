#include "commands/saved_pictures.h"

#include <algorithm>

#include "core/interrupt.h"
#include "gl/context.h"

namespace clothsim {

SavedPictures::SavedPictures(const RunOptions& options, const Scene& scene, int frames) {
  settings_.frames = frames;
  settings_.every = options.every;
  settings_.first = options.firstFrame;
  std::vector<std::string> names;
  for (const std::string& save : options.saves)
    if (isPicture(save)) {
      pictures_.emplace_back(save, settings_, scene);
      names.push_back(save);
    }
  exposures_ = usualExposures(names);
}

void SavedPictures::add(Simulation& simulation, int frame) {
  const auto wants = [&](const PictureOutput& picture) { return picture.wants(frame); };
  if (std::none_of(pictures_.begin(), pictures_.end(), wants)) return;
  if (!renderer_) {
    const RenderOptions drawing = withQuality({}, Quality::final, gl::currentContextInfo().software);
    renderer_.emplace(simulation, forExposures(drawing, exposures_));
    camera_.emplace(simulation.scene(), simulation.cloth());
  }
  const Image image = renderer_->picture(*camera_, settings_.width, settings_.height, exposures_,
                                         [](int) { stopIfInterrupted(); });
  for (PictureOutput& picture : pictures_)
    if (picture.wants(frame)) picture.add(image, frame);
}

void SavedPictures::finish() {
  for (PictureOutput& picture : pictures_) picture.close();
}

}  // namespace clothsim

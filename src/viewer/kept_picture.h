// The last picture of the scene, in a framebuffer of its own. While nothing in it has changed, as when a key
// opens a list over it during a long step, it is shown again instead of drawn, which takes a software
// renderer some twenty times as long.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "gl/framebuffer.h"
#include "render/springs_overlay.h"
#include "viewer/picture_places.h"

namespace clothsim {

// What a picture depends on, beside its quality.
struct PictureKey {
  glm::mat4 view{1}, projection{1};  // of the camera
  int width = 0, height = 0;         // [pixels]
  ViewOptions options{};
  const void* scene = nullptr;  // of the shared scene, which is constant
  double time = 0;              // [s]
  std::uint64_t version = 0;    // of the state: Simulation::version()
  friend bool operator==(const PictureKey&, const PictureKey&) = default;
};

// A picture that rests, as the mean of more and more exposures.
class RefinedPicture {
 public:
  // How many exposures it has; none of a picture of another key.
  [[nodiscard]] int exposuresOf(const PictureKey& key) {
    if (key_ != key) exposures_ = 0;
    key_ = key;
    return exposures_;
  }
  [[nodiscard]] int exposures() const { return exposures_; }
  void exposed(int most) { exposures_ = std::min(exposures_ + 1, most); }
  void forget() {
    key_.reset();
    exposures_ = 0;
  }

 private:
  std::optional<PictureKey> key_;
  int exposures_ = 0;
};

class KeptPicture {
 public:
  // Whether it is the picture of that key, drawn at that scale or a larger one.
  [[nodiscard]] bool isOf(const PictureKey& key, double scale) const {
    return key_ == key && scale_ >= scale;
  }
  // Whether it is seen from the same place, whatever the state: an answer to input that need not wait for the
  // next one.
  [[nodiscard]] bool looksLike(PictureKey key, double scale) const {
    if (!key_) return false;
    key.scene = key_->scene;
    key.time = key_->time;
    key.version = key_->version;
    return isOf(key, scale);
  }
  // The framebuffer to draw another one into, of that size [pixels], the top row first; then what has been
  // drawn.
  [[nodiscard]] const gl::Framebuffer& drawInto(int width, int height);
  void drawn(const PictureKey& key, double scale) {
    key_ = key;
    scale_ = scale;
  }
  // Copies it into the lower left of the window.
  void show() const { picture_.showColumns(0); }
  void forget() { key_.reset(); }

 private:
  gl::Framebuffer picture_;
  std::optional<PictureKey> key_;
  double scale_ = 0;
};

}  // namespace clothsim

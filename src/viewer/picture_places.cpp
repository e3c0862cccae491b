#include "viewer/picture_places.h"

namespace clothsim {
namespace {

glm::mat4 clipFromWorld(const PictureView& view) {
  return view.camera.projection(double{view.width} / double{view.height}) * view.camera.view();
}

}  // namespace

ViewRay rayThrough(const PictureView& view, glm::vec2 place) {
  const glm::vec4 far = glm::inverse(clipFromWorld(view)) *
                        glm::vec4(2 * place.x / view.width - 1, 1 - 2 * place.y / view.height, 0.5f, 1);
  const glm::vec3 eye = view.camera.eye();
  return {eye, glm::normalize(glm::vec3(far) / far.w - eye)};
}

std::optional<glm::vec2> placeInPicture(const PictureView& view, glm::vec3 point) {
  const glm::vec4 clip = clipFromWorld(view) * glm::vec4(point, 1);
  if (clip.w <= 0) return std::nullopt;
  return glm::vec2{(clip.x / clip.w + 1) / 2 * view.width, (1 - clip.y / clip.w) / 2 * view.height};
}

float pixelSizeAt(const PictureView& view, glm::vec3 point) {
  const float depth = (clipFromWorld(view) * glm::vec4(point, 1)).w;
  const float scale = view.camera.projection(double{view.width} / double{view.height})[1][1];
  return depth <= 0 ? 0 : 2 * depth / (scale * view.height);
}

}  // namespace clothsim

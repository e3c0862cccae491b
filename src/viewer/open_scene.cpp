#include "viewer/open_scene.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "scene_io/scene_io.h"
#include "simulation/gpu/solvers.h"

namespace clothsim {

OpenScene::OpenScene(const Shared<Scene>& scene, std::string source, const std::string& backend,
                     const RenderOptions& options)
    : source_(std::move(source)),
      loaded_(scene),
      session_(scene, backend, makeSolver),
      camera_(*scene, session_.simulation().cloth()),
      renderer_(session_.simulation(), options) {}

std::string OpenScene::name() const { return std::filesystem::path(source_).stem().string(); }

void OpenScene::edit(const Scene& scene, bool continues) {
  session_.act(EditScene{parseScene(formatScene(scene), name())}, continues);
  update();
}

SessionFacts OpenScene::facts() const {
  if (held_) return *held_;
  return {sharedScene(),
          session_.oldestFrame(),
          session_.frame(),
          session_.newestFrame(),
          session_.frameSinceStart(),
          session_.snapshotBytes(),
          session_.clothGeneration()};
}

void OpenScene::hold() {
  renderer_.hold();
  held_ = facts();
}

void OpenScene::release() {
  held_.reset();
  renderer_.release();
}

void OpenScene::update() {
  renderer_.update();
  const std::uint64_t generation = facts().clothGeneration;
  if (generation == shownCloth_ && view == shownView_) return;
  renderer_.renderer().setView(view);
  shownCloth_ = generation;
  shownView_ = view;
}

void OpenScene::frameFor(int width, int height, const CoveredEdges& covered) {
  const double aspect = static_cast<double>(width) / std::max(1, height);
  if (aspect == framedAspect_ && covered == framedBeside_) return;
  framedAspect_ = aspect;
  framedBeside_ = covered;
  camera_.setHome(Camera(*loaded_, session_.simulation().cloth(), aspect, covered));
}

void OpenScene::draw(GLuint target, int width, int height) { renderer_.draw(camera_, target, width, height); }

void OpenScene::refine(int exposures, int width, int height) {
  if (exposures < FINAL_EXPOSURES)
    renderer_.expose(exposures, FINAL_EXPOSURES, camera_, 0, width, height);
  else
    renderer_.renderer().showMean(0, width, height);
}

Image OpenScene::picture(int width, int height, int exposures) {
  renderer_.renderer().setScale(1);
  return renderer_.picture(camera_, width, height, exposures);
}

}  // namespace clothsim

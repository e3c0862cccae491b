#include "viewer/open_scene.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "scene_io/scene_io.h"

namespace clothsim {

OpenScene::OpenScene(const Scene& scene, std::string source, const std::string& backend,
                     const RenderOptions& options)
    : source_(std::move(source)),
      loaded_(scene),
      session_(scene, backend),
      camera_(scene, session_.simulation().cloth()),
      options_(options),
      renderer_(std::make_unique<Renderer>(session_.simulation().cloth(), scene, options)),
      shownCloth_(session_.clothGeneration()),
      shownScene_(scene) {}

std::string OpenScene::name() const { return std::filesystem::path(source_).stem().string(); }

void OpenScene::edit(const Scene& scene, bool continues) {
  session_.act(EditScene{parseScene(formatScene(scene), name())}, continues);
  update();
}

void OpenScene::update() {
  const Scene& now = scene();
  if (session_.clothGeneration() != shownCloth_) {
    renderer_ = std::make_unique<Renderer>(session_.simulation().cloth(), now, options_);
    shownCloth_ = session_.clothGeneration();
    shownScene_ = now;
    shownCuts_.clear();
    shownView_ = {};
  }
  if (now != shownScene_) {
    renderer_->configure(now);
    shownScene_ = now;
  }
  if (session_.cuts() != shownCuts_) {
    renderer_->setCuts(session_.cuts());
    shownCuts_ = session_.cuts();
  }
  if (view != shownView_) {
    renderer_->setView(view);
    shownView_ = view;
  }
}

void OpenScene::frameFor(int width, int height, const CoveredEdges& covered) {
  const double aspect = static_cast<double>(width) / std::max(1, height);
  if (aspect == framedAspect_ && covered == framedBeside_) return;
  framedAspect_ = aspect;
  framedBeside_ = covered;
  camera_.setHome(Camera(loaded_, session_.simulation().cloth(), aspect, covered));
}

void OpenScene::draw(int width, int height) {
  renderer_->draw(session_.simulation().positionsBuffer(), camera_, session_.simulation().time(), 0, width,
                  height);
}

Image OpenScene::picture(int width, int height) {
  return renderImage(*renderer_, session_.simulation().positionsBuffer(), camera_,
                     session_.simulation().time(), width, height);
}

}  // namespace clothsim

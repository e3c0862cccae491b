// The scene that the viewer has open: the session in which it is simulated, and the camera and renderer that
// show it, kept in step with each other.
#pragma once

#include <memory>
#include <string>

#include "render/camera.h"
#include "render/renderer.h"
#include "session/session.h"

namespace clothsim {

class OpenScene {
 public:
  // `source`: as -f was given. @throws SceneError, UsageError, OpenGlError
  OpenScene(const Scene& scene, std::string source, const std::string& backend, const RenderOptions& options);

  [[nodiscard]] Session& session() { return session_; }
  [[nodiscard]] const Session& session() const { return session_; }
  [[nodiscard]] Camera& camera() { return camera_; }
  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] Renderer& renderer() { return *renderer_; }
  [[nodiscard]] const Scene& scene() const { return session_.simulation().scene(); }
  [[nodiscard]] const Scene& loaded() const { return loaded_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] std::string name() const;  // "pinned2", also for "my/scenes/pinned2.json"
  [[nodiscard]] std::string backend() const { return session_.simulation().solver().backend(); }
  [[nodiscard]] double frameSeconds() const { return 1 / scene().solver.framesPerSec; }

  ViewOptions view{.showPins = true};

  // The scene with other parameters, checked as a file would be. `continues`: see Session::act.
  // @throws SceneError for what no scene may say; nothing has changed then
  void edit(const Scene& scene, bool continues);

  // Makes the renderer show the session's scene, cloth and cuts as they are now. @throws as the constructor
  void update();
  // Frames the scene for pictures of that shape, of which `covered` is hidden; a camera that was moved stays
  // where it is.
  void frameFor(int width, int height, const CoveredEdges& covered);
  void draw(int width, int height);  // into the window's lower left
  [[nodiscard]] Image picture(int width, int height);

 private:
  std::string source_;
  Scene loaded_;
  Session session_;
  Camera camera_;
  RenderOptions options_;
  std::unique_ptr<Renderer> renderer_;
  double framedAspect_ = 0;
  CoveredEdges framedBeside_;
  // What the renderer shows.
  std::uint64_t shownCloth_ = 0;
  Scene shownScene_;
  Cuts shownCuts_;
  ViewOptions shownView_;
};

}  // namespace clothsim

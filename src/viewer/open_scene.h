// The scene that the viewer has open: the session in which it is simulated, and the camera and renderer that
// show it, kept in step with each other.
#pragma once

#include <string>

#include "render/camera.h"
#include "session/session.h"
#include "simulation/gpu/simulation_renderer.h"

namespace clothsim {

class OpenScene {
 public:
  // `source`: as -f was given. @throws SceneError, UsageError, OpenGlError
  OpenScene(const Shared<Scene>& scene, std::string source, const std::string& backend,
            const RenderOptions& options);

  [[nodiscard]] Session& session() { return session_; }
  [[nodiscard]] const Session& session() const { return session_; }
  [[nodiscard]] Camera& camera() { return camera_; }
  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] SimulationRenderer& renderer() { return renderer_; }
  [[nodiscard]] const Scene& scene() const { return session_.simulation().scene(); }
  [[nodiscard]] const Shared<Scene>& sharedScene() const { return session_.simulation().sharedScene(); }
  [[nodiscard]] const Shared<Scene>& loaded() const { return loaded_; }
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
  Shared<Scene> loaded_;
  Session session_;
  Camera camera_;
  SimulationRenderer renderer_;
  ViewOptions shownView_;  // by the renderer of the cloth of that generation
  std::uint64_t shownCloth_ = 0;
  double framedAspect_ = 0;
  CoveredEdges framedBeside_;
};

}  // namespace clothsim

// The scene that is open in the viewer: the session that simulates it, and the camera and the renderer that
// show it.
#pragma once

#include <optional>
#include <string>

#include "render/camera.h"
#include "session/session.h"
#include "simulation/gpu/simulation_renderer.h"

namespace clothsim {

// What the window shows of a session besides its cloth. Frames are counted as Session does.
struct SessionFacts {
  Shared<Scene> scene;
  int oldestFrame = 0, frame = 0, newestFrame = 0, frameSinceStart = 0;
  std::size_t snapshotBytes = 0;
  std::uint64_t clothGeneration = 0;
};

class OpenScene {
 public:
  // `source` is the argument of -f. @throws SceneError, UsageError, OpenGlError
  OpenScene(const Shared<Scene>& scene, std::string source, const std::string& backend,
            const RenderOptions& options);

  [[nodiscard]] Session& session() { return session_; }
  [[nodiscard]] const Session& session() const { return session_; }
  [[nodiscard]] Camera& camera() { return camera_; }
  [[nodiscard]] const Camera& camera() const { return camera_; }
  [[nodiscard]] SimulationRenderer& renderer() { return renderer_; }
  [[nodiscard]] const Scene& scene() const { return *sharedScene(); }
  [[nodiscard]] const Shared<Scene>& sharedScene() const {
    return held_ ? held_->scene : session_.simulation().sharedScene();
  }
  [[nodiscard]] const Cloth& cloth() const { return session_.simulation().cloth(); }
  [[nodiscard]] double time() const { return renderer_.time(); }
  [[nodiscard]] SessionFacts facts() const;
  [[nodiscard]] const Shared<Scene>& loaded() const { return loaded_; }
  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] std::string name() const;  // "pinned2", also for "my/scenes/pinned2.json"
  [[nodiscard]] std::string backend() const { return session_.simulation().solver().backend(); }
  [[nodiscard]] double frameSeconds() const { return 1 / scene().solver.framesPerSec; }

  // From now until release() another thread may step the session, which the CPU backend simulates. What is
  // above, apart from session() itself, and drawing tell of the state as it is now.
  void hold();
  void release();

  ViewOptions view{.showPins = true};

  // Changes the scene, which is checked as one from a file. `continues` as in Session::act. @throws
  // SceneError for an invalid scene; then nothing has changed
  void edit(const Scene& scene, bool continues);

  // Takes over the scene, cloth and cuts of the session into the picture. @throws as the constructor
  void update();
  // Frames the scene for pictures of that size of which `covered` is hidden. A camera that the user has moved
  // stays.
  void frameFor(int width, int height, const CoveredEdges& covered);
  // Into the lower left of a framebuffer, 0: of the window; or over the last picture of one that keeps it.
  void draw(GLuint target, int width, int height);
  void drawOver(const gl::Framebuffer& target) { renderer_.drawOver(camera_, target); }
  // Into the window, in final quality, of what rests: one exposure more than the `exposures` that it has, all
  // of them FINAL_EXPOSURES.
  void refine(int exposures, int width, int height);
  [[nodiscard]] Image picture(int width, int height, int exposures = 1);

 private:
  std::string source_;
  Shared<Scene> loaded_;
  Session session_;
  Camera camera_;
  SimulationRenderer renderer_;
  std::optional<SessionFacts> held_;
  ViewOptions shownView_;  // that the renderer has, for the cloth of this generation
  std::uint64_t shownCloth_ = 0;
  double framedAspect_ = 0;
  CoveredEdges framedBeside_;
};

}  // namespace clothsim

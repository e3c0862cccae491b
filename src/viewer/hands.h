// What the mouse does to the cloth: grab, move colliders, pin, cut and blow; and the camera where it reaches
// for nothing. Everything done to the simulation goes through the session, so that it is recorded.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/camera.h"
#include "session/session.h"
#include "simulation/gpu/simulation_renderer.h"
#include "viewer/viewer_window.h"

namespace clothsim {

// What the hands reach into: the scene as it is shown in a picture of that size [pixels].
struct Reach {
  Session& session;
  SimulationRenderer& renderer;
  Camera& camera;
  int width, height;
  bool paused;
};

// What to draw over the picture, in pixels from its top left.
struct HandMarks {
  std::optional<glm::vec2> hand;    // it pulls from here
  std::optional<glm::vec2> held;    // at the particle here
  std::optional<glm::vec2> nozzle;  // it blows from here
  float nozzleRadius = 0;
  std::vector<glm::vec2> stroke;  // of the knife
};

class Hands {
 public:
  struct Modifiers {
    bool control = false, shift = false, cuts = false;
  };
  // Each returns a sentence for the user, "" for nothing to say.
  std::string press(const Reach& reach, ViewerWindow::Button button, ViewerWindow::Cursor cursor,
                    Modifiers held);
  void move(const Reach& reach, ViewerWindow::Cursor cursor);
  void release(const Reach& reach, ViewerWindow::Button button);
  void scroll(const Reach& reach, double steps, ViewerWindow::Cursor cursor);

  // Before frames are simulated: hands, colliders and the jet go where the mouse is now.
  void beforeStep(const Reach& reach, ViewerWindow::Cursor cursor, bool blows);
  // Lets go of everything, as before another scene is opened or the past is looked at.
  void letGo(Session& session);

  [[nodiscard]] HandMarks marks(const Reach& reach, ViewerWindow::Cursor cursor) const;
  [[nodiscard]] bool isBusy() const { return doing_ != Doing::nothing || blowing_; }

 private:
  enum class Doing { nothing, orbit, pan, grab, moveCollider, cut };

  void grab(const Reach& reach, const Pick& pick);
  std::string pin(const Reach& reach, const Pick& pick, ViewerWindow::Cursor cursor);
  void cutTo(const Reach& reach, ViewerWindow::Cursor cursor);
  void cutFromTo(const Reach& reach, const Pick& from, const Pick& to);
  [[nodiscard]] Vec3d targetAt(const Reach& reach, ViewerWindow::Cursor cursor) const;

  Doing doing_ = Doing::nothing;
  ViewerWindow::Button button_ = ViewerWindow::Button::left;
  ViewerWindow::Cursor last_;
  // Of what is held: a plane across the view, and from there to the collider's own place.
  glm::vec3 heldPoint_{0}, planeNormal_{0, 0, 1};
  Vec3d offset_;
  std::size_t collider_ = 0;
  std::uint32_t held_ = 0;
  bool targetMoved_ = false, dragGoesOn_ = false;
  Pick lastCut_;
  std::vector<glm::vec2> stroke_;
  bool blowing_ = false;
  std::optional<Blow> blow_;
};

// A place of the picture [pixels from the top left] as a ray: from the eye, unit direction.
struct ViewRay {
  glm::vec3 origin, direction;
};
[[nodiscard]] ViewRay rayThrough(const Camera& camera, int width, int height, ViewerWindow::Cursor cursor);
// And back: where a point of the world is in the picture; none behind the eye.
[[nodiscard]] std::optional<glm::vec2> placeInPicture(const Camera& camera, int width, int height,
                                                      glm::vec3 point);

}  // namespace clothsim

// What the mouse does: it grabs the cloth, moves colliders, pins, cuts and blows, and moves the camera where
// nothing lies under it. Everything that changes the simulation goes through the session, which records it.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/open_scene.h"
#include "viewer/viewer_window.h"

namespace clothsim {

// The scene under the mouse, shown in a picture of that size [pixels].
struct MouseContext {
  OpenScene& open;
  SimulationRenderer& renderer;
  Camera& camera;
  int width, height;
  bool paused;
  // Session::act(), now or at the end of the frame that is being simulated.
  std::function<void(const Action& action, bool continues)> act;
};

// What to draw over the picture, in pixels from its top left.
struct MouseMarks {
  std::optional<glm::vec2> goal;     // of the grab
  std::optional<glm::vec2> grabbed;  // the particle that is pulled
  std::optional<glm::vec2> nozzle;   // of the jet of air
  float nozzleRadius = 0;
  std::vector<glm::vec2> stroke;  // of a cut
};

// Of the hand's spring [1/s^2]: the cloth follows in an eighth of a second. One of 1e4 that holds the demo's
// sheet while its ball spins overcomes strain limit and contact.
inline constexpr double HAND_STRENGTH = 1600;

class MouseTools {
 public:
  struct Modifiers {
    bool control = false, shift = false, cuts = false;
  };
  // Returns a message for the user, "" for none.
  std::string press(const MouseContext& context, ViewerWindow::Button button, ViewerWindow::Cursor cursor,
                    Modifiers held);
  void move(const MouseContext& context, ViewerWindow::Cursor cursor);
  void release(const MouseContext& context, ViewerWindow::Button button);
  void scroll(const MouseContext& context, double steps, ViewerWindow::Cursor cursor);

  // To be called before frames are simulated, with the session at hand. Moves what is grabbed and the jet to
  // where the mouse is now.
  void beforeStep(const MouseContext& context, ViewerWindow::Cursor cursor, bool blows);
  // Ends the grab and the jet, before another scene is opened or an earlier frame is shown.
  void letGo(Session& session);

  [[nodiscard]] MouseMarks marks(const MouseContext& context, ViewerWindow::Cursor cursor) const;
  [[nodiscard]] bool isBusy() const { return doing_ != Doing::nothing || blowing_; }

 private:
  enum class Doing { nothing, orbit, pan, grab, moveCollider, cut };

  void grab(const MouseContext& context, const Pick& pick);
  std::string pin(const MouseContext& context, const Pick& pick, ViewerWindow::Cursor cursor);
  void cutTo(const MouseContext& context, ViewerWindow::Cursor cursor);
  void cutFromTo(const MouseContext& context, const Pick& from, const Pick& to);
  [[nodiscard]] Vec3d targetAt(const MouseContext& context, ViewerWindow::Cursor cursor) const;

  Doing doing_ = Doing::nothing;
  ViewerWindow::Button button_ = ViewerWindow::Button::left;
  ViewerWindow::Cursor last_;
  // What is dragged moves in the plane through heldPoint_; offset_ leads from there to the collider's origin.
  glm::vec3 grabbedPoint_{0}, planeNormal_{0, 0, 1};
  Vec3d offset_;
  std::size_t collider_ = 0;
  std::uint32_t grabbed_ = 0;
  bool targetMoved_ = false, dragGoesOn_ = false;
  Pick lastCut_;
  std::vector<glm::vec2> stroke_;
  bool blowing_ = false;
  std::optional<Blow> blow_;
};

// The ray from the eye through a place of the picture [pixels from the top left]; its direction has length 1.
struct ViewRay {
  glm::vec3 origin, direction;
};
[[nodiscard]] ViewRay rayThrough(const Camera& camera, int width, int height, ViewerWindow::Cursor cursor);
// The place of a point of the world in the picture [pixels from the top left]; none behind the eye.
[[nodiscard]] std::optional<glm::vec2> placeInPicture(const Camera& camera, int width, int height,
                                                      glm::vec3 point);

}  // namespace clothsim

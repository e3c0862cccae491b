// What the mouse does: it grabs the cloth, moves and turns solids and pins, pins, cuts and blows, and moves
// the camera where nothing lies under it. Everything that changes the simulation goes through the session,
// which records it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/chosen.h"
#include "viewer/mouse_context.h"
#include "viewer/viewer_window.h"

namespace clothsim {

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
  // `control`: the handles of a gizmo move in steps.
  void move(const MouseContext& context, ViewerWindow::Cursor cursor, bool control);
  void release(const MouseContext& context, ViewerWindow::Button button);
  void scroll(const MouseContext& context, double steps, ViewerWindow::Cursor cursor);

  // To be called before frames are simulated, with the session at hand. Moves what is grabbed and the jet to
  // where the mouse is now.
  void beforeStep(const MouseContext& context, ViewerWindow::Cursor cursor, bool blows);
  // Moves what was chosen to where the mouse has taken it. To be called when it is let go, too, before what
  // the user asks for next, as saving the scene.
  void moveChosen(const MouseContext& context);
  // Ends the grab and the jet, before another scene is opened or an earlier frame is shown.
  void letGo(Session& session);

  [[nodiscard]] MouseMarks marks(const MouseContext& context, ViewerWindow::Cursor cursor) const;
  [[nodiscard]] bool isBusy() const { return doing_ != Doing::nothing || blowing_; }
  [[nodiscard]] Chosen& chosen() { return chosen_; }
  [[nodiscard]] const Chosen& chosen() const { return chosen_; }

 private:
  enum class Doing { nothing, orbit, pan, grab, moveChosen, cut };

  void grab(const MouseContext& context, const Pick& pick);
  // Takes hold of pins under the cursor that can be moved.
  bool takePins(const MouseContext& context, ViewerWindow::Cursor cursor);
  void endClick(const MouseContext& context);
  std::string pin(const MouseContext& context, const Pick& pick, ViewerWindow::Cursor cursor);
  void cutTo(const MouseContext& context, ViewerWindow::Cursor cursor);
  void cutFromTo(const MouseContext& context, const Pick& from, const Pick& to);
  [[nodiscard]] Vec3d targetAt(const MouseContext& context, ViewerWindow::Cursor cursor) const;

  Doing doing_ = Doing::nothing;
  ViewerWindow::Button button_ = ViewerWindow::Button::left;
  ViewerWindow::Cursor last_;
  // The hand moves in the plane through grabbedPoint_.
  glm::vec3 grabbedPoint_{0}, planeNormal_{0, 0, 1};
  std::uint32_t grabbed_ = 0;
  bool targetMoved_ = false;
  Chosen chosen_;
  bool hasOrbited_ = false, wasChosen_ = false;  // since the press; what is pressed, before it
  bool isLetGo_ = false;                         // the drag ends once it is applied
  Pick lastCut_;
  std::vector<glm::vec2> stroke_;
  bool blowing_ = false;
  std::optional<Blow> blow_;
};

}  // namespace clothsim

// What is chosen in the picture, a solid or pins, and how it is moved and turned: by the handles of its
// gizmo, or by taking hold of it. While the simulation runs a solid goes to its new place within a frame, and
// cloth rubs on it; while it is paused that is an edit of the scene, which can be undone. Pins are always
// moved by an edit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "session/moved_pins.h"
#include "viewer/gizmo.h"
#include "viewer/mouse_context.h"

namespace clothsim {

class Chosen {
 public:
  GizmoMode mode = GizmoMode::move;

  void chooseSolid(std::size_t collider) { what_ = Solid{collider}; }
  void choosePins(PinGroup group) { what_ = std::move(group); }
  // The first solid that is no plane, else the first pins. Returns whether there is one.
  bool chooseFirst(const MouseContext& context);
  void chooseNothing();

  [[nodiscard]] std::optional<std::size_t> solid() const {
    const auto* solid = std::get_if<Solid>(&what_);
    return solid == nullptr ? std::nullopt : std::optional(solid->collider);
  }
  [[nodiscard]] bool isPins(const PinGroup& group) const { return what_ == What(group); }
  // Its gizmo; none where nothing is chosen, or where the scene no longer has it.
  [[nodiscard]] std::optional<Gizmo> gizmo(const MouseContext& context) const;

  // Takes the handle under the cursor. Returns whether there is one.
  bool pressHandle(const MouseContext& context, glm::vec2 cursor);
  // Takes hold of what is chosen at a point of it [m], to move it across the view.
  void takeHold(const MouseContext& context, glm::vec3 point, glm::vec2 cursor);
  void moveTo(const MouseContext& context, glm::vec2 cursor, bool snaps);
  void letGo();
  [[nodiscard]] bool isDragged() const { return drag_.has_value(); }
  [[nodiscard]] bool hasMoved() const { return hasMoved_; }  // in the drag that goes on, or was the last

  // Does what the drag has come to. To be called with the session at hand. @throws SceneError where the pins
  // cannot be moved; then the drag has ended
  void apply(const MouseContext& context);

  // `cursor`: none where it is not over the picture.
  void draw(const MouseContext& context, std::optional<glm::vec2> cursor) const;

 private:
  struct Solid {
    std::size_t collider = 0;
    friend bool operator==(const Solid&, const Solid&) = default;
  };
  using What = std::variant<std::monostate, Solid, PinGroup>;

  [[nodiscard]] std::optional<Vec3d> place(const MouseContext& context) const;
  void applyToSolid(const MouseContext& context, std::size_t collider, const Matrix3* turn);
  void applyToPins(const MouseContext& context, const PinGroup& group, const Matrix3& turn);

  What what_;
  std::optional<GizmoDrag> drag_;
  bool byHandle_ = false;
  Vec3d start_;             // of the place when the drag began [m]
  Vec3d appliedWay_;        // [m]
  double appliedTurn_ = 0;  // [degrees]
  bool isNew_ = false;      // the drag has come to something that is not applied
  bool hasMoved_ = false, goesOn_ = false;
};

}  // namespace clothsim

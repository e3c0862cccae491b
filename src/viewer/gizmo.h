// The handles about what is chosen in the picture: arrows and squares that move it along an axis or a plane
// of the world, or rings that turn it about an axis.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/picture_places.h"

namespace clothsim {

enum class GizmoMode { move, rotate };

struct GizmoHandle {
  // arrow: along the axis. square: in the plane across it. ring: about it. center and rim: the same as square
  // and ring for the axis that points to the eye, whose `axis` means nothing.
  enum class Kind { arrow, square, center, ring, rim };
  Kind kind = Kind::center;
  int axis = 0;  // x, y, z
  friend bool operator==(const GizmoHandle&, const GizmoHandle&) = default;
};

struct Gizmo {
  GizmoMode mode = GizmoMode::move;
  glm::vec3 place{0};  // of its centre, in the world [m]
};

// The nearest handle within reach of a place of the picture [pixels from the top left]. `em`: the height of a
// line of text [pixels], by which handles are as large in every picture.
[[nodiscard]] std::optional<GizmoHandle> handleAt(const Gizmo& gizmo, const PictureView& view, float em,
                                                  glm::vec2 place);
// Where one can take hold of a handle: of a ring at its point nearest to the eye. None where it is hidden,
// since it is seen edge-on or from its end.
[[nodiscard]] std::optional<glm::vec2> gripOf(const GizmoHandle& handle, const Gizmo& gizmo,
                                              const PictureView& view, float em);

// A handle that is being dragged.
class GizmoDrag {
 public:
  GizmoDrag(const Gizmo& gizmo, const GizmoHandle& handle, const PictureView& view, float em,
            glm::vec2 cursor);

  // Takes the cursor into account. `snaps`: in whole steps, of 5 cm or 15 degrees.
  void moveTo(const PictureView& view, glm::vec2 cursor, bool snaps);

  // Since it began: the way [m], and the turn about axis() [degrees], any number of times round.
  [[nodiscard]] Vec3d way() const { return way_; }
  [[nodiscard]] double turn() const { return turn_; }
  [[nodiscard]] Vec3d axis() const { return toVec3d(axis_); }
  [[nodiscard]] const GizmoHandle& handle() const { return handle_; }
  [[nodiscard]] const Gizmo& start() const { return start_; }
  // From the centre to where the ring was taken, of length 1; of arrows without meaning.
  [[nodiscard]] glm::vec3 grip() const { return grip_; }
  [[nodiscard]] std::string text() const;  // "x +0.120 m", "y -30.0°"

 private:
  [[nodiscard]] glm::vec3 onPlane(const PictureView& view, glm::vec2 cursor) const;
  [[nodiscard]] float alongAxis(const PictureView& view, glm::vec2 cursor) const;

  Gizmo start_;
  GizmoHandle handle_;
  glm::vec3 axis_, grip_{1, 0, 0}, from_{0};
  glm::vec2 fromCursor_, tangent_{0};  // of a ring seen edge-on, which turns by the way along it
  float fromAlong_ = 0, radius_ = 1;   // [m], [pixels]
  bool isEdgeOn_ = false;
  Vec3d way_;
  double turn_ = 0, wholeTurn_ = 0;  // as shown, and without steps
};

// To be called between UiFrame::begin() and end(). `lit` is the handle under the cursor; while one is
// dragged, it alone is drawn, with how far.
void drawGizmo(const Gizmo& gizmo, const PictureView& view, std::optional<GizmoHandle> lit,
               const std::optional<GizmoDrag>& drag);

// Rings around what is chosen, where that is several places [m].
void drawChosenPlaces(const std::vector<Vec3d>& places, const PictureView& view);

// The two buttons in the picture that choose what a gizmo does, under the axes of its corner.
[[nodiscard]] std::optional<GizmoMode> gizmoButtonAt(float pictureWidth, float em, glm::vec2 place);
// `on`: the gizmo that is shown. `cursor` gets a tip.
void drawGizmoButtons(float pictureWidth, std::optional<GizmoMode> on, glm::vec2 cursor);

}  // namespace clothsim

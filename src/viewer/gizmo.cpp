#include "viewer/gizmo.h"

#include <algorithm>
#include <cmath>

#include "core/formatted.h"
#include "viewer/gizmo_shapes.h"

namespace clothsim {

using namespace gizmo;

namespace {

constexpr float handleReach = 0.5f;  // [em]
constexpr float edgeOn = 0.25f;      // cosine below which a ring is turned along its line in the picture
constexpr double wayStep = 0.05, turnStep = 15;  // [m], [degrees]

float distanceToLine(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
  const glm::vec2 along = b - a;
  const float square = glm::dot(along, along);
  const float t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0f, 1.0f) : 0.0f;
  return glm::distance(p, a + t * along);
}

}  // namespace

std::optional<glm::vec2> gripOf(const GizmoHandle& handle, const Gizmo& gizmo, const PictureView& view,
                                float em) {
  if (isHidden(handle, gizmo, view)) return std::nullopt;
  const float emSize = em * pixelSizeAt(view, gizmo.place);
  switch (handle.kind) {
    case Kind::arrow:
      return placeInPicture(view, gizmo.place + arrowLength * emSize * unit(handle.axis));
    case Kind::square: {
      const auto corners = squareOf(handle.axis, gizmo, emSize);
      return placeInPicture(view, 0.5f * (corners[0] + corners[2]));
    }
    case Kind::center:
      return placeInPicture(view, gizmo.place);
    case Kind::ring: {
      const glm::vec3 eye = toEye(gizmo, view), axis = unit(handle.axis);
      const glm::vec3 out = eye - glm::dot(eye, axis) * axis;
      if (glm::length(out) < 1e-3f) return std::nullopt;  // every point is as near as the others
      return placeInPicture(view, gizmo.place + ringRadius * emSize * glm::normalize(out));
    }
    case Kind::rim:
      if (const auto middle = placeInPicture(view, gizmo.place))
        return *middle + glm::vec2(rimRadius * em, 0);
  }
  return std::nullopt;
}

std::optional<GizmoHandle> handleAt(const Gizmo& gizmo, const PictureView& view, float em, glm::vec2 place) {
  const std::optional<glm::vec2> middle = placeInPicture(view, gizmo.place);
  if (!middle) return std::nullopt;
  const float emSize = em * pixelSizeAt(view, gizmo.place);
  std::optional<GizmoHandle> nearest;
  float best = handleReach * em;
  const auto offer = [&](GizmoHandle handle, float distance) {
    if (distance >= best) return;
    best = distance;
    nearest = handle;
  };
  if (gizmo.mode == GizmoMode::move) {
    if (glm::distance(place, *middle) <= centerRadius * em) return GizmoHandle{Kind::center, 0};
    for (int axis = 0; axis < 3; ++axis) {
      const auto end = placeInPicture(view, gizmo.place + arrowLength * emSize * unit(axis)),
                 begin = placeInPicture(view, gizmo.place + arrowBegins * emSize * unit(axis));
      if (begin && end && !isHidden({Kind::arrow, axis}, gizmo, view))
        offer({Kind::arrow, axis}, distanceToLine(place, *begin, *end));
    }
    if (nearest) return nearest;
    for (int axis = 0; axis < 3; ++axis) {
      if (isHidden({Kind::square, axis}, gizmo, view)) continue;
      bool inside = true, mirrored = true;  // it may be seen from behind
      const auto corners = squareOf(axis, gizmo, emSize);
      for (std::size_t i = 0; i < 4; ++i) {
        const auto a = placeInPicture(view, corners[i]), b = placeInPicture(view, corners[(i + 1) % 4]);
        if (!a || !b) return std::nullopt;
        const float side = (b->x - a->x) * (place.y - a->y) - (b->y - a->y) * (place.x - a->x);
        inside = inside && side >= 0;
        mirrored = mirrored && side <= 0;
      }
      if (inside || mirrored) return GizmoHandle{Kind::square, axis};
    }
    return std::nullopt;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto ring = ringOf(axis, gizmo, view, ringRadius * emSize);
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      if (!ring[i].isNear || !ring[i + 1].isNear) continue;
      const auto a = placeInPicture(view, ring[i].point), b = placeInPicture(view, ring[i + 1].point);
      if (a && b) offer({Kind::ring, axis}, distanceToLine(place, *a, *b));
    }
  }
  offer({Kind::rim, 0}, std::abs(glm::distance(place, *middle) - rimRadius * em));
  return nearest;
}

GizmoDrag::GizmoDrag(const Gizmo& gizmo, const GizmoHandle& handle, const PictureView& view, float em,
                     glm::vec2 cursor)
    : start_(gizmo), handle_(handle), fromCursor_(cursor) {
  const glm::vec3 eye = toEye(gizmo, view);
  const bool facesEye = handle.kind == Kind::center || handle.kind == Kind::rim;
  axis_ = facesEye ? eye : unit(handle.axis);
  radius_ = ringRadius * em;
  if (turns(handle.kind)) isEdgeOn_ = std::abs(glm::dot(axis_, eye)) < edgeOn;
  if (isEdgeOn_) {
    const glm::vec3 out = glm::normalize(eye - glm::dot(eye, axis_) * axis_);
    const float pixel = pixelSizeAt(view, gizmo.place);
    const auto from = placeInPicture(view, gizmo.place),
               to = placeInPicture(view, gizmo.place + radius_ * pixel * glm::cross(axis_, out));
    if (from && to && *from != *to) tangent_ = glm::normalize(*to - *from);
    grip_ = out;
    return;
  }
  if (handle.kind == Kind::arrow) {
    fromAlong_ = alongAxis(view, cursor);
    return;
  }
  from_ = onPlane(view, cursor);
  if (const glm::vec3 out = from_ - gizmo.place; turns(handle.kind) && glm::length(out) > 0)
    grip_ = glm::normalize(out);
}

// Where the ray through the cursor meets the plane through the centre and across the axis.
glm::vec3 GizmoDrag::onPlane(const PictureView& view, glm::vec2 cursor) const {
  const ViewRay ray = rayThrough(view, cursor);
  const float slope = glm::dot(ray.direction, axis_);
  const float t = glm::dot(start_.place - ray.origin, axis_) / slope;
  if (std::abs(slope) < 1e-4f || t < 0) return from_;  // beyond the horizon of the plane
  return ray.origin + t * ray.direction;
}

// Of the point of the axis that is nearest to the ray, from the centre [m].
float GizmoDrag::alongAxis(const PictureView& view, glm::vec2 cursor) const {
  const ViewRay ray = rayThrough(view, cursor);
  const glm::vec3 between = start_.place - ray.origin;
  const float b = glm::dot(axis_, ray.direction), square = 1 - b * b;
  if (square < 1e-4f) return fromAlong_;
  return (b * glm::dot(ray.direction, between) - glm::dot(axis_, between)) / square;
}

void GizmoDrag::moveTo(const PictureView& view, glm::vec2 cursor, bool snaps) {
  const auto stepped = [&](double x, double step) { return snaps ? step * std::round(x / step) : x; };
  if (turns(handle_.kind)) {
    double now = 0;  // [degrees]
    if (isEdgeOn_) {
      now = glm::degrees(double{glm::dot(cursor - fromCursor_, tangent_)} / double{radius_});
    } else {
      const glm::vec3 out = onPlane(view, cursor) - start_.place, side = glm::cross(axis_, grip_);
      now = glm::degrees(std::atan2(double{glm::dot(out, side)}, double{glm::dot(out, grip_)}));
      now += 360 * std::round((wholeTurn_ - now) / 360);  // goes on where it was
    }
    wholeTurn_ = now;
    turn_ = stepped(now, turnStep);
    return;
  }
  if (handle_.kind == Kind::arrow) {
    way_ = stepped(double{alongAxis(view, cursor) - fromAlong_}, wayStep) * toVec3d(axis_);
    return;
  }
  const Vec3d way = toVec3d(onPlane(view, cursor) - from_);
  way_ = snaps ? Vec3d{stepped(way.x, wayStep), stepped(way.y, wayStep), stepped(way.z, wayStep)} : way;
}

std::string GizmoDrag::text() const {
  const char* const name = handle_.axis == 0 ? "x" : handle_.axis == 1 ? "y" : "z";
  if (handle_.kind == Kind::rim) return formatted("%+.1f\u00b0", turn_);
  if (handle_.kind == Kind::ring) return std::string(name) + formatted(" %+.1f\u00b0", turn_);
  if (handle_.kind == Kind::arrow) return std::string(name) + formatted(" %+.3f m", dot(way_, axis()));
  return formatted("%+.3f", way_.x) + formatted(", %+.3f", way_.y) + formatted(", %+.3f m", way_.z);
}

}  // namespace clothsim

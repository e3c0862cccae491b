// How gizmos look: red, green and blue for x, y and z as in the corner of the picture, light under the
// cursor.
#include <algorithm>
#include <vector>

#include "render/stage.h"
#include "viewer/gizmo_shapes.h"
#include "viewer/ui_frame.h"

namespace clothsim {

using namespace gizmo;

namespace {

constexpr float buttonSide = 2.0f, buttonsBelow = 6.4f, buttonGap = 0.25f, buttonsFromEdge = 3.2f;  // [em]

ImVec2 im(glm::vec2 v) { return {v.x, v.y}; }

ImU32 handleColor(const GizmoHandle& handle, bool isLit, float alpha) {
  if (isLit) return ImGui::GetColorU32({1.0f, 0.86f, 0.36f, alpha});
  const bool isGrey = handle.kind == Kind::center || handle.kind == Kind::rim;
  ImVec4 color = isGrey ? ImVec4(0.92f, 0.93f, 0.95f, 1) : theme::axes[static_cast<std::size_t>(handle.axis)];
  color.w = alpha;
  return ImGui::GetColorU32(color);
}

// Draws the handles of a gizmo, each line with a dark edge, so that it is seen on every ground.
class GizmoPainter {
 public:
  GizmoPainter(const Gizmo& gizmo, const PictureView& view)
      : gizmo_(gizmo), view_(view), emSize_(em() * pixelSizeAt(view, gizmo.place)) {}

  void draw(const GizmoHandle& handle, bool isLit) {
    if (isHidden(handle, gizmo_, view_)) return;
    switch (handle.kind) {
      case Kind::arrow:
        return drawArrow(handle, isLit);
      case Kind::square:
        return drawSquare(handle, isLit);
      case Kind::ring:
        return drawRing(handle, isLit);
      case Kind::center:
      case Kind::rim:
        return drawCircle(handle, isLit);
    }
  }

  // How far it has turned: the sector from where the ring was taken.
  void drawSector(const GizmoDrag& drag) {
    const glm::vec3 u = drag.grip(), w = glm::normalize(glm::vec3(static_cast<float>(drag.axis().x),
                                                                  static_cast<float>(drag.axis().y),
                                                                  static_cast<float>(drag.axis().z)));
    const glm::vec3 v = glm::cross(w, u);
    const float radius = (drag.handle().kind == Kind::rim ? rimRadius : ringRadius) * emSize_;
    const double whole = std::clamp(drag.turn(), -360.0, 360.0);
    const auto at = [&](double degrees) {
      const auto angle = static_cast<float>(glm::radians(degrees));
      return placeInPicture(view_, gizmo_.place + radius * (std::cos(angle) * u + std::sin(angle) * v));
    };
    const auto middle = placeInPicture(view_, gizmo_.place);
    if (!middle) return;
    const ImU32 fill = handleColor(drag.handle(), true, 0.22f), edge = handleColor(drag.handle(), true, 0.9f);
    constexpr int count = 30;
    for (const int quarter : {0, 1, 2, 3}) {  // each is convex
      list_.PathLineTo(im(*middle));
      for (int i = 0; i <= count; ++i)
        if (const auto point = at(whole * (quarter + double(i) / count) / 4)) list_.PathLineTo(im(*point));
      list_.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // which would show where they meet
      list_.PathFillConvex(fill);
      list_.Flags |= ImDrawListFlags_AntiAliasedFill;
    }
    for (const double end : {0.0, whole})
      if (const auto point = at(end)) list_.AddLine(im(*middle), im(*point), edge, line());
  }

  void write(const std::string& words) {
    const auto middle = placeInPicture(view_, gizmo_.place);
    if (!middle) return;
    const ImVec2 size = ImGui::CalcTextSize(words.c_str()), pad{0.5f * em(), 0.2f * em()};
    const float x = std::clamp(middle->x - 0.5f * size.x, pad.x, view_.width - size.x - pad.x);
    const float y = std::max(pad.y, middle->y - (rimRadius + 1.6f) * em());
    list_.AddRectFilled({x - pad.x, y - pad.y}, {x + size.x + pad.x, y + size.y + pad.y},
                        ImGui::GetColorU32(theme::sheet), 0.3f * em());
    list_.AddText({x, y}, ImGui::GetColorU32(theme::plain), words.c_str());
  }

 private:
  static float line() { return std::max(1.5f, 0.15f * em()); }

  void drawArrow(const GizmoHandle& handle, bool isLit) {
    const glm::vec3 axis = unit(handle.axis);
    const auto from = placeInPicture(view_, gizmo_.place + arrowBegins * emSize_ * axis),
               neck = placeInPicture(view_, gizmo_.place + (arrowLength - 1) * emSize_ * axis),
               tip = placeInPicture(view_, gizmo_.place + arrowLength * emSize_ * axis);
    if (!from || !neck || !tip || glm::distance(*neck, *tip) < 1e-3f) return;
    const glm::vec2 along = glm::normalize(*tip - *neck),
                    across = 0.38f * em() * glm::vec2(-along.y, along.x);
    const glm::vec2 base = *tip - 1.0f * em() * along, rim = 0.09f * em() * (along + glm::vec2(0));
    list_.AddLine(im(*from), im(base), dark(), line() + 0.14f * em());
    list_.AddTriangleFilled(im(*tip + 1.8f * rim), im(base - rim + 1.25f * across),
                            im(base - rim - 1.25f * across), dark());
    const ImU32 color = handleColor(handle, isLit, 1);
    list_.AddLine(im(*from), im(base), color, line());
    list_.AddTriangleFilled(im(*tip), im(base + across), im(base - across), color);
  }

  void drawSquare(const GizmoHandle& handle, bool isLit) {
    std::array<ImVec2, 4> corners{};
    const auto square = squareOf(handle.axis, gizmo_, emSize_);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto place = placeInPicture(view_, square[i]);
      if (!place) return;
      corners[i] = im(*place);
    }
    list_.AddConvexPolyFilled(corners.data(), 4, handleColor(handle, isLit, isLit ? 0.75f : 0.45f));
    list_.AddPolyline(corners.data(), 4, handleColor(handle, isLit, 0.95f), ImDrawFlags_Closed,
                      0.6f * line());
  }

  // The far half is faint: it cannot be taken.
  void drawRing(const GizmoHandle& handle, bool isLit) {
    const auto ring = ringOf(handle.axis, gizmo_, view_, ringRadius * emSize_);
    for (const bool near : {false, true}) {
      std::vector<ImVec2> points;
      const auto flush = [&] {
        const int count = static_cast<int>(points.size());
        if (near && count > 1)
          list_.AddPolyline(points.data(), count, dark(), ImDrawFlags_None, line() + 0.14f * em());
        if (count > 1)
          list_.AddPolyline(points.data(), count, handleColor(handle, isLit, near ? 1 : 0.25f),
                            ImDrawFlags_None, near ? line() : 0.5f * line());
        points.clear();
      };
      for (const RingPoint& each : ring) {
        const auto place = placeInPicture(view_, each.point);
        if (each.isNear == near && place)
          points.push_back(im(*place));
        else
          flush();
      }
      flush();
    }
  }

  void drawCircle(const GizmoHandle& handle, bool isLit) {
    const auto middle = placeInPicture(view_, gizmo_.place);
    if (!middle) return;
    const bool isRim = handle.kind == Kind::rim;
    const float radius = (isRim ? rimRadius : centerRadius) * em(), width = isRim ? 0.7f * line() : line();
    list_.AddCircle(im(*middle), radius, dark(), 0, width + 0.14f * em());
    list_.AddCircle(im(*middle), radius, handleColor(handle, isLit, isRim && !isLit ? 0.75f : 1), 0, width);
  }

  static ImU32 dark() { return ImGui::GetColorU32(ImVec4(0.03f, 0.035f, 0.045f, 0.55f)); }

  const Gizmo& gizmo_;
  const PictureView& view_;
  float emSize_;  // of an em at the gizmo [m]
  ImDrawList& list_ = *ImGui::GetBackgroundDrawList();
};

ImVec2 buttonCorner(GizmoMode mode, float pictureWidth, float em) {
  const float left = pictureWidth - (buttonsFromEdge + buttonSide + 0.5f * buttonGap) * em;
  return {left + static_cast<float>(mode) * (buttonSide + buttonGap) * em, buttonsBelow * em};
}

// Four arrows.
void drawMoveSymbol(ImDrawList& list, ImVec2 c, ImU32 color) {
  const float r = 0.68f * em(), head = 0.24f * em(), line = std::max(1.4f, 0.12f * em());
  for (const ImVec2 d : {ImVec2{1, 0}, ImVec2{-1, 0}, ImVec2{0, 1}, ImVec2{0, -1}}) {
    const float neck = r - head;
    list.AddLine(c, {c.x + neck * d.x, c.y + neck * d.y}, color, line);
    const ImVec2 tip{c.x + r * d.x, c.y + r * d.y},
        a{c.x + neck * d.x - head * d.y, c.y + neck * d.y + head * d.x},
        b{c.x + neck * d.x + head * d.y, c.y + neck * d.y - head * d.x};
    list.AddTriangleFilled(tip, a, b, color);
  }
}

// Three quarters of a circle, with an arrow head.
void drawRotateSymbol(ImDrawList& list, ImVec2 c, ImU32 color) {
  const float r = 0.54f * em(), head = 0.3f * em(), line = std::max(1.4f, 0.12f * em());
  list.PathArcTo(c, r, -0.2f, 4.4f, 24);
  list.PathStroke(color, ImDrawFlags_None, line);
  const ImVec2 end{c.x + r * std::cos(4.4f), c.y + r * std::sin(4.4f)};
  list.AddTriangleFilled({end.x + 1.15f * head, end.y - 0.1f * head},
                         {end.x - 0.35f * head, end.y - 0.95f * head},
                         {end.x - 0.1f * head, end.y + 0.85f * head}, color);
}

}  // namespace

void drawGizmo(const Gizmo& gizmo, const PictureView& view, std::optional<GizmoHandle> lit,
               const std::optional<GizmoDrag>& drag) {
  GizmoPainter painter(gizmo, view);
  if (drag) {
    if (turns(drag->handle().kind)) painter.drawSector(*drag);
    painter.draw(drag->handle(), true);
    painter.write(drag->text());
    return;
  }
  const auto all = [&](Kind kind) {
    std::array<int, 3> axes{0, 1, 2};  // the farthest arrow first
    const glm::vec3 eye = toEye(gizmo, view);
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return eye[a] < eye[b]; });
    for (const int axis : axes) {
      const GizmoHandle handle{kind, axis};
      painter.draw(handle, lit == handle);
    }
  };
  if (gizmo.mode == GizmoMode::move) {
    all(Kind::square);
    all(Kind::arrow);
    painter.draw({Kind::center, 0}, lit == GizmoHandle{Kind::center, 0});
  } else {
    painter.draw({Kind::rim, 0}, lit == GizmoHandle{Kind::rim, 0});
    all(Kind::ring);
  }
}

void drawChosenPlaces(const std::vector<Vec3d>& places, const PictureView& view) {
  if (places.size() < 2) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const Vec3d place : places)
    if (const auto at = placeInPicture(view, toGlm(place))) {
      list.AddCircle(im(*at), 0.55f * em(), ImGui::GetColorU32(ImVec4(0, 0, 0, 0.5f)), 0, 0.26f * em());
      list.AddCircle(im(*at), 0.55f * em(), ImGui::GetColorU32(theme::plain), 0, 0.12f * em());
    }
}

std::optional<GizmoMode> gizmoButtonAt(float pictureWidth, float em, glm::vec2 place) {
  for (const GizmoMode mode : {GizmoMode::move, GizmoMode::rotate}) {
    const ImVec2 at = buttonCorner(mode, pictureWidth, em);
    if (place.x >= at.x && place.x < at.x + buttonSide * em && place.y >= at.y &&
        place.y < at.y + buttonSide * em)
      return mode;
  }
  return std::nullopt;
}

void drawGizmoButtons(float pictureWidth, std::optional<GizmoMode> on, glm::vec2 cursor) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const std::optional<GizmoMode> under = gizmoButtonAt(pictureWidth, em(), cursor);
  for (const GizmoMode mode : {GizmoMode::move, GizmoMode::rotate}) {
    const ImVec2 at = buttonCorner(mode, pictureWidth, em());
    const float side = buttonSide * em();
    const ImVec4 ground = on == mode ? theme::fill : under == mode ? theme::fillHovered : theme::glass;
    list.AddRectFilled(at, {at.x + side, at.y + side}, ImGui::GetColorU32(ground), 0.35f * em());
    const ImVec2 middle{at.x + 0.5f * side, at.y + 0.5f * side};
    const ImU32 color = ImGui::GetColorU32(on == mode || under == mode ? theme::plain : theme::quiet);
    mode == GizmoMode::move ? drawMoveSymbol(list, middle, color) : drawRotateSymbol(list, middle, color);
  }
  if (!under) return;
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(*under == GizmoMode::move ? "Move the chosen collider or pins (G)"
                                                   : "Turn the chosen collider or pins (G)");
  quietText("Click one to choose it. Ctrl: in steps");
  ImGui::EndTooltip();
}

}  // namespace clothsim

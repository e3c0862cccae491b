#include "viewer/chosen.h"

#include <algorithm>
#include <utility>

#include "render/stage.h"
#include "scene/moved_collider.h"
#include "scene/pose.h"
#include "scene/rotation_vector.h"
#include "scene_io/scene_io.h"

namespace clothsim {
namespace {

constexpr double largestTurn = 170;  // of an action [degrees]

bool isSolid(const Scene& scene, std::size_t collider) {
  return collider < scene.colliders.size() && !std::holds_alternative<Plane>(scene.colliders[collider]);
}

// Whether all of the group's pins are still there: of a grid of another size they are not.
bool hasPins(const Scene& scene, const PinGroup& group) {
  if (group.cloth >= scene.cloths.size() || group.pins.empty()) return false;
  const ClothSettings& cloth = scene.cloths[group.cloth];
  return std::ranges::all_of(group.pins, [&](const Pin& pin) {
    if (std::ranges::find(cloth.pinned, pin) != cloth.pinned.end()) return true;
    const auto* point = std::get_if<GridPoint>(&pin);  // one that is pinned by hand
    return point == nullptr ? cloth.isMesh()
                            : point->column < cloth.numWidthPoints && point->row < cloth.numHeightPoints &&
                                  !cloth.isMesh();
  });
}

}  // namespace

bool Chosen::chooseFirst(const MouseContext& context) {
  const Scene& scene = context.open.scene();
  for (std::size_t i = 0; i < scene.colliders.size(); ++i)
    if (isSolid(scene, i)) {
      chooseSolid(i);
      return true;
    }
  for (std::size_t i = 0; i < scene.cloths.size(); ++i)
    if (PinGroup group = wholePinGroup(scene, i); !group.pins.empty()) {
      choosePins(std::move(group));
      return true;
    }
  return false;
}

void Chosen::chooseNothing() {
  letGo();
  what_ = {};
}

// The solid's origin, or the middle of the pins [m].
std::optional<Vec3d> Chosen::place(const MouseContext& context) const {
  const Scene& scene = context.open.scene();
  if (const auto* solid = std::get_if<Solid>(&what_); solid != nullptr && isSolid(scene, solid->collider))
    return poseAt(scene.colliders[solid->collider], context.open.time()).position;
  const auto* group = std::get_if<PinGroup>(&what_);
  if (group == nullptr || !hasPins(scene, *group)) return std::nullopt;
  const std::vector<Vec3d> places = placesOf(*group, scene, context.open.cloth());
  Vec3d sum;
  for (const Vec3d each : places) sum = sum + each;
  return (1.0 / static_cast<double>(places.size())) * sum;
}

std::optional<Gizmo> Chosen::gizmo(const MouseContext& context) const {
  const std::optional<Vec3d> middle = place(context);
  return middle ? std::optional(Gizmo{mode, toGlm(*middle)}) : std::nullopt;
}

bool Chosen::pressHandle(const MouseContext& context, glm::vec2 cursor) {
  const std::optional<Gizmo> shown = gizmo(context);
  if (!shown) return false;
  const std::optional<GizmoHandle> handle = handleAt(*shown, context.view(), context.em, cursor);
  if (!handle) return false;
  takeHold(context, shown->place, cursor);
  drag_.emplace(*shown, *handle, context.view(), context.em, cursor);
  byHandle_ = true;
  return true;
}

void Chosen::takeHold(const MouseContext& context, glm::vec3 point, glm::vec2 cursor) {
  const std::optional<Vec3d> middle = place(context);
  if (!middle) return;
  start_ = *middle;
  drag_.emplace(Gizmo{GizmoMode::move, point}, GizmoHandle{GizmoHandle::Kind::center, 0}, context.view(),
                context.em, cursor);
  byHandle_ = isNew_ = hasMoved_ = goesOn_ = false;
  appliedWay_ = {};
  appliedTurn_ = 0;
}

void Chosen::moveTo(const MouseContext& context, glm::vec2 cursor, bool snaps) {
  if (!drag_) return;
  drag_->moveTo(context.view(), cursor, snaps);
  isNew_ = hasMoved_ = true;
}

void Chosen::letGo() {
  drag_.reset();
  isNew_ = false;
}

void Chosen::apply(const MouseContext& context) {
  if (!drag_ || !isNew_ || !gizmo(context)) return;
  const double turn = std::clamp(drag_->turn() - appliedTurn_, -largestTurn, largestTurn);
  isNew_ = appliedTurn_ + turn != drag_->turn();
  appliedTurn_ += turn;
  const Matrix3 matrix = rotationMatrix(turn * drag_->axis());
  if (const auto* solid = std::get_if<Solid>(&what_))
    applyToSolid(context, solid->collider, turn == 0 ? nullptr : &matrix);
  else if (const auto* group = std::get_if<PinGroup>(&what_))
    applyToPins(context, *group, matrix);
  appliedWay_ = drag_ ? drag_->way() : Vec3d{};
}

void Chosen::applyToSolid(const MouseContext& context, std::size_t collider, const Matrix3* turn) {
  const bool moves = drag_->way() != appliedWay_;
  const Vec3d place = start_ + drag_->way();
  if (context.paused) {
    ColliderMove move{collider, std::nullopt};
    if (moves) move.position = place;
    if (turn != nullptr) move.turn = *turn;
    Scene scene = withColliderMoved(context.open.scene(), move, context.open.time());
    if (scene == context.open.scene()) return;  // as a ball that is turned
    context.act(EditScene{std::move(scene)}, std::exchange(goesOn_, true));
    return;
  }
  if (moves) context.act(MoveCollider{collider, place}, std::exchange(goesOn_, true));
  if (turn != nullptr)
    context.act(TurnCollider{collider, rotationVector(*turn)}, std::exchange(goesOn_, true));
}

void Chosen::applyToPins(const MouseContext& context, const PinGroup& group, const Matrix3& turn) {
  if (!isHeldByHands(group, context.open.scene())) {
    try {
      Scene held =
          withPinsHeld(context.open.scene(), group, context.open.cloth(), [&](std::uint32_t particle) {
            const Particle4 p = context.renderer.position(particle);
            return Vec3d{p.x, p.y, p.z};
          });
      // Undone together with the edit before it: it moves nothing.
      context.act(EditScene{parseScene(formatScene(held), context.open.name())}, true);
    } catch (...) {
      letGo();
      throw;
    }
  }
  const Vec3d pivot = place(context).value_or(Vec3d{});
  context.act(EditScene{withPinsMoved(context.open.scene(), group, context.open.cloth(), pivot, turn,
                                      drag_->way() - appliedWay_)},
              std::exchange(goesOn_, true));
}

void Chosen::draw(const MouseContext& context, std::optional<glm::vec2> cursor) const {
  const std::optional<Gizmo> shown = gizmo(context);
  if (!shown) return;
  if (const auto* group = std::get_if<PinGroup>(&what_))
    drawChosenPlaces(placesOf(*group, context.open.scene(), context.open.cloth()), context.view());
  std::optional<GizmoHandle> lit;
  if (cursor && !drag_) lit = handleAt(*shown, context.view(), context.em, *cursor);
  drawGizmo(*shown, context.view(), lit, byHandle_ ? drag_ : std::nullopt);
}

}  // namespace clothsim

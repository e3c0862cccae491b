#include "viewer/mouse_tools.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace clothsim {
namespace {

using Button = ViewerWindow::Button;
using Cursor = ViewerWindow::Cursor;

constexpr double zoomPerStep = 0.88;   // factor for a step of the wheel
constexpr double grabbedSpacings = 3;  // radius of a grab in spacings,
constexpr double grabbedShare = 0.04;  // or as a part of the smaller side of the cloth
constexpr double pinReach = 10;        // distance within which a click removes a pin [pixels],
constexpr double holdReach = 7;        // or takes hold of it
constexpr double blowSpeed = 12;       // [m/s]
constexpr double blowShare = 0.10;     // radius of the jet as a part of the distance to the camera's target
constexpr double longestCut = 20;      // between two picks of a stroke [pixels]
constexpr int mostPicks = 12;          // for one movement of the mouse
constexpr int edgeHalvings = 4;        // bisections to find where a cut crosses the outline
constexpr double cellsBeyondTheEdge = 1.5;  // by which a cut that leaves the cloth is extended

glm::vec2 placeOf(Cursor cursor) { return {cursor.x, cursor.y}; }

Pick pickAt(const MouseContext& context, Cursor cursor) {
  return context.renderer.pick(context.camera, context.width, context.height, cursor.x, cursor.y);
}

bool isOnMesh(const MouseContext& context, const Pick& pick) {
  return pick.kind == Pick::Kind::cloth && context.open.cloth().pieces()[pick.piece].isMesh;
}

double grabRadius(const Piece& piece) {
  const double across = piece.nominalLength[toLeft], along = piece.nominalLength[toUpper];
  const double side = std::min(across * (piece.columns - 1), along * (piece.rows - 1));
  return std::max(grabbedSpacings * std::max(across, along), grabbedShare * side);
}

// The pinned particle that is drawn nearest to the cursor, within `reach` [pixels]. It copies the whole state
// for one click.
std::optional<std::uint32_t> pinUnder(const MouseContext& context, Cursor cursor, double reach) {
  const std::vector<Particle4> positions = context.renderer.positions();
  std::optional<std::uint32_t> nearest;
  double best = reach;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Particle4& p = positions[i];
    if (p.w != 0) continue;
    const auto place = placeInPicture(context.view(), {p.x, p.y, p.z});
    if (!place) continue;
    const double distance =
        std::hypot(static_cast<double>(place->x) - cursor.x, static_cast<double>(place->y) - cursor.y);
    if (distance < best) {
      best = distance;
      nearest = static_cast<std::uint32_t>(i);
    }
  }
  return nearest;
}

// `to`, extended by a cell or two when that leaves the grid, so that a cut over the edge severs it.
LatticePoint overTheEdge(const Piece& piece, LatticePoint from, LatticePoint to) {
  const double columns = to.column - from.column, rows = to.row - from.row;
  const double length = std::hypot(columns, rows);
  if (length == 0) return to;
  const LatticePoint beyond{to.column + cellsBeyondTheEdge * columns / length,
                            to.row + cellsBeyondTheEdge * rows / length};
  const bool leaves =
      beyond.column < 0 || beyond.row < 0 || beyond.column > piece.columns - 1 || beyond.row > piece.rows - 1;
  return leaves ? beyond : to;
}

}  // namespace

Vec3d MouseTools::targetAt(const MouseContext& context, Cursor cursor) const {
  const ViewRay ray = rayThrough(context.view(), placeOf(cursor));
  const float slope = glm::dot(ray.direction, planeNormal_);
  if (std::abs(slope) < 1e-4f) return toVec3d(grabbedPoint_);
  return toVec3d(ray.origin + glm::dot(grabbedPoint_ - ray.origin, planeNormal_) / slope * ray.direction);
}

std::string MouseTools::press(const MouseContext& context, Button button, Cursor cursor, Modifiers held) {
  if (doing_ != Doing::nothing) return "";
  isLetGo_ = false;
  button_ = button;
  last_ = cursor;
  if (button == Button::left && !held.shift && !held.cuts && chosen_.pressHandle(context, placeOf(cursor))) {
    doing_ = Doing::moveChosen;
    wasChosen_ = false;
    return "";
  }
  if (button == Button::right || held.control) {
    doing_ = Doing::pan;
    return "";
  }
  const Pick pick = pickAt(context, cursor);
  if (held.cuts) {
    const auto pieces = context.open.cloth().pieces();
    if (isOnMesh(context, pick) || std::ranges::all_of(pieces, &Piece::isMesh))
      return "A cloth made from a mesh cannot be cut";
    doing_ = Doing::cut;
    lastCut_ = pick;
    stroke_.assign(1, {cursor.x, cursor.y});
    return "";
  }
  if (held.shift) return pin(context, pick, cursor);
  if (takePins(context, cursor)) return wasChosen_ ? "" : "Click again to take all pins of this cloth";
  grabbedPoint_ = pick.point;
  planeNormal_ = glm::normalize(context.camera.target() - context.camera.eye());
  targetMoved_ = hasOrbited_ = false;
  const auto& colliders = context.open.scene().colliders;
  if (pick.kind == Pick::Kind::cloth) {
    doing_ = Doing::grab;
    grab(context, pick);
  } else if (pick.kind == Pick::Kind::collider && !std::holds_alternative<Plane>(colliders[pick.collider])) {
    // Planes are not dragged: they fill the background, where dragging moves the camera.
    doing_ = Doing::moveChosen;
    wasChosen_ = false;
    chosen_.chooseSolid(pick.collider);
    chosen_.takeHold(context, pick.point, placeOf(cursor));
  } else {
    doing_ = Doing::orbit;
  }
  return "";
}

bool MouseTools::takePins(const MouseContext& context, Cursor cursor) {
  const auto pinned = pinUnder(context, cursor, holdReach);
  if (!pinned) return false;
  const Scene& scene = context.open.scene();
  const std::optional<PinGroup> group = pinGroupOf(scene, context.open.cloth(), *pinned);
  if (!group) return false;
  const PinGroup whole = wholePinGroup(scene, group->cloth);
  wasChosen_ = chosen_.isPins(*group) || chosen_.isPins(whole);
  if (!wasChosen_) chosen_.choosePins(*group);
  const Particle4 at = context.renderer.position(*pinned);
  chosen_.takeHold(context, {at.x, at.y, at.z}, placeOf(cursor));
  doing_ = Doing::moveChosen;
  return true;
}

// A click without a movement: on pins that were chosen it goes between them and all pins of the cloth, on the
// ground it chooses nothing.
void MouseTools::endClick(const MouseContext& context) {
  if (doing_ == Doing::orbit && !hasOrbited_) chosen_.chooseNothing();
  if (doing_ != Doing::moveChosen || chosen_.hasMoved() || !wasChosen_) return;
  const auto pinned = pinUnder(context, last_, holdReach);
  const Scene& scene = context.open.scene();
  const auto group = pinned ? pinGroupOf(scene, context.open.cloth(), *pinned) : std::nullopt;
  if (!group) return;
  PinGroup whole = wholePinGroup(scene, group->cloth);
  const bool isWhole = chosen_.isPins(whole) || whole.pins.empty();
  chosen_.choosePins(isWhole ? *group : std::move(whole));
}

void MouseTools::grab(const MouseContext& context, const Pick& pick) {
  grabbed_ = pick.particle;
  Grab grab;
  grab.particle = pick.particle;
  grab.target = toVec3d(pick.point);
  grab.strength = HAND_STRENGTH;
  grab.radius = grabRadius(context.open.cloth().pieces()[pick.piece]);
  context.act(grab, false);
}

std::string MouseTools::pin(const MouseContext& context, const Pick& pick, Cursor cursor) {
  if (const auto pinned = pinUnder(context, cursor, pinReach)) {
    context.act(SetPin{*pinned, false}, false);
    return "Unpinned";
  }
  if (pick.kind != Pick::Kind::cloth) return "Shift+click on the cloth to pin it there";
  context.act(SetPin{pick.particle, true}, false);
  return "Pinned";
}

void MouseTools::move(const MouseContext& context, Cursor cursor, bool control) {
  const double dx = (cursor.x - last_.x) / context.height, dy = (last_.y - cursor.y) / context.height;
  if (dx == 0 && dy == 0) return;
  switch (doing_) {
    case Doing::nothing:
      break;
    case Doing::orbit:
      hasOrbited_ = true;
      context.camera.orbit(-dx * std::numbers::pi, -dy * std::numbers::pi);
      break;
    case Doing::pan:
      context.camera.pan(-dx, -dy);  // the cloth follows the mouse
      break;
    case Doing::grab:
      targetMoved_ = true;
      break;
    case Doing::moveChosen:
      chosen_.moveTo(context, placeOf(cursor), control);
      break;
    case Doing::cut:
      cutTo(context, cursor);
      break;
  }
  last_ = cursor;
}

void MouseTools::release(const MouseContext& context, Button button) {
  if (doing_ == Doing::nothing || button != button_) return;
  if (doing_ == Doing::grab) context.act(Release{}, false);
  endClick(context);
  if (doing_ == Doing::moveChosen) isLetGo_ = true;  // once where it is going is done
  doing_ = Doing::nothing;
  stroke_.clear();
}

void MouseTools::scroll(const MouseContext& context, double steps, Cursor cursor) {
  const double factor = std::pow(zoomPerStep, steps);
  const double x = (cursor.x - context.width / 2.0) / context.height,
               y = (context.height / 2.0 - cursor.y) / context.height;
  context.camera.pan(x * (1 - factor), y * (1 - factor));  // keeps what is under the cursor in its place
  context.camera.zoom(factor);
}

// Picks points along the path of the mouse and cuts between each two on the same grid. Where the path crosses
// the outline of the cloth, the place is found by bisection, so that no uncut strip is left there.
void MouseTools::cutTo(const MouseContext& context, Cursor cursor) {
  const double length = std::hypot(cursor.x - last_.x, cursor.y - last_.y);
  const int count = std::clamp(static_cast<int>(std::ceil(length / longestCut)), 1, mostPicks);
  const auto place = [&](double t) {
    return Cursor{last_.x + t * (cursor.x - last_.x), last_.y + t * (cursor.y - last_.y)};
  };
  for (int i = 1; i <= count; ++i) {
    const double before = (i - 1.0) / count, now = static_cast<double>(i) / count;
    const Pick pick = pickAt(context, place(now));
    const bool was = lastCut_.kind == Pick::Kind::cloth, is = pick.kind == Pick::Kind::cloth;
    if (was && is) {
      if (pick.piece == lastCut_.piece) cutFromTo(context, lastCut_, pick);
    } else if (was || is) {
      const Pick& inside = was ? lastCut_ : pick;
      Pick edge = inside;
      double on = was ? before : now, off = was ? now : before;
      for (int halving = 0; halving < edgeHalvings; ++halving) {
        const double middle = (on + off) / 2;
        const Pick tried = pickAt(context, place(middle));
        const bool hit = tried.kind == Pick::Kind::cloth && tried.piece == inside.piece;
        (hit ? on : off) = middle;
        if (hit) edge = tried;
      }
      cutFromTo(context, was ? lastCut_ : edge, was ? edge : pick);
    }
    lastCut_ = pick;
  }
  stroke_.push_back({cursor.x, cursor.y});
}

void MouseTools::cutFromTo(const MouseContext& context, const Pick& from, const Pick& to) {
  if (isOnMesh(context, from)) return;
  const Piece& piece = context.open.cloth().pieces()[from.piece];
  const LatticePoint begin = overTheEdge(piece, to.lattice, from.lattice);
  context.act(CutStroke{from.piece, begin, overTheEdge(piece, from.lattice, to.lattice)}, false);
}

void MouseTools::beforeStep(const MouseContext& context, Cursor cursor, bool blows) {
  if (doing_ == Doing::grab && !context.open.session().isGrabbing())
    doing_ = Doing::nothing;  // divergence has ended it
  if (doing_ == Doing::grab && targetMoved_ && !context.paused) {
    context.act(MoveHand{targetAt(context, cursor)}, false);
    targetMoved_ = false;
  }
  moveChosen(context);
  if (blows) {
    const ViewRay ray = rayThrough(context.view(), placeOf(cursor));
    const double distance = static_cast<double>(glm::length(context.camera.target() - context.camera.eye()));
    const Blow blow{toVec3d(ray.origin), toVec3d(ray.direction), blowSpeed, blowShare * distance};
    const bool same = blow_ && blow_->origin == blow.origin && blow_->direction == blow.direction;
    if (!blowing_ || !same) context.act(blow, false);
    blow_ = blow;
  } else if (blowing_) {
    if (blow_) blow_->speed = 0;
    if (blow_) context.act(*blow_, false);
    blow_.reset();
  }
  blowing_ = blows;
}

void MouseTools::moveChosen(const MouseContext& context) {
  chosen_.apply(context);
  if (std::exchange(isLetGo_, false)) chosen_.letGo();
}

void MouseTools::letGo(Session& session) {
  if (doing_ == Doing::grab && session.isGrabbing()) session.act(Release{});
  if (doing_ != Doing::orbit && doing_ != Doing::pan) doing_ = Doing::nothing;
  chosen_.letGo();
  stroke_.clear();
}

MouseMarks MouseTools::marks(const MouseContext& context, Cursor cursor) const {
  MouseMarks marks;
  if (doing_ == Doing::grab) {
    marks.goal = {cursor.x, cursor.y};
    const Particle4 grabbed = context.renderer.position(grabbed_);
    marks.grabbed = placeInPicture(context.view(), {grabbed.x, grabbed.y, grabbed.z});
  }
  if (blowing_) {
    marks.nozzle = {cursor.x, cursor.y};
    // The radius of the jet at the target, in pixels of the picture.
    const float scale = context.camera.projection(1.0)[1][1];
    marks.nozzleRadius = static_cast<float>(blowShare) * scale * static_cast<float>(context.height) / 2;
  }
  marks.stroke = stroke_;
  return marks;
}

}  // namespace clothsim

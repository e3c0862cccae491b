#include "viewer/hands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/stage.h"
#include "scene/moved_collider.h"

namespace clothsim {
namespace {

using Button = ViewerWindow::Button;
using Cursor = ViewerWindow::Cursor;

constexpr double zoomPerStep = 0.88;        // of the wheel
constexpr double grabbedSpacings = 3;       // how far from the particle others follow,
constexpr double grabbedShare = 0.04;       // or this part of the cloth's smaller side
constexpr double pinReach = 10;             // how near to a pin a click takes it out [pixels]
constexpr double blowSpeed = 12;            // [m/s]
constexpr double blowShare = 0.10;          // the jet's radius, of the distance to what is looked at
constexpr double longestCut = 20;           // between two picks of a stroke [pixels]
constexpr int mostPicks = 12;               // of one movement of the mouse
constexpr int edgeHalvings = 4;             // that narrow down where a stroke crosses the outline
constexpr double cellsBeyondTheEdge = 1.5;  // that a stroke which leaves the cloth goes on

Vec3d toVec3d(glm::vec3 v) { return {v.x, v.y, v.z}; }

Pick pickAt(const Reach& reach, Cursor cursor) {
  return reach.renderer.pick(reach.camera, reach.width, reach.height, cursor.x, cursor.y);
}

bool isOnMesh(const Reach& reach, const Pick& pick) {
  return pick.kind == Pick::Kind::cloth && reach.session.simulation().cloth().grids()[pick.grid].isMesh;
}

double grabRadius(const Grid& grid) {
  const double across = grid.nominalLength[toLeft], along = grid.nominalLength[toUpper];
  const double side = std::min(across * (grid.columns - 1), along * (grid.rows - 1));
  return std::max(grabbedSpacings * std::max(across, along), grabbedShare * side);
}

// The pinned particle that is drawn nearest to the cursor. Reads the whole state back, for one click.
std::optional<std::uint32_t> pinUnder(const Reach& reach, Cursor cursor) {
  const State state = reach.session.simulation().solver().state();
  std::optional<std::uint32_t> nearest;
  double best = pinReach;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4& p = state.positions[i];
    if (p.w != 0) continue;
    const auto place = placeInPicture(reach.camera, reach.width, reach.height, {p.x, p.y, p.z});
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

// `to` moved on by a cell or two when that leaves the grid: a stroke over the edge cuts through it.
LatticePoint overTheEdge(const Grid& grid, LatticePoint from, LatticePoint to) {
  const double columns = to.column - from.column, rows = to.row - from.row;
  const double length = std::hypot(columns, rows);
  if (length == 0) return to;
  const LatticePoint beyond{to.column + cellsBeyondTheEdge * columns / length,
                            to.row + cellsBeyondTheEdge * rows / length};
  const bool leaves =
      beyond.column < 0 || beyond.row < 0 || beyond.column > grid.columns - 1 || beyond.row > grid.rows - 1;
  return leaves ? beyond : to;
}

}  // namespace

ViewRay rayThrough(const Camera& camera, int width, int height, Cursor cursor) {
  const glm::mat4 clip = camera.projection(static_cast<double>(width) / height) * camera.view();
  const glm::vec4 far =
      glm::inverse(clip) * glm::vec4(2 * cursor.x / width - 1, 1 - 2 * cursor.y / height, 0.5, 1);
  const glm::vec3 eye = camera.eye();
  return {eye, glm::normalize(glm::vec3(far) / far.w - eye)};
}

std::optional<glm::vec2> placeInPicture(const Camera& camera, int width, int height, glm::vec3 point) {
  const glm::vec4 clip =
      camera.projection(static_cast<double>(width) / height) * camera.view() * glm::vec4(point, 1);
  if (clip.w <= 0) return std::nullopt;
  return glm::vec2{(clip.x / clip.w + 1) / 2 * static_cast<float>(width),
                   (1 - clip.y / clip.w) / 2 * static_cast<float>(height)};
}

Vec3d Hands::targetAt(const Reach& reach, Cursor cursor) const {
  const ViewRay ray = rayThrough(reach.camera, reach.width, reach.height, cursor);
  const float slope = glm::dot(ray.direction, planeNormal_);
  if (std::abs(slope) < 1e-4f) return toVec3d(heldPoint_);
  return toVec3d(ray.origin + glm::dot(heldPoint_ - ray.origin, planeNormal_) / slope * ray.direction);
}

std::string Hands::press(const Reach& reach, Button button, Cursor cursor, Modifiers held) {
  if (doing_ != Doing::nothing) return "";
  button_ = button;
  last_ = cursor;
  if (button == Button::right || held.control) {
    doing_ = Doing::pan;
    return "";
  }
  const Pick pick = pickAt(reach, cursor);
  if (held.cuts) {
    if (isOnMesh(reach, pick)) return "A cloth made from a mesh cannot be cut";
    doing_ = Doing::cut;
    lastCut_ = pick;
    stroke_.assign(1, {cursor.x, cursor.y});
    return "";
  }
  if (held.shift) return pin(reach, pick, cursor);
  heldPoint_ = pick.point;
  planeNormal_ = glm::normalize(reach.camera.target() - reach.camera.eye());
  targetMoved_ = dragGoesOn_ = false;
  const auto& colliders = reach.session.simulation().scene().colliders;
  if (pick.kind == Pick::Kind::cloth) {
    doing_ = Doing::grab;
    grab(reach, pick);
  } else if (pick.kind == Pick::Kind::collider && !std::holds_alternative<Plane>(colliders[pick.collider])) {
    // Planes are the ground of a picture: who drags there wants to look around.
    doing_ = Doing::moveCollider;
    collider_ = pick.collider;
    offset_ = poseAt(colliders[collider_], reach.session.simulation().time()).position - toVec3d(pick.point);
  } else {
    doing_ = Doing::orbit;
  }
  return "";
}

void Hands::grab(const Reach& reach, const Pick& pick) {
  held_ = pick.particle;
  Grab grab;
  grab.particle = pick.particle;
  grab.target = toVec3d(pick.point);
  grab.radius = grabRadius(reach.session.simulation().cloth().grids()[pick.grid]);
  reach.session.act(grab);
}

std::string Hands::pin(const Reach& reach, const Pick& pick, Cursor cursor) {
  if (const auto pinned = pinUnder(reach, cursor)) {
    reach.session.act(SetPin{*pinned, false});
    return "Unpinned";
  }
  if (pick.kind != Pick::Kind::cloth) return "Shift+click on the cloth to pin it there";
  reach.session.act(SetPin{pick.particle, true});
  return "Pinned";
}

void Hands::move(const Reach& reach, Cursor cursor) {
  const double dx = (cursor.x - last_.x) / reach.height, dy = (last_.y - cursor.y) / reach.height;
  if (dx == 0 && dy == 0) return;
  switch (doing_) {
    case Doing::nothing:
      break;
    case Doing::orbit:
      reach.camera.orbit(-dx * std::numbers::pi, -dy * std::numbers::pi);
      break;
    case Doing::pan:
      reach.camera.pan(-dx, -dy);  // the cloth follows the hand
      break;
    case Doing::grab:
    case Doing::moveCollider:
      targetMoved_ = true;
      break;
    case Doing::cut:
      cutTo(reach, cursor);
      break;
  }
  last_ = cursor;
}

void Hands::release(const Reach& reach, Button button) {
  if (doing_ == Doing::nothing || button != button_) return;
  if (doing_ == Doing::grab && reach.session.isHolding()) reach.session.act(Release{});
  doing_ = Doing::nothing;
  stroke_.clear();
}

void Hands::scroll(const Reach& reach, double steps, Cursor cursor) {
  const double factor = std::pow(zoomPerStep, steps);
  const double x = (cursor.x - reach.width / 2.0) / reach.height,
               y = (reach.height / 2.0 - cursor.y) / reach.height;
  reach.camera.pan(x * (1 - factor), y * (1 - factor));  // what is under the cursor stays there
  reach.camera.zoom(factor);
}

// Picks along the way of the mouse: each two on the same grid are a stroke. Where the way crosses the cloth's
// outline, the place is narrowed down, so that no strip of it stays whole there.
void Hands::cutTo(const Reach& reach, Cursor cursor) {
  const double length = std::hypot(cursor.x - last_.x, cursor.y - last_.y);
  const int count = std::clamp(static_cast<int>(std::ceil(length / longestCut)), 1, mostPicks);
  const auto place = [&](double t) {
    return Cursor{last_.x + t * (cursor.x - last_.x), last_.y + t * (cursor.y - last_.y)};
  };
  for (int i = 1; i <= count; ++i) {
    const double before = (i - 1.0) / count, now = static_cast<double>(i) / count;
    const Pick pick = pickAt(reach, place(now));
    const bool was = lastCut_.kind == Pick::Kind::cloth, is = pick.kind == Pick::Kind::cloth;
    if (was && is) {
      if (pick.grid == lastCut_.grid) cutFromTo(reach, lastCut_, pick);
    } else if (was || is) {
      const Pick& inside = was ? lastCut_ : pick;
      Pick edge = inside;
      double on = was ? before : now, off = was ? now : before;
      for (int halving = 0; halving < edgeHalvings; ++halving) {
        const double middle = (on + off) / 2;
        const Pick tried = pickAt(reach, place(middle));
        const bool hit = tried.kind == Pick::Kind::cloth && tried.grid == inside.grid;
        (hit ? on : off) = middle;
        if (hit) edge = tried;
      }
      cutFromTo(reach, was ? lastCut_ : edge, was ? edge : pick);
    }
    lastCut_ = pick;
  }
  stroke_.push_back({cursor.x, cursor.y});
}

void Hands::cutFromTo(const Reach& reach, const Pick& from, const Pick& to) {
  if (isOnMesh(reach, from)) return;
  const Grid& grid = reach.session.simulation().cloth().grids()[from.grid];
  const LatticePoint begin = overTheEdge(grid, to.lattice, from.lattice);
  reach.session.act(CutStroke{from.grid, begin, overTheEdge(grid, from.lattice, to.lattice)});
}

void Hands::beforeStep(const Reach& reach, Cursor cursor, bool blows) {
  if (doing_ == Doing::grab && !reach.session.isHolding()) doing_ = Doing::nothing;  // trouble took it away
  if (doing_ == Doing::grab && targetMoved_ && !reach.paused) {
    reach.session.act(MoveHand{targetAt(reach, cursor)});
    targetMoved_ = false;
  }
  if (doing_ == Doing::moveCollider && targetMoved_) {
    const Vec3d place = targetAt(reach, cursor) + offset_;
    if (reach.paused) {
      // While nothing moves the solid is simply put elsewhere: as a parameter, which can be undone.
      const Simulation& simulation = reach.session.simulation();
      reach.session.act(EditScene{withColliderAt(simulation.scene(), collider_, place, simulation.time())},
                        dragGoesOn_);
      dragGoesOn_ = true;
    } else {
      reach.session.act(MoveCollider{collider_, place});
    }
    targetMoved_ = false;
  }
  if (blows) {
    const ViewRay ray = rayThrough(reach.camera, reach.width, reach.height, cursor);
    const double distance = static_cast<double>(glm::length(reach.camera.target() - reach.camera.eye()));
    const Blow blow{toVec3d(ray.origin), toVec3d(ray.direction), blowSpeed, blowShare * distance};
    const bool same = blow_ && blow_->origin == blow.origin && blow_->direction == blow.direction;
    if (!blowing_ || !same) reach.session.act(blow);
    blow_ = blow;
  } else if (blowing_) {
    if (blow_) blow_->speed = 0;
    if (blow_) reach.session.act(*blow_);
    blow_.reset();
  }
  blowing_ = blows;
}

void Hands::letGo(Session& session) {
  if (doing_ == Doing::grab && session.isHolding()) session.act(Release{});
  if (doing_ != Doing::orbit && doing_ != Doing::pan) doing_ = Doing::nothing;
  stroke_.clear();
}

HandMarks Hands::marks(const Reach& reach, Cursor cursor) const {
  HandMarks marks;
  if (doing_ == Doing::grab) {
    marks.hand = {cursor.x, cursor.y};
    const std::vector<Particle4> held = reach.session.simulation().solver().positions(held_, 1);
    marks.held = placeInPicture(reach.camera, reach.width, reach.height, {held[0].x, held[0].y, held[0].z});
  }
  if (blowing_) {
    marks.nozzle = {cursor.x, cursor.y};
    // The jet's edge where the target lies, in pixels: the field of view is that of the projection.
    const float scale = reach.camera.projection(1.0)[1][1];
    marks.nozzleRadius = static_cast<float>(blowShare) * scale * static_cast<float>(reach.height) / 2;
  }
  marks.stroke = stroke_;
  return marks;
}

}  // namespace clothsim

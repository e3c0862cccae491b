#include "cloth/pins.h"

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "cloth/mesh_shape.h"
#include "core/error.h"
#include "core/formatted.h"
#include "core/nearest.h"

namespace clothsim {

namespace {

// How many particles the cloth has.
std::size_t particleCount(const ClothSettings& cloth) {
  if (cloth.isMesh()) return meshShapeOf(cloth.mesh)->points.size();
  return static_cast<std::size_t>(cloth.numWidthPoints) * static_cast<std::size_t>(cloth.numHeightPoints);
}

std::string particleText(std::uint32_t particle, const ClothSettings& cloth) {
  if (cloth.isMesh()) return "vertex " + std::to_string(meshShapeOf(cloth.mesh)->fileIndexOf(particle));
  const auto place = static_cast<int>(particle);
  return pointText({place % cloth.numWidthPoints, place / cloth.numWidthPoints});
}

// --- Of a mesh

// The cloth, and the key that names its points.
struct Owner {
  const ClothSettings& cloth;
  std::string key;
  [[noreturn]] void fail(const std::string& what) const {
    throw SceneError(key + ": " + what + " (" + cloth.mesh + ")");
  }
};

std::uint32_t vertexOf(const VertexPin& pin, const Owner& owner, const MeshShape& shape) {
  const auto index = static_cast<std::uint32_t>(pin.vertex);
  if (const std::optional<std::uint32_t> point = shape.pointAt(index)) return *point;
  const auto points = static_cast<std::uint32_t>(shape.points.size() + shape.loosePoints);
  if (index < points) owner.fail("vertex " + std::to_string(index) + " of the mesh belongs to no face");
  owner.fail("expected a vertex from 0 to " + std::to_string(points - 1) + " of the mesh, found " +
             std::to_string(pin.vertex));
}

bool isInside(const Region& region, Vec3d p) {
  const auto isBetween = [](double x, double from, double to) { return from <= x && x <= to; };
  const auto& [from, to] = region;
  return isBetween(p.x, from.x, to.x) && isBetween(p.y, from.y, to.y) && isBetween(p.z, from.z, to.z);
}

const std::vector<std::uint32_t>& verticesOf(const GroupPin& pin, const Owner& owner,
                                             const MeshShape& shape) {
  if (const auto found = shape.groups.find(pin.group); found != shape.groups.end()) return found->second;
  std::vector<std::string> names;
  std::string list;
  for (const auto& [name, members] : shape.groups) {
    names.push_back(name);
    list += (list.empty() ? "" : ", ") + name;
  }
  owner.fail("the mesh has no group \"" + pin.group + "\"" + didYouMean(pin.group, names) + "; it has " +
             (list.empty() ? "none" : list));
}

// A channel of the colours of all points.
std::vector<double> channelOf(const PaintedPin& pin, const Owner& owner, const MeshShape& shape) {
  const auto channel = static_cast<std::size_t>(pin.painted);
  const std::string name = std::array{"red", "green", "blue"}[channel];
  if (shape.colors.empty())
    owner.fail(
        "expected colours of vertices in the mesh file, v x y z r g b for each, found vertices without "
        "(in Blender: paint them in Vertex Paint, and export OBJ with Colors)");
  std::vector<double> values;
  for (const auto& color : shape.colors) {
    const double value = double{color[channel]};
    if (!(value >= 0 && value <= 1))
      owner.fail("expected colours from 0 to 1 in the mesh file, found " + name + " " +
                 formatted("%g", value) + " at vertex " +
                 std::to_string(shape.fileIndexOf(static_cast<std::uint32_t>(values.size()))));
    values.push_back(value);
  }
  return values;
}

// Visits the particles of pins. It visits a grid's only once until forget(), however often pins name them, so
// that overlapping blocks cost no more than their rows.
class PinnedParticles {
 public:
  explicit PinnedParticles(const ClothSettings& cloth, std::string key = "cloth.pinned")
      : owner_{cloth, std::move(key)} {
    if (cloth.isMesh()) {
      shape_ = meshShapeOf(cloth.mesh);
      return;
    }
    width_ = static_cast<std::size_t>(cloth.numWidthPoints) + 1;
    next_.resize(width_ * static_cast<std::size_t>(cloth.numHeightPoints));
    std::iota(next_.begin(), next_.end(), 0u);
  }

  // Calls visit(particle) until it returns false, and returns whether it never did. @throws SceneError when
  // the mesh does not have what the pin names, or when there is too much to look at
  template <class Visit>
  bool forEach(const Pin& pin, Visit visit) {
    if (!shape_) return forEachPoint(pointsOf(pin, owner_.cloth), visit);
    if (const auto* vertex = std::get_if<VertexPin>(&pin)) return visit(vertexOf(*vertex, owner_, *shape_));
    if (const auto* group = std::get_if<GroupPin>(&pin)) {
      const std::vector<std::uint32_t>& members = verticesOf(*group, owner_, *shape_);
      countWork(members.size());
      return std::all_of(members.begin(), members.end(), visit);
    }
    if (const auto* paint = std::get_if<PaintedPin>(&pin)) return forEachPainted(*paint, visit);
    const auto* region = std::get_if<RegionPin>(&pin);
    return region == nullptr || forEachInside(region->region, visit);  // The reader has complained of others.
  }

  // From now on visits all particles once more.
  void forget() {
    for (const std::size_t place : visited_) next_[place] = static_cast<std::uint32_t>(place);
    visited_.clear();
  }

 private:
  // The first place from `place` on that was not visited, or the end of the row.
  std::size_t unvisited(std::size_t place) {
    while (next_[place] != place) {
      next_[place] = next_[next_[place]];
      place = next_[place];
    }
    return place;
  }

  template <class Visit>
  bool forEachPoint(const GridRange& block, Visit visit) {
    countWork(static_cast<std::size_t>(block.to.row - block.from.row) + 1);
    for (int row = block.from.row; row <= block.to.row; ++row) {
      const std::size_t first = width_ * static_cast<std::size_t>(row);
      const std::size_t last = first + static_cast<std::size_t>(block.to.column);
      for (std::size_t at = unvisited(first + static_cast<std::size_t>(block.from.column)); at <= last;
           at = unvisited(at)) {
        next_[at] = static_cast<std::uint32_t>(at + 1);
        visited_.push_back(static_cast<std::uint32_t>(at));
        if (!visit(static_cast<std::uint32_t>(at - static_cast<std::size_t>(row)))) return false;
      }
    }
    return true;
  }

  template <class Visit>
  bool forEachPainted(const PaintedPin& pin, Visit visit) {
    const std::vector<double> channel = channelOf(pin, owner_, *shape_);
    countWork(channel.size());
    bool isEmpty = true;
    for (std::size_t i = 0; i < channel.size(); ++i) {
      if (channel[i] <= 0.5) continue;
      isEmpty = false;
      if (!visit(static_cast<std::uint32_t>(i))) return false;
    }
    if (isEmpty) owner_.fail("expected paint of more than 0.5 at some vertex of the mesh, found none");
    return true;
  }

  template <class Visit>
  bool forEachInside(const Region& region, Visit visit) {
    if (points_.empty()) points_ = placedPoints(*shape_, owner_.cloth);
    countWork(points_.size());
    bool isEmpty = true;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!isInside(region, points_[i])) continue;
      isEmpty = false;
      if (!visit(static_cast<std::uint32_t>(i))) return false;
    }
    if (isEmpty)
      owner_.fail(
          "expected a region that holds vertices of the mesh as it is placed at the start, found one that "
          "holds none");
    return true;
  }

  void countWork(std::size_t more) {
    constexpr std::size_t most = std::size_t{1} << 28;
    work_ += more;
    if (work_ > most)
      throw SceneError(owner_.key + ": the pins name " + std::string(shape_ ? "vertices" : "rows of points") +
                       " more than " + std::to_string(most) + " times; expected fewer pins that overlap");
  }

  Owner owner_;
  std::shared_ptr<const MeshShape> shape_;  // null: a grid
  std::vector<Vec3d> points_;               // of the mesh, when they are needed
  std::size_t width_ = 0, work_ = 0;        // places in a row: its points, and its end
  std::vector<std::uint32_t> next_, visited_;
};

}  // namespace

VertexPin vertexPinOf(const ClothSettings& cloth, std::uint32_t point) {
  return {static_cast<int>(meshShapeOf(cloth.mesh)->fileIndexOf(point))};
}

bool isMeshPin(const Pin& pin) {
  return std::holds_alternative<VertexPin>(pin) || std::holds_alternative<RegionPin>(pin) ||
         std::holds_alternative<GroupPin>(pin) || std::holds_alternative<PaintedPin>(pin);
}

std::vector<double> weightsOf(const std::vector<Pin>& points, const ClothSettings& cloth,
                              const std::string& key) {
  const Owner owner{cloth, key};
  std::vector<double> weights(particleCount(cloth));
  PinnedParticles particles(cloth, key);
  for (const Pin& pin : points) {
    if (const auto* paint = std::get_if<PaintedPin>(&pin)) {
      const std::vector<double> channel = channelOf(*paint, owner, *meshShapeOf(cloth.mesh));
      for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::max(weights[i], channel[i]);
    } else {
      particles.forEach(pin, [&](std::uint32_t particle) {
        weights[particle] = 1;
        return true;
      });
    }
  }
  return weights;
}

std::vector<bool> pinnedParticles(const ClothSettings& cloth) {
  std::vector<bool> pinned(particleCount(cloth));
  if (cloth.pinned.empty()) return pinned;
  PinnedParticles particles(cloth);
  for (const Pin& pin : cloth.pinned)
    particles.forEach(pin, [&](std::uint32_t particle) { return pinned[particle] = true; });
  return pinned;
}

std::string pointText(GridPoint point) {
  std::string text = "[";
  text += std::to_string(point.column) + ", " + std::to_string(point.row) + "]";
  return text;
}

GridRange pointsOf(const Pin& pin, const ClothSettings& cloth) {
  const int lastColumn = cloth.numWidthPoints - 1, lastRow = cloth.numHeightPoints - 1;
  if (const auto* point = std::get_if<GridPoint>(&pin)) return {*point, *point};
  if (const auto* range = std::get_if<GridRange>(&pin)) return *range;
  const bool vertical = cloth.orientation == Orientation::vertical;
  const int top = vertical ? lastRow : 0, bottom = vertical ? 0 : lastRow;
  switch (std::get<GridSide>(pin)) {
    case GridSide::top:
      return {{0, top}, {lastColumn, top}};
    case GridSide::bottom:
      return {{0, bottom}, {lastColumn, bottom}};
    case GridSide::left:
      return {{0, 0}, {0, lastRow}};
    case GridSide::right:
      return {{lastColumn, 0}, {lastColumn, lastRow}};
  }
  return {};
}

const std::vector<Pin>& pinsOf(const PinMotion& motion, const ClothSettings& cloth) {
  return motion.pinned.empty() ? cloth.pinned : motion.pinned;
}

std::vector<int> pinMotionOfPoints(const ClothSettings& cloth) {
  std::vector<int> motions(particleCount(cloth), NO_MOTION);
  PinnedParticles particles(cloth);
  for (std::size_t i = 0; i < cloth.pinMotion.size(); ++i)
    for (const Pin& pin : pinsOf(cloth.pinMotion[i], cloth))
      particles.forEach(pin, [&](std::uint32_t particle) {
        motions[particle] = static_cast<int>(i);
        return true;
      });
  return motions;
}

std::vector<bool> freeKeys(const PinMotion& motion) {
  std::vector<bool> free;
  for (const PinMotion::Key& key : motion.keys) free.push_back(key.free);
  if (std::find(free.begin(), free.end(), true) == free.end()) free.clear();
  return free;
}

std::vector<bool> freeAtTheStart(const ClothSettings& cloth) {
  const auto isFree = [](const PinMotion& motion) {
    return !motion.keys.empty() && motion.keys.front().free && motion.keys.front().t <= 0;
  };
  if (std::none_of(cloth.pinMotion.begin(), cloth.pinMotion.end(), isFree)) return {};
  std::vector<bool> free;
  for (const int motion : pinMotionOfPoints(cloth))
    free.push_back(motion != NO_MOTION && isFree(cloth.pinMotion[static_cast<std::size_t>(motion)]));
  return free;
}

Motion pathAbout(const PinMotion& motion, Vec3d center) {
  Motion path;
  path.loop = motion.loop;
  path.interpolation = motion.interpolation;
  for (const PinMotion::Key& key : motion.keys)
    path.keys.push_back({key.t, key.position.value_or(center), key.rotation});
  if (path.keys.empty()) path.keys.push_back({0, center, {}});
  return path;
}

std::optional<PinConflict> findPinConflict(const ClothSettings& cloth) {
  if (cloth.pinMotion.empty()) return std::nullopt;
  const std::vector<bool> pinned = pinnedParticles(cloth);
  std::vector<int> motions(pinned.size(), NO_MOTION);
  PinnedParticles particles(cloth);
  std::optional<PinConflict> conflict;
  for (std::size_t i = 0; i < cloth.pinMotion.size(); ++i) {
    const std::vector<Pin>& pins = pinsOf(cloth.pinMotion[i], cloth);
    for (std::size_t k = 0; k < pins.size() && !conflict; ++k)
      particles.forEach(pins[k], [&](std::uint32_t particle) {
        int& motion = motions[particle];
        if (!pinned[particle]) conflict = PinConflict{i, k, particleText(particle, cloth), std::nullopt};
        if (motion != NO_MOTION && motion != static_cast<int>(i))
          conflict = PinConflict{i, k, particleText(particle, cloth), static_cast<std::size_t>(motion)};
        motion = static_cast<int>(i);
        return !conflict;
      });
    if (conflict) return conflict;
    particles.forget();  // so that another motion finds them
  }
  return std::nullopt;
}

}  // namespace clothsim

#include "scene/pins.h"

#include "core/error.h"
#include "core/nearest.h"
#include "scene/mesh_shape.h"

namespace clothsim {

namespace {

// How many particles the cloth has.
std::size_t particleCount(const ClothSettings& cloth) {
  if (cloth.isMesh()) return meshShapeOf(cloth.mesh)->points.size();
  return static_cast<std::size_t>(cloth.numWidthPoints) * static_cast<std::size_t>(cloth.numHeightPoints);
}

std::string particleText(std::uint32_t particle, const ClothSettings& cloth) {
  if (cloth.isMesh()) return "vertex " + std::to_string(particle);
  const auto place = static_cast<int>(particle);
  return pointText({place % cloth.numWidthPoints, place / cloth.numWidthPoints});
}

std::vector<std::uint32_t> pointsOfBlock(const GridRange& range, const ClothSettings& cloth) {
  std::vector<std::uint32_t> points;
  for (int row = range.from.row; row <= range.to.row; ++row)
    for (int column = range.from.column; column <= range.to.column; ++column)
      points.push_back(static_cast<std::uint32_t>(row * cloth.numWidthPoints + column));
  return points;
}

// --- Of a mesh

[[noreturn]] void fail(const ClothSettings& cloth, const std::string& what) {
  throw SceneError("cloth.pinned: " + what + " (" + cloth.mesh + ")");
}

std::vector<std::uint32_t> verticesOf(const VertexPin& pin, const ClothSettings& cloth,
                                      const MeshShape& shape) {
  if (static_cast<std::size_t>(pin.vertex) >= shape.points.size())
    fail(cloth, "expected a vertex from 0 to " + std::to_string(shape.points.size() - 1) +
                    " of the mesh, found " + std::to_string(pin.vertex));
  return {static_cast<std::uint32_t>(pin.vertex)};
}

std::vector<std::uint32_t> verticesOf(const RegionPin& pin, const ClothSettings& cloth,
                                      const MeshShape& shape) {
  const auto isBetween = [](double x, double from, double to) { return from <= x && x <= to; };
  const auto& [from, to] = pin.region;
  std::vector<std::uint32_t> inside;
  const std::vector<Vec3d> points = placedPoints(shape, cloth);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (isBetween(points[i].x, from.x, to.x) && isBetween(points[i].y, from.y, to.y) &&
        isBetween(points[i].z, from.z, to.z))
      inside.push_back(static_cast<std::uint32_t>(i));
  if (inside.empty())
    fail(cloth,
         "expected a region that holds vertices of the mesh as it is placed at the start, found one that "
         "holds none");
  return inside;
}

std::vector<std::uint32_t> verticesOf(const GroupPin& pin, const ClothSettings& cloth,
                                      const MeshShape& shape) {
  if (const auto found = shape.groups.find(pin.group); found != shape.groups.end()) return found->second;
  std::vector<std::string> names;
  std::string list;
  for (const auto& [name, members] : shape.groups) {
    names.push_back(name);
    list += (list.empty() ? "" : ", ") + name;
  }
  fail(cloth, "the mesh has no group \"" + pin.group + "\"" + didYouMean(pin.group, names) + "; it has " +
                  (list.empty() ? "none" : list));
}

template <class GridPin>
std::vector<std::uint32_t> verticesOf(const GridPin&, const ClothSettings&, const MeshShape&) {
  return {};  // the reader has complained
}

}  // namespace

bool isMeshPin(const Pin& pin) {
  return std::holds_alternative<VertexPin>(pin) || std::holds_alternative<RegionPin>(pin) ||
         std::holds_alternative<GroupPin>(pin);
}

std::vector<std::vector<std::uint32_t>> particlesOf(const std::vector<Pin>& pins,
                                                    const ClothSettings& cloth) {
  std::vector<std::vector<std::uint32_t>> particles;
  const std::shared_ptr<const MeshShape> shape = cloth.isMesh() ? meshShapeOf(cloth.mesh) : nullptr;
  for (const Pin& pin : pins)
    particles.push_back(
        shape ? std::visit([&](const auto& which) { return verticesOf(which, cloth, *shape); }, pin)
              : pointsOfBlock(pointsOf(pin, cloth), cloth));
  return particles;
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
  for (std::size_t i = 0; i < cloth.pinMotion.size(); ++i)
    for (const auto& particles : particlesOf(pinsOf(cloth.pinMotion[i], cloth), cloth))
      for (const std::uint32_t particle : particles) motions[particle] = static_cast<int>(i);
  return motions;
}

Motion pathAbout(const PinMotion& motion, Vec3d center) {
  Motion path;
  path.loop = motion.loop;
  for (const PinMotion::Key& key : motion.keys)
    path.keys.push_back({key.t, key.position.value_or(center), key.rotation});
  return path;
}

std::optional<PinConflict> findPinConflict(const ClothSettings& cloth) {
  if (cloth.pinMotion.empty()) return std::nullopt;
  constexpr int free = -2;
  std::vector<int> motions(particleCount(cloth), free);
  for (const auto& particles : particlesOf(cloth.pinned, cloth))
    for (const std::uint32_t particle : particles) motions[particle] = NO_MOTION;
  for (std::size_t i = 0; i < cloth.pinMotion.size(); ++i) {
    const auto pins = particlesOf(pinsOf(cloth.pinMotion[i], cloth), cloth);
    for (std::size_t k = 0; k < pins.size(); ++k)
      for (const std::uint32_t particle : pins[k]) {
        int& motion = motions[particle];
        if (motion == free) return PinConflict{i, k, particleText(particle, cloth), std::nullopt};
        if (motion != NO_MOTION && motion != static_cast<int>(i))
          return PinConflict{i, k, particleText(particle, cloth), static_cast<std::size_t>(motion)};
        motion = static_cast<int>(i);
      }
  }
  return std::nullopt;
}

}  // namespace clothsim

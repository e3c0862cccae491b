#include "scene/colliders/mesh_collider.h"

#include <algorithm>
#include <cmath>

#include "scene/colliders/shape_fields.h"

namespace clothsim {

std::span<const Field<MeshCollider>> MeshCollider::fields() {
  using M = MeshCollider;
  static const std::array fields{
      field("file", &M::file,
            "OBJ file of a closed mesh, beside the scene or in clothsim's folder; of several shapes: "
            "walk_%03d.obj.")
          .required(),
      field("shapes", &M::shapes,
            "How many shapes the body takes one after the other, a file for each, with the same faces.")
          .within({.low = 1, .high = 1000}),
      field("first_shape", &M::firstShape, "Number of the first shape's file.")
          .within({.low = 0, .high = 1'000'000}),
      field("shapes_per_second", &M::shapesPerSecond, "How fast shapes follow each other.")
          .in("1/s")
          .within(positive)
          .usually(5, 60),
      field("shapes_start", &M::shapesStart, "Time at which the first shape is there.").in("s").usually(0, 5),
      field("shapes_loop", &M::shapesLoop, "After the last shape the first one follows; otherwise it stays."),
      field("origin", &M::origin, "Position of the mesh's origin.").in("m"),
      field("rotation", &M::rotation, "Rotation of a box or mesh.").in("degrees"),
      field("scale", &M::scale, "Metres per unit of the mesh file.").within(positive).usually(0.1, 10),
      field("cells", &M::cells,
            "Cells of the mesh's signed distance grid along its longest side; more are finer but slower.")
          .within({.low = 8, .high = 256}),
      frictionField<M>(),
      motionField<M>(),
      lookField<M>(),
  };
  return fields;
}

namespace {

// The "%d" or "%03d" of a file's name.
struct NumberPlace {
  std::size_t begin = std::string::npos, end = 0;
  std::size_t digits = 0;  // at least; filled up with zeros
  [[nodiscard]] bool exists() const { return begin != std::string::npos; }
};

NumberPlace numberPlaceIn(const std::string& file) {
  for (std::size_t begin = file.find('%'); begin != file.npos; begin = file.find('%', begin + 1)) {
    std::size_t end = begin + 1, digits = 0;
    const bool isPadded = end < file.size() && file[end] == '0';
    while (end < file.size() && file[end] >= '0' && file[end] <= '9' && end < begin + 4)
      digits = 10 * digits + static_cast<std::size_t>(file[end++] - '0');
    if (end < file.size() && file[end] == 'd' && (isPadded || digits == 0)) return {begin, end + 1, digits};
  }
  return {};
}

}  // namespace

std::optional<Misfit> MeshCollider::finishReading(const IsGiven&) const {
  if (file.empty()) return Misfit{"file", "the name of an OBJ file"};
  if (deforms() && !numberPlaceIn(file).exists())
    return Misfit{"file", "a name with a place for the numbers of the shapes, such as walk_%03d.obj"};
  return std::nullopt;
}

std::string MeshCollider::fileOf(int shape) const {
  const NumberPlace place = numberPlaceIn(file);
  if (!deforms() || !place.exists()) return file;
  std::string number = std::to_string(firstShape + shape);
  if (number.size() < place.digits) number.insert(0, place.digits - number.size(), '0');
  return file.substr(0, place.begin) + number + file.substr(place.end);
}

double MeshCollider::progressAt(double time) const {
  const double progress = (time - shapesStart) * shapesPerSecond;
  return shapesLoop ? progress : std::clamp(progress, 0.0, static_cast<double>(shapes - 1));
}

ShapeMoment MeshCollider::momentAt(double progress) const {
  if (!deforms()) return {};
  const auto count = static_cast<std::size_t>(shapes);
  if (!shapesLoop) {
    const std::size_t from = std::min(static_cast<std::size_t>(progress), count - 2);
    return {from, from + 1, progress - static_cast<double>(from)};
  }
  const double turns = std::floor(progress / shapes), wrapped = progress - turns * shapes;
  const std::size_t from = std::min(static_cast<std::size_t>(std::max(wrapped, 0.0)), count - 1);
  return {from, (from + 1) % count, std::clamp(wrapped - static_cast<double>(from), 0.0, 1.0)};
}

}  // namespace clothsim

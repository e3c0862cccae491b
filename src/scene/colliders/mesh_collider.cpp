#include "scene/colliders/mesh_collider.h"

#include "scene/colliders/shape_fields.h"

namespace clothsim {

std::span<const Field<MeshCollider>> MeshCollider::fields() {
  using M = MeshCollider;
  static const std::array fields{
      field("file", &M::file,
            "OBJ file of a closed mesh; looked up beside the scene file, then in clothsim's folder.")
          .required()
          .rebuilds(),
      field("origin", &M::origin, "Position of the mesh's origin.").in("m"),
      field("rotation", &M::rotation, "Rotation of a box or mesh.").in("degrees"),
      field("scale", &M::scale, "Metres per unit of the mesh file.").within(positive).usually(0.1, 10),
      field("cells", &M::cells,
            "Cells of the mesh's signed distance grid along its longest side; more are finer but slower.")
          .within({.low = 8, .high = 256}),
      frictionField<M>(),
      motionField<M>(),
  };
  return fields;
}

std::optional<Misfit> MeshCollider::finishReading(const IsGiven&) const {
  if (file.empty()) return Misfit{"file", "the name of an OBJ file"};
  return std::nullopt;
}

}  // namespace clothsim

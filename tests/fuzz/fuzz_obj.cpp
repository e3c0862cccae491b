// OBJ files, as the mesh of a cloth and as a solid that cloth falls on.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "cloth/mesh_shape.h"
#include "demands.h"
#include "scene/colliders/signed_distance_grid.h"

using namespace clothsim;
namespace fs = std::filesystem;

namespace {

class MeshFile {
 public:
  MeshFile() : path_(fs::temp_directory_path() / ("clothsim_fuzz_" + std::to_string(getpid()) + ".obj")) {}
  ~MeshFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }

  // Each file is younger than the one before by a second: what was read of that must not be taken for this.
  std::string write(std::string_view text) {
    std::ofstream(path_, std::ios::binary) << text;
    fs::last_write_time(path_, start_ + std::chrono::seconds(++written_));
    return path_.string();
  }

 private:
  fs::path path_;
  fs::file_time_type start_ = fs::file_time_type::clock::now();
  int written_ = 0;
};

void checkShape(const MeshShape& shape) {
  fuzz::demand(!shape.points.empty() && !shape.triangles.empty(), "a mesh of nothing");
  fuzz::demand(shape.textureCoordinates.size() == shape.points.size(), "a point without u and v");
  const auto isPoint = [&](std::uint32_t point) { return point < shape.points.size(); };
  for (const auto& triangle : shape.triangles)
    fuzz::demand(std::all_of(triangle.begin(), triangle.end(), isPoint), "a corner that is no point");
  for (const MeshShape::Edge& edge : shape.edges)
    fuzz::demand(edge.b < edge.a && isPoint(edge.a) && isPoint(edge.opposite[0]) && isPoint(edge.opposite[1]),
                 "an edge of no two points");
  for (const auto& [name, points] : shape.groups)
    fuzz::demand(std::all_of(points.begin(), points.end(), isPoint), "a group with no point: " + name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static MeshFile file;
  const std::string path = file.write(fuzz::textOf(bytes, size));
  if (fuzz::isRead([&] { checkShape(*meshShapeOf(path)); })) {
    Scene scene;
    scene.cloths[0].ks = 5000;
    scene.cloths[0].mesh = path;
    fuzz::checkCloth(scene);
  }
  (void)fuzz::isRead([&] {
    const SignedDistanceGrid piece(loadSolidMesh(path, 1), 8);
    const auto [x, y, z] = piece.counts();
    fuzz::demand(piece.samples().size() == std::size_t{x} * y * z, "a grid without its samples");
  });
  return 0;
}

// Triangle meshes for tests, as OBJ files: sheets of equilateral triangles, which have no rows and columns.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "cloth/cuts.h"
#include "scene/scene.h"
#include "support/temporary_folder.h"

namespace clothsim::test {

struct MeshSheet {
  int columns = 12, rows = 14;
  double edge = 0.05;   // [m]
  double disorder = 0;  // how far points inside are moved at random, of the edge
  int layers = 1;       // sheets above each other in z, an edge apart
};

// In the plane z = 0, from the origin along x and y; groups "bottom" and "top" are the first and last strip
// of triangles, "middle" the rest.
inline std::string meshSheetText(const MeshSheet& sheet) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-sheet.disorder * sheet.edge, sheet.disorder * sheet.edge);
  std::string text;
  const auto line = [&](const std::string& words) { text += words + "\n"; };
  for (int layer = 0; layer < sheet.layers; ++layer)
    for (int row = 0; row < sheet.rows; ++row)
      for (int column = 0; column < sheet.columns; ++column) {
        const bool inside = row > 0 && row + 1 < sheet.rows && column > 0 && column + 1 < sheet.columns;
        const double x = (column + 0.5 * (row % 2)) * sheet.edge + (inside ? uniform(engine) : 0);
        const double y = row * std::sqrt(0.75) * sheet.edge + (inside ? uniform(engine) : 0);
        line("v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(layer * sheet.edge));
      }
  const auto face = [&](int a, int b, int c) {
    line("f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c));
  };
  for (int layer = 0; layer < sheet.layers; ++layer)
    for (int row = 0; row + 1 < sheet.rows; ++row) {
      line(row == 0 ? "g bottom" : row + 2 == sheet.rows ? "g top" : "g middle");
      for (int column = 0; column + 1 < sheet.columns; ++column) {
        const int a = (layer * sheet.rows + row) * sheet.columns + column + 1, b = a + 1,
                  c = a + sheet.columns, d = c + 1;
        row % 2 == 0 ? (face(a, b, c), face(b, d, c)) : (face(a, b, d), face(a, d, c));
      }
    }
  return text;
}

// Files that live as long as the test program.
inline std::string meshFile(const std::string& text) {
  static const TemporaryFolder folder;
  static std::map<std::string, std::string> known;
  std::string& file = known[text];
  if (file.empty()) {
    file = (folder / ("mesh" + std::to_string(known.size()) + ".obj")).string();
    std::ofstream(file) << text;
  }
  return file;
}
inline std::string meshSheetFile(const MeshSheet& sheet) { return meshFile(meshSheetText(sheet)); }

// CS184's springs on a mesh, free and without limiter.
inline Scene meshScene(const MeshSheet& sheet = {}) {
  Scene scene;
  scene.cloths[0].mesh = meshSheetFile(sheet);
  scene.cloths[0].ks = 200;
  scene.cloths[0].density = 1;
  return scene;
}

// Takes all triangles that the height y [m] of the start passes through.
inline Cuts tornAcross(const Cloth& cloth, double y) {
  Cuts cuts;
  for (const MeshSpring& spring : cloth.lists().springs) {
    const double a = cloth.positions()[spring.a].y, b = cloth.positions()[spring.b].y;
    if (spring.kind == SpringKind::structural && std::min(a, b) < y && y < std::max(a, b))
      tearEdge(cuts, cloth, spring);
  }
  return cuts;
}

}  // namespace clothsim::test

// The energy of a membrane as the continuum has it, written down a second time: of the deformation gradient
// of each triangle, with its threads along x and y of its rest shape, which lies in a plane z = const.
#pragma once

#include <array>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/material.h"

namespace clothsim::test {

// E11, E22 and 2 E12 of a triangle whose corners move from X to x.
inline std::array<double, 3> greenStrain(const std::array<Vec3d, 3>& rest,
                                         const std::array<Vec3d, 3>& moved) {
  const Vec3d p = rest[1] - rest[0], q = rest[2] - rest[0];
  const double determinant = p.x * q.y - p.y * q.x;
  const Vec3d a = moved[1] - moved[0], b = moved[2] - moved[0];
  const Vec3d alongX = (1 / determinant) * (q.y * a - p.y * b),
              alongY = (1 / determinant) * (p.x * b - q.x * a);
  return {0.5 * (dot(alongX, alongX) - 1), 0.5 * (dot(alongY, alongY) - 1), dot(alongX, alongY)};
}

// Stresses along x, along y and of shear [N/m].
inline std::array<double, 3> stressOf(const SheetModuli& moduli, const std::array<double, 3>& strain) {
  return {moduli.c11 * strain[0] + moduli.c12 * strain[1], moduli.c12 * strain[0] + moduli.c22 * strain[1],
          moduli.shear * strain[2]};
}

// Of a mesh at x, the only cloth [J].
inline double membraneEnergy(const Cloth& cloth, const Material& material, const std::vector<Vec3d>& x) {
  double energy = 0;
  for (const auto& [a, b, c] : cloth.triangles()) {
    const std::array rest{cloth.positions()[a], cloth.positions()[b], cloth.positions()[c]};
    const std::array<double, 3> strain = greenStrain(rest, {x[a], x[b], x[c]}),
                                stress = stressOf(sheetModuli(material), strain);
    const double area = 0.5 * length(cross(rest[1] - rest[0], rest[2] - rest[0]));
    for (std::size_t k = 0; k < 3; ++k) energy += 0.5 * area * stress[k] * strain[k];
  }
  return energy;
}

}  // namespace clothsim::test

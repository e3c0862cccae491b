// The material model: it turns what is measured of a fabric into springs of a lattice, so that drape, sag and
// the time they take do not change with the resolution (docs/physics.md). Also how long an explicit step may
// be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

// Whether some cloth has a material.
[[nodiscard]] bool usesMaterial(const Scene& scene);

// The material of a preset's name; none for an unknown name.
[[nodiscard]] std::optional<Material> materialPreset(std::string_view name);
[[nodiscard]] std::vector<std::string> materialPresetNames();

// Gives the cloth a material, and takes back to their defaults the settings that a material replaces.
void giveMaterial(ClothSettings& cloth, const Material& material);

// The distance of neighbouring points [m] where `points` of them share a length [m].
[[nodiscard]] inline double spacing(double length, int points) {
  return points > 1 ? length / (points - 1) : 0;
}

// The elastic constants of a material in its plane, 1 along the weft and 2 along the warp [N/m]: of the
// energy 1/2 (C11 E11^2 + C22 E22^2) + C12 E11 E22 + 1/2 G (2 E12)^2 an area. C12 = G, the only choice that
// the central forces of a lattice leave, and with Y of the weft and Y' of the warp C11 = (Y + sqrt(Y^2 + 4
// G^2 Y/Y')) / 2 and C22 = C11 Y'/Y.
struct SheetModuli {
  double c11 = 0, c22 = 0, c12 = 0, shear = 0;
};
[[nodiscard]] SheetModuli sheetModuli(const Material& material);

// Springs of a lattice with cells of `dx` by `dy` [m] that stretches and shears as the material does, its
// weft along rows. All of them count half along a border of the sheet.
struct LatticeStiffness {
  double alongRow = 0, alongColumn = 0;  // structural [N/m]; below 0 when the cells are too oblong
  double diagonal = 0;                   // shear [N/m]
  // Of the energy 1/2 b |x(i-1) - 2 x(i) + x(i+1)|^2 a particle and direction [N/m].
  double bendAlongRow = 0, bendAlongColumn = 0;
};
[[nodiscard]] LatticeStiffness latticeStiffness(const Material& material, double dx, double dy);

// The length of a step with which explicit integrators are stable, whatever the cloth's shape [s]: 2 / omega,
// where omega^2 bounds the largest eigenvalue of K/m: of a grid by that of its graph, springs that resist in
// all directions; of a mesh by Gershgorin's circles over blocks. Infinite without springs.
[[nodiscard]] double stableStep(const ClothSettings& cloth);
// The same of a scene, of all cloths and the seams between them; infinite under an implicit integrator.
[[nodiscard]] double stableStep(const Scene& scene);

// Above which height an upright strip buckles under its own weight [m]: (7.84 B / rho g)^(1/3) (A. G.
// Greenhill, 1881).
[[nodiscard]] double bucklingHeight(const Material& material);
// The least number of steps in a frame with which a step is no longer than the stable one, nor than 1/60 s;
// nor, under an implicit integrator where fabric is larger than its buckling height, than 1/120 s; nor
// where such fabric, or several cloths, touch each other in steps, than 1/240 s. No implicit step is longer
// than sound takes for 4.4 m of the fabric. Pressure asks for shorter ones yet (docs/physics.md).
[[nodiscard]] int stableSteps(const Scene& scene);
// Sets solver.simulation_steps and solver.cg_iterations where they are "auto".
void chooseCounts(Scene& scene);

}  // namespace clothsim

// What the user wrote: plain structs in SI units, with the defaults of CS184's program. Reading, writing,
// ranges and help texts come from the field table (scene_io/field_table.h); nothing here knows of particles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/vec.h"
#include "scene/colliders/collider.h"
#include "scene/forces/attractors.h"

namespace clothsim {

// horizontal: points lie at (u, 1, v). vertical: at (u, v, z), z a jitter of up to 0.001 m.
enum class Orientation { horizontal = 0, vertical = 1 };

struct GridPoint {
  int column = 0, row = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};
// Both ends belong to it; `from` <= `to` in column and row.
struct GridRange {
  GridPoint from, to;
  friend bool operator==(const GridRange&, const GridRange&) = default;
};
// top: row 0 of a horizontal cloth, the last row of a vertical one (its upper edge); bottom: the opposite
// row; left: column 0; right: the last column.
enum class GridSide { top, bottom, left, right };
// A vertex of a mesh, counted from 0 in the order of the file.
struct VertexPin {
  int vertex = 0;
  friend bool operator==(const VertexPin&, const VertexPin&) = default;
};
// A box; `from` <= `to` in each coordinate [m]. Its border belongs to it.
struct Region {
  Vec3d from, to;
  friend bool operator==(const Region&, const Region&) = default;
};
// All vertices of a mesh that lie in a box at the start.
struct RegionPin {
  Region region;
  friend bool operator==(const RegionPin&, const RegionPin&) = default;
};
// All vertices of a mesh that belong to faces of a group of its file.
struct GroupPin {
  std::string group;
  friend bool operator==(const GroupPin&, const GroupPin&) = default;
};
// Vertices by a channel of the colours that a mesh has in its file, 0 to 1. A pin holds those of more than
// 0.5.
enum class Paint { red, green, blue };
struct PaintedPin {
  Paint painted = Paint::red;
  friend bool operator==(const PaintedPin&, const PaintedPin&) = default;
};
using Pin = std::variant<GridPoint, GridRange, GridSide, VertexPin, RegionPin, GroupPin, PaintedPin>;

// A part of a mesh that is stiffer or softer than the rest (cloth/stiffness_map.h).
struct StiffnessPart {
  std::vector<Pin> points;       // at least one; vertices that are painted lightly count in part
  double stretch = 1, bend = 1;  // factors on the stiffness in the plane and on that of folds
  friend bool operator==(const StiffnessPart&, const StiffnessPart&) = default;
};

inline constexpr int NO_BODY = -1;  // PinMotion::collider of pins that move with none

// A path of pins. They move as one rigid body about their centre, the mean of their start positions. Times
// and rotations are like those of Motion. A path with keys that are `free` is like that of a hand, which
// takes hold of the cloth and lets go (solver/pin_paths.h).
struct PinMotion {
  struct Key {
    double t = 0;                   // [s], ascending
    std::optional<Vec3d> position;  // of the centre [m]; none: where it was at the start
    Vec3d rotation;                 // rotation vector about the centre [degrees]
    bool free = false;              // from here to the next key no pin holds them
    friend bool operator==(const Key&, const Key&) = default;
  };
  std::vector<Key> keys;
  bool loop = false;
  std::vector<Pin> pinned =
      {};  // the pins that move, which the cloth must have; empty: all pins of the cloth
  Interpolation interpolation = Interpolation::linear;
  int collider = NO_BODY;              // instead of keys: the pins move with that collider, counted from 0
  std::optional<double> release = {};  // from this time on no pin holds them [s]
  friend bool operator==(const PinMotion&, const PinMotion&) = default;
};

// What is measured of a fabric, independent of the grid. Spring constants follow from it (cloth/material.h).
struct Material {
  double density = 0.15;    // mass per area [kg/m^2]
  double stretch = 10'000;  // Young's modulus of the sheet, the bulk modulus times the thickness [N/m]
  std::optional<double> stretchWarp =
      {};                               // the same along the warp, the columns of a grid; none: as `stretch`
  double shear = 50;                    // shear modulus of the sheet [N/m]
  double bend = 1e-5;                   // bending rigidity [N m]
  std::optional<double> bendWarp = {};  // of the warp; none: as `bend`
  double damping = 0.5;                 // rate at which velocities decay [1/s]
  double thickness = 0.0005;            // [m]
  double friction = 0.4;                // Coulomb's coefficient between layers of the fabric
  friend bool operator==(const Material&, const Material&) = default;
};

// CS184's stiffness, when a cloth names none [N/m].
inline constexpr double defaultKs = 5000;

// How one cloth is drawn where that is not as the scene's `render` and its own material have it
// (cloth/material_look.h). Members are those of RenderSettings.
struct ClothLook {
  std::optional<Vec3d> color, backColor;
  std::optional<std::string> texture;  // "": none
  std::optional<double> textureRepeat;
  std::optional<std::string> weave;
  std::optional<double> threadSpacing, gloss, fuzz, normalStrength, height, thickness;
  friend bool operator==(const ClothLook&, const ClothLook&) = default;
};

struct ClothSettings {
  std::string mesh;              // an OBJ file, beside the scene file or below the resource root; "": a grid
  double scale = 1;              // metres in a unit of the mesh file
  double width = 1, height = 1;  // of a grid [m]
  int numWidthPoints = 50, numHeightPoints = 50;
  Orientation orientation = Orientation::horizontal;
  Vec3d position{0, 0, 0};  // added to every point [m]
  // Axis times angle [degrees], about grid point (0, 0) or the mesh's origin, before `position` is added.
  Vec3d rotation{0, 0, 0};
  double density = 150;        // mass per area [kg/m^2]; CS184: m = width * height * density / points
  std::optional<double> mass;  // total mass [kg]; replaces density when given
  // One of three models sets the stiffness of springs (docs/physics.md). CS184's: a constant for all, 0.2 ks
  // for bending springs [N/m].
  std::optional<double> ks;
  // CS171's: k = stiffness_reference reference_length / L [N/m].
  std::optional<double> stiffnessReference;
  double referenceLength = 0.1;  // [m]
  // A fabric. It replaces ks, density, mass, damping and thickness.
  std::optional<Material> material;
  double damping = 0.2;              // percent of the velocity that is lost in a step, as in CS184
  double thickness = 0.0095;         // [m]
  double pressure = 0;               // of the air behind the cloth above that before it [Pa]
  double shrink = 0;                 // part of their length that all springs lose; below 0 they grow
  std::optional<double> tearStrain;  // l/L - 1 beyond which springs tear (solver/tearing.h)
  bool enableStructural = true, enableShearing = true, enableBending = true;
  std::vector<StiffnessPart> stiffnessMap;  // of a mesh; where parts overlap their factors multiply
  std::vector<Pin> pinned;
  std::vector<PinMotion> pinMotion;  // A pin is moved by one of these at most, and otherwise stays.
  ClothLook render;
  [[nodiscard]] bool isMesh() const { return !mesh.empty(); }
  [[nodiscard]] double thicknessInUse() const { return material ? material->thickness : thickness; }  // [m]
  friend bool operator==(const ClothSettings&, const ClothSettings&) = default;
};

// A side of a seam: points of a cloth. On a grid they are lines, sewn one behind the other.
struct SeamSide {
  int cloth = 0;            // which of the scene's
  std::vector<Pin> points;  // at least one
  bool reverse = false;     // sewn from its last point to its first
  friend bool operator==(const SeamSide&, const SeamSide&) = default;
};
// Springs between the points of two sides (cloth/seams.h), whose rest length falls from what is between them
// at the start to 0.
struct Seam {
  SeamSide a, b;
  double time = 0.5;                // until it is closed [s]
  std::optional<double> stiffness;  // of a spring; none: of the stiffest spring of both cloths [N/m]
  friend bool operator==(const Seam&, const Seam&) = default;
};

struct Gust {
  double strength = 0;     // standard deviation of the speed along the wind's direction [m/s]
  double frequency = 0.5;  // [Hz]
  int seed = 1;
  friend bool operator==(const Gust&, const Gust&) = default;
};

struct Wind {
  Vec3d velocity{0, 0, 0};  // [m/s]
  Gust gust;
  double drag = 1.2;        // coefficient of the pressure along the triangle's normal
  double lift = 0;          // coefficient of the force across the relative wind
  double airDensity = 1.2;  // [kg/m^3]
  friend bool operator==(const Wind&, const Wind&) = default;
};

// verlet: leapfrog. euler: symplectic Euler. implicit: backward Euler, stable at any step. bdf2: the backward
// difference of second order, which keeps a swing alive (docs/physics.md).
enum class Integrator { verlet, euler, implicit, bdf2 };
inline constexpr int INTEGRATOR_COUNT = 4;
// Their words, in files and in what is printed.
inline constexpr std::array<const char*, INTEGRATOR_COUNT> integratorNames{"verlet", "euler", "implicit",
                                                                           "bdf2"};
[[nodiscard]] inline const char* integratorName(Integrator integrator) {
  return integratorNames[static_cast<std::size_t>(integrator)];
}
// Whether a step solves for the positions at its end (solver/implicit.h).
[[nodiscard]] inline bool isImplicit(Integrator integrator) {
  return integrator == Integrator::implicit || integrator == Integrator::bdf2;
}

// averaged: CS184's rule, particles nearer than 2 thickness move apart by the mean over their contacts.
// robust: no non-adjacent pair of particles comes so near that triangles could cross
// (solver/self_collision.h).
// contact: of implicit steps; layers touch at the thickness of the fabric, inside the step, and no parts of
// the surface cross (solver/surface.h).
enum class SelfCollision { off, averaged, robust, contact };
// Their words; files have `false` for "off".
inline constexpr std::array<const char*, 4> selfCollisionNames{"off", "averaged", "robust", "contact"};
[[nodiscard]] inline const char* selfCollisionName(SelfCollision mode) {
  return selfCollisionNames[static_cast<std::size_t>(mode)];
}

// What a collider's `friction` means (docs/physics.md). cs184: the part of its motion that a touching
// particle loses. coulomb: the coefficient of friction; planes are then solid behind their normal.
enum class FrictionLaw { cs184, coulomb };

// A count that is given, or that follows from the rest of the scene ("auto").
struct AutoCount {
  int count = 1;
  bool automatic = false;

  AutoCount(int number) : count(number) {}
  AutoCount(int number, bool isAutomatic) : count(number), automatic(isAutomatic) {}
  operator int() const { return count; }
  friend bool operator==(const AutoCount&, const AutoCount&) = default;
  friend bool operator==(const AutoCount& a, int b) { return a.count == b; }
};

struct SolverSettings {
  Integrator integrator = Integrator::verlet;  // implicit in scenes with a material
  double framesPerSec = 90;                    // [1/s]
  // Steps in a frame: h = 1 / (frames_per_sec * simulation_steps). Automatic in scenes with a material.
  AutoCount simulationSteps = 30;
  // Of `implicit`: the last update of a step, as part of its motion or, if that is larger, of a tenth of the
  // spacing.
  double tolerance = 1e-2;
  int newtonSteps = 40;                 // most Newton steps in a step
  AutoCount cgIterations = {20, true};  // most iterations of conjugate gradients in a Newton step
  // The largest l/L - 1 of a spring after the limiter; none: no limiter. 0.1 in scenes with `ks`.
  std::optional<double> strainLimit;
  SelfCollision selfCollision = SelfCollision::off;  // averaged in scenes with `ks`, as CS184 does
  // Coulomb's coefficient between layers, under robust self-collision; none: that of the material, or 0.3.
  std::optional<double> selfFriction;
  FrictionLaw frictionLaw = FrictionLaw::cs184;
  // Limits of the watchdog, beyond which a run stops. No cloth comes near them, and an unstable one passes
  // them within a few steps.
  double maxSpeed = 10'000;  // of a particle [m/s]
  double maxStrain = 100;    // l/L - 1 of a spring, with L its nominal rest length
  friend bool operator==(const SolverSettings&, const SolverSettings&) = default;
};

// Without position and target the camera frames the scene by itself.
struct CameraSettings {
  std::optional<Vec3d> position, target;  // [m]
  double fov = 35;                        // vertical field of view [degrees]
  double aperture = 0;                    // diameter of the lens [m]; 0: all is sharp
  double shutter = 0;                     // how long it is open, around the time of the picture [s]
  std::optional<double> focus;            // distance that is sharp [m]; none: that of the target
  friend bool operator==(const CameraSettings&, const CameraSettings&) = default;
};

// The values of render.shader, render.weave, render.stage and render.background.
inline constexpr std::array<std::string_view, 10> shadingModels{
    "fabric",       "phong",  "diffuse", "texture",   "bump",
    "displacement", "mirror", "normal",  "wireframe", "strain"};
inline constexpr std::array<std::string_view, 7> weaves{"plain",  "twill",  "denim", "satin",
                                                        "jersey", "velvet", "none"};
inline constexpr std::array<std::string_view, 5> stages{"studio", "table", "window", "dark", "none"};
inline constexpr std::array<std::string_view, 3> backgrounds{"studio", "sky", "plain"};

struct RenderSettings {
  std::string shader = "fabric";
  // Those of scenes without a material; others have the look of theirs (cloth/material_look.h).
  Vec3d color{0.70, 0.10, 0.12};      // front of the cloth, of denim its warp; sRGB 0 to 1
  Vec3d backColor{0.86, 0.70, 0.46};  // back of the cloth, of denim its weft
  std::string texture;                // bundled name, or path of a PNG; "": the shading model's own
  double textureRepeat = 1;           // along the longer side of each cloth
  std::string weave = "plain";        // of fabric
  double threadSpacing = 0.0015;      // of fabric, from thread to thread [m]
  double gloss = 0.3;                 // of fabric: 0 wool, 1 silk
  double fuzz = 0;                    // of fabric, how far loose fibres stand off it [m]
  double normalStrength = 1;          // of weaves and bumps: 0 flat, 1 as high as they are
  double height = 0.012;              // of bump and displacement maps, from black to white [m]
  double strainRange = 0.1;           // l/L - 1 at the end of the strain map's scale
  std::optional<Vec3d> light;         // direction towards the main light; none: the upper left of the front
  double lightSize = 9;               // angle of the main light's disc, seen from the scene [degrees]
  // Where the scene stands, with its ground and its light (render/stage_look.h).
  std::string stage = "studio";
  std::string background = "studio";        // studio: that of the stage
  Vec3d backgroundColor{0.62, 0.67, 0.72};  // of the plain background
  std::optional<double> thickness;  // of the cloth as it is drawn [m]; none: its own, but in draft quality
  bool smooth = true;               // draw a smooth surface through the particles, but in draft quality
  bool ground = true;               // draw a floor below everything when the scene has no horizontal plane
  friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

struct Range {
  double low = 0, high = 0;
  friend bool operator==(const Range&, const Range&) = default;
};

// What a bundled scene promises after `frames` frames on either backend. The tests in tests/scenes hold it.
struct Expect {
  int frames = 0;
  std::optional<Vec3d> centroid;    // [m]
  double centroidTolerance = 0.01;  // [m], each coordinate
  std::optional<Range> minY, maxStrain, kineticEnergy, maxPenetration, crossings;
  friend bool operator==(const Expect&, const Expect&) = default;
};

struct Scene {
  std::string schema = "clothsim/1";
  std::string name, description;
  std::vector<ClothSettings> cloths{ClothSettings{}};  // at least one; a single one is `cloth` in JSON
  std::vector<Seam> seams;                             // at most MOST_SEAMS
  std::vector<Collider> colliders;                     // also those of CS184's `sphere` and `plane` objects
  Vec3d gravity{0, -9.8, 0};                           // [m/s^2]
  std::optional<Wind> wind;                            // none: no forces of the air on triangles
  std::vector<Attractor> attractors;                   // at most MOST_ATTRACTORS
  double airResistance = 0;                            // a of the force -a |v| v on each particle [kg/m]
  SolverSettings solver;
  CameraSettings camera;
  RenderSettings render;
  std::optional<Expect> expect;
  friend bool operator==(const Scene&, const Scene&) = default;
};

// Whether the air acts on triangles.
[[nodiscard]] inline bool hasAir(const Scene& scene) {
  return scene.wind || std::any_of(scene.cloths.begin(), scene.cloths.end(),
                                   [](const ClothSettings& cloth) { return cloth.pressure != 0; });
}

// Whether render.texture is the path of a file rather than the name of a bundled texture.
[[nodiscard]] inline bool isTexturePath(std::string_view texture) {
  return texture.find('/') != texture.npos || texture.ends_with(".png");
}

// Length of one step [s].
[[nodiscard]] inline double stepLength(const SolverSettings& solver) {
  return 1.0 / (solver.framesPerSec * solver.simulationSteps);
}

}  // namespace clothsim

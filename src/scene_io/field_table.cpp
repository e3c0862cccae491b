// The table of scene keys: names, units, ranges and help texts. The order is that of the written file.
#include "scene_io/field_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene_io/json_tree.h"

namespace clothsim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Limits gridSide{.low = smallestSide, .high = largestSide};

}  // namespace

template <>
std::span<const Field<Scene>> fieldsOf<Scene>() {
  static const std::array fields{
      field("schema", &Scene::schema, "Version of the format: \"clothsim/1\".").alwaysWritten(),
      field("name", &Scene::name, "Short name for titles and lists."),
      field("description", &Scene::description, "One sentence about the scene."),
      field("cloths", &Scene::cloths,
            "The cloths, one object each; a single one may be the object `cloth`, as in CS184.")
          .required()
          .rebuilds(),
      field("seams", &Scene::seams, "Borders that are sewn together, of two cloths or of one.")
          .within({.high = MOST_SEAMS})
          .rebuilds(),
      field("colliders", &Scene::colliders,
            "CS184's `plane` and `sphere` come first. Implicit steps keep thin shapes, not meshes, from "
            "slipping through."),
      field("gravity", &Scene::gravity, "Acceleration of every free particle.").in("m/s^2").usually(-20, 20),
      field("wind", &Scene::wind, "Air that moves past the cloth; without it no wind forces are computed."),
      field("air_resistance", &Scene::airResistance,
            "Factor a of the force -a |v| v on each particle, as in CS171.")
          .in("kg/m")
          .within(notNegative)
          .usually(0, 0.01),
      field("attractors", &Scene::attractors, "Points that pull the cloth or push it, in a ball around each.")
          .within({.high = MOST_ATTRACTORS}),
      field("solver", &Scene::solver,
            "Time integration: integrator, steps, strain limit, contacts, watchdog."),
      field("camera", &Scene::camera,
            "The camera; without a position it shows the whole scene from the front."),
      field("render", &Scene::render, "Appearance: shading model, colours, weave, light, background."),
      field("expect", &Scene::expect, "Expected results of a run, checked by the tests."),
  };
  return fields;
}

template <>
std::span<const Field<ClothSettings>> fieldsOf<ClothSettings>() {
  using C = ClothSettings;
  static const std::array fields{
      field("mesh", &C::mesh,
            "OBJ file for a cloth that is not a grid; looked up beside the scene file, then in clothsim's "
            "folder.")
          .byDefault("none: a grid")
          .rebuilds(),
      field("scale", &C::scale, "Metres per unit of the cloth's mesh file.")
          .within(positive)
          .usually(0.01, 10)
          .rebuilds(),
      field("width", &C::width, "Length along the rows (x, before rotation).")
          .in("m")
          .within(positive)
          .usually(0.1, 4)
          .rebuilds(),
      field("height", &C::height,
            "Length along the columns (z of a lying cloth, y of a standing one, before rotation).")
          .in("m")
          .within(positive)
          .usually(0.1, 4)
          .rebuilds(),
      field("num_width_points", &C::numWidthPoints, "Grid points per row.")
          .within(gridSide)
          .usually(4, 512)
          .rebuilds(),
      field("num_height_points", &C::numHeightPoints, "Grid points per column.")
          .within(gridSide)
          .usually(4, 512)
          .rebuilds(),
      field("orientation", &C::orientation,
            "Lying at y = 1 m, row 0 at z = 0; or standing at z = 0, facing +z, with row 0 at the bottom.")
          .rebuilds(),
      field("position", &C::position, "Offset added to every point.").in("m").rebuilds(),
      field("rotation", &C::rotation,
            "Rotation about grid point [0, 0] or the mesh's origin: axis times angle.")
          .in("degrees")
          .rebuilds(),
      field("density", &C::density,
            "Mass per area; the mass of a particle is width * height * density / points.")
          .in("kg/m^2")
          .within(positive)
          .usually(1, 1000)
          .rebuilds(),
      field("mass", &C::mass, "Total mass, instead of density.")
          .in("kg")
          .within(positive)
          .usually(0.01, 100)
          .rebuilds(),
      field("ks", &C::ks, "Spring constant; 0.2 ks for bending springs (CS184's model).")
          .in("N/m")
          .within(positive)
          .usually(50, 50000)
          .byDefault("5000, unless stiffness_reference is given")
          .rebuilds(),
      field("stiffness_reference", &C::stiffnessReference,
            "Instead of ks: spring constant stiffness_reference * reference_length / length (CS171's model).")
          .in("N/m")
          .within(positive)
          .usually(1, 1000)
          .rebuilds(),
      field("reference_length", &C::referenceLength,
            "Length of a spring whose constant is stiffness_reference; independent of the resolution.")
          .in("m")
          .within(positive)
          .usually(0.01, 1)
          .rebuilds(),
      field("material", &C::material,
            "A fabric in SI units, or a preset's name; replaces ks, density, mass, damping and thickness.")
          .rebuilds(),
      field("damping", &C::damping, "Velocity lost per step; with the implicit integrator, per 1/2700 s.")
          .in("%")
          .within({.low = 0, .high = 100})
          .usually(0, 2),
      field("thickness", &C::thickness,
            "Particles stay 2 thickness apart (averaged) or at least 1 (robust), layers 1 (contact).")
          .in("m")
          .within(notNegative)
          .usually(0.001, 0.1)
          .rebuilds(),
      field("pressure", &C::pressure,
            "Pressure of the air behind the cloth above that in front; fills a closed mesh that faces "
            "outwards.")
          .in("Pa")
          .usually(-100, 100),
      field("shrink", &C::shrink, "Part by which all springs rest shorter than they are made; < 0: longer.")
          .within({.low = -0.5, .high = 0.9})
          .usually(-0.2, 0.5)
          .rebuilds(),
      field("tear_strain", &C::tearStrain,
            "A spring or mesh edge stretched beyond this strain (l/L - 1) tears. Checked after each frame.")
          .within(positive)
          .usually(0.05, 1)
          .byDefault("none: nothing tears"),
      field("enable_structural", &C::enableStructural,
            "Springs to left and upper neighbours; along the edges of a mesh.")
          .rebuilds(),
      field("enable_shearing", &C::enableShearing, "Springs to diagonal neighbours.").rebuilds(),
      field("enable_bending", &C::enableBending,
            "Springs to the second neighbours left and above; across the edges of a mesh.")
          .rebuilds(),
      field("stiffness_map", &C::stiffnessMap,
            "Parts of a mesh that are stiffer or softer; where they overlap their factors multiply.")
          .rebuilds(),
      field("pinned", &C::pinned,
            "Points held in place: [column, row] from 0 (row 0: bottom of a standing cloth), sides, mesh "
            "vertices.")
          .rebuilds(),
      field("pin_motion", &C::pinMotion,
            "A path in time for the pins, or a list of paths with the pins that follow each; live if none "
            "lets go.")
          .byDefault("none"),
      field("render", &C::render, "How this cloth is drawn where it differs from the scene's `render`."),
  };
  return fields;
}

template <>
std::span<const Field<Material>> fieldsOf<Material>() {
  using M = Material;
  static const std::array fields{
      field("density", &M::density, "Mass per area.")
          .in("kg/m^2")
          .within(positive)
          .rebuilds()
          .alwaysWritten(),
      field("stretch", &M::stretch, "Young's modulus of the sheet: of the fabric, times its thickness.")
          .in("N/m")
          .within(positive)
          .rebuilds()
          .alwaysWritten(),
      field("stretch_warp", &M::stretchWarp,
            "Young's modulus along the warp: columns of a grid, v of a mesh's texture; stretch is along the "
            "weft.")
          .in("N/m")
          .within(positive)
          .byDefault("as stretch")
          .rebuilds(),
      field("shear", &M::shear,
            "Shear modulus of the sheet; far smaller than stretch in woven cloth. What hardly shears is "
            "better a mesh.")
          .in("N/m")
          .within(positive)
          .rebuilds()
          .alwaysWritten(),
      field("bend", &M::bend, "Bending rigidity: moment per width and curvature.")
          .in("N m")
          .within(notNegative)
          .rebuilds()
          .alwaysWritten(),
      field("bend_warp", &M::bendWarp, "Bending rigidity of the warp; bend is then that of the weft.")
          .in("N m")
          .within(notNegative)
          .byDefault("as bend")
          .rebuilds(),
      field("damping", &M::damping, "Rate at which motion decays, as exp(-damping t).")
          .in("1/s")
          .within(notNegative)
          .alwaysWritten(),
      field("thickness", &M::thickness,
            "Thickness of the fabric, at which layers meet; where cells are too fine for it, a warning says "
            "so.")
          .in("m")
          .within(notNegative)
          .rebuilds()
          .alwaysWritten(),
      field("friction", &M::friction, "Coulomb's coefficient between layers of the fabric.")
          .within({.low = 0, .high = 10})
          .alwaysWritten(),
  };
  return fields;
}

template <>
std::span<const Field<Motion>> fieldsOf<Motion>() {
  static const std::array fields{
      field("keys", &Motion::keys, "Keys along the path.").required(),
      field("loop", &Motion::loop, "Repeat after the last key; otherwise stop there."),
      field("interpolation", &Motion::interpolation, "Between keys: linear, or cubic, without kinks."),
  };
  return fields;
}

template <>
std::span<const Field<Motion::Key>> fieldsOf<Motion::Key>() {
  using K = Motion::Key;
  static const std::array fields{
      field("t", &K::t, "Time of the key, later than the one before.").in("s").within(notNegative).required(),
      field("position", &K::position,
            "Position of the collider's origin, or the plane's point, at that time.")
          .in("m")
          .alwaysWritten()
          .byDefault("the collider's own place"),
      field("rotation", &K::rotation, "Rotation: axis times angle; may exceed 360.").in("degrees"),
  };
  return fields;
}

template <>
std::span<const Field<Wind>> fieldsOf<Wind>() {
  static const std::array fields{
      field("velocity", &Wind::velocity,
            "Steady wind; forces depend on the velocity relative to each triangle.")
          .in("m/s")
          .usually(-10, 10),
      field("gust", &Wind::gust,
            "Random variation of the wind speed along its direction, identical in every run."),
      field("drag", &Wind::drag, "Coefficient of the pressure along a triangle's normal.")
          .within(notNegative)
          .usually(0, 3),
      field("lift", &Wind::lift, "Coefficient of the force perpendicular to the relative wind.")
          .within(notNegative)
          .usually(0, 3),
      field("air_density", &Wind::airDensity, "Density of the air; drag and lift grow with it.")
          .in("kg/m^3")
          .within(notNegative)
          .usually(0, 2),
  };
  return fields;
}

template <>
std::span<const Field<Gust>> fieldsOf<Gust>() {
  static const std::array fields{
      field("strength", &Gust::strength, "Standard deviation of the speed; 0 is a steady wind.")
          .in("m/s")
          .within(notNegative)
          .usually(0, 10),
      field("frequency", &Gust::frequency, "Approximate number of gusts per second.")
          .in("Hz")
          .within(positive)
          .usually(0.05, 5),
      field("seed", &Gust::seed, "The same seed gives the same gusts.").within(notNegative).usually(1, 100),
  };
  return fields;
}

template <>
std::span<const Field<SolverSettings>> fieldsOf<SolverSettings>() {
  using S = SolverSettings;
  static const std::array fields{
      field("integrator", &S::integrator,
            "Leapfrog Verlet; symplectic Euler; implicit: backward Euler, stable at any step; bdf2: of "
            "second order.")
          .byDefault("\"verlet\"; in scenes with a material \"implicit\""),
      field("tolerance", &S::tolerance,
            "An implicit step is solved when its last update is this part of the motion in it.")
          .within({.low = 1e-6, .high = 1})
          .usually(1e-4, 1e-2),
      field("newton_steps", &S::newtonSteps, "Most Newton steps in an implicit step.")
          .within({.low = 1, .high = 100})
          .usually(1, 40),
      field("cg_iterations", &S::cgIterations,
            "Most CG iterations in a Newton step; auto: 20 to 60 by step length and contact, fivefold after "
            "the "
            "11th.")
          .within({.low = 1, .high = 10'000})
          .usually(1, 60),
      field("frames_per_sec", &S::framesPerSec,
            "Frames per simulated second; states and pictures are taken at the end of a frame.")
          .in("1/s")
          .within({.low = 0, .high = 1e6, .lowOpen = true})
          .usually(15, 240),
      field(
          "simulation_steps", &S::simulationSteps,
          "Steps in a frame; auto: as few as are stable, 1/120 to 1/240 s for folds, less if stiff or under "
          "pressure.")
          .within({.low = 1, .high = mostSteps})
          .usually(1, 200)
          .byDefault("30; in scenes with a material \"auto\""),
      field("strain_limit", &S::strainLimit,
            "Largest allowed strain l/L - 1: a pass after each step; a second, stiff spring with implicit.")
          .within(notNegative)
          .usually(0, 0.5)
          .as(Format::orFalse)
          .byDefault("0.1 in scenes with ks, else false"),
      field(
          "self_collision", &S::selfCollision,
          "Keeps layers apart. averaged: CS184's rule, leaks; robust: does not; contact: in implicit steps.")
          .byDefault("contact in implicit steps with a material, averaged in other scenes with ks, robust in "
                     "other scenes with a material, else false; true: this default, or robust where it is "
                     "false"),
      field("self_friction", &S::selfFriction,
            "Coulomb's coefficient of friction between layers of cloth, under robust and contact.")
          .within({.low = 0, .high = 10})
          .usually(0, 1)
          .byDefault("the material's, else 0.3"),
      field("friction_law", &S::frictionLaw,
            "Meaning of a collider's friction: CS184's factor or Coulomb's coefficient.")
          .byDefault("\"cs184\"; in scenes with a material \"coulomb\""),
      field("max_speed", &S::maxSpeed, "A run in which a particle is faster is stopped.")
          .in("m/s")
          .within(positive)
          .usually(1, 10000),
      field("max_strain", &S::maxStrain, "A run in which a spring's l/L - 1 is larger is stopped.")
          .within(positive)
          .usually(0.1, 100),
  };
  return fields;
}

template <>
std::span<const Field<CameraSettings>> fieldsOf<CameraSettings>() {
  using C = CameraSettings;
  static const std::array fields{
      field("position", &C::position, "Position of the camera.")
          .in("m")
          .byDefault("automatic: the whole scene from the front"),
      field("target", &C::target,
            "The point in the middle of the picture, about which the viewer's camera orbits.")
          .in("m")
          .byDefault("middle of the scene"),
      field("fov", &C::fov,
            "Vertical field of view; small values act as a telephoto lens, large ones as a wide angle.")
          .in("degrees")
          .within({.low = 1, .high = 170})
          .usually(15, 90),
      field("aperture", &C::aperture, "Diameter of the lens, in final quality; 0: everything is sharp.")
          .in("m")
          .within(notNegative)
          .usually(0, 0.1),
      field(
          "shutter", &C::shutter,
          "How long the shutter is open, in final quality; 0: sharp. Videos: half the time between pictures.")
          .in("s")
          .within(notNegative)
          .usually(0, 0.1),
      field("focus", &C::focus, "Distance at which the picture is sharp.")
          .in("m")
          .within(positive)
          .byDefault("that of the target"),
  };
  return fields;
}

template <>
std::span<const Field<Expect>> fieldsOf<Expect>() {
  using E = Expect;
  static const std::array fields{
      field("frames", &E::frames, "Number of frames to run.").within({.low = 1, .high = 1e6}).required(),
      field("centroid", &E::centroid, "Mean position of all particles.").in("m"),
      field("centroid_tolerance", &E::centroidTolerance, "Tolerance of each coordinate of the centroid.")
          .in("m")
          .within(positive),
      field("min_y", &E::minY, "Height of the lowest particle: [minimum, maximum].").in("m"),
      field("max_strain", &E::maxStrain, "Largest l/L - 1 of all springs: [minimum, maximum]."),
      field("kinetic_energy", &E::kineticEnergy, "Kinetic energy of all particles: [minimum, maximum].")
          .in("J"),
      field("max_penetration", &E::maxPenetration,
            "Largest depth of a particle inside a collider over the run: [minimum, maximum].")
          .in("m"),
      field("crossings", &E::crossings,
            "Largest number of intersecting pairs of triangles in any frame: [minimum, maximum]."),
  };
  return fields;
}

Usual sliderRange(const FieldTraits& traits, double now) {
  if (traits.usual.low < traits.usual.high) return traits.usual;
  const Limits& limits = traits.limits;
  const double span = now == 0 ? 1 : 10 * std::abs(now);
  return {limits.low > -infinite ? limits.low : -span, limits.high < infinite ? limits.high : span};
}

bool within(const Limits& limits, double value) {
  return value <= limits.high && (limits.lowOpen ? value > limits.low : value >= limits.low);
}

std::string limitsText(const Limits& limits) {
  if (limits.nonZero) return "not [0, 0, 0]";
  const bool hasLow = limits.low > -infinite, hasHigh = limits.high < infinite;
  if (hasLow && hasHigh && !limits.lowOpen)
    return formatNumber(limits.low) + " to " + formatNumber(limits.high);
  std::string text;
  if (hasLow) text = (limits.lowOpen ? "> " : ">= ") + formatNumber(limits.low);
  if (hasHigh) text += (hasLow ? " and <= " : "<= ") + formatNumber(limits.high);
  return text;
}

}  // namespace clothsim

// The table of scene keys: names, units, ranges and help texts. The order is that of the written file.
#include "scene/field_table.h"

#include <algorithm>
#include <array>

#include "scene/json_tree.h"

namespace clothsim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Limits positive{.low = 0, .lowOpen = true};
constexpr Limits notNegative{.low = 0};
constexpr Limits gridSide{.low = smallestSide, .high = largestSide};

template <class Owner, class T>
Field<Owner> field(std::string_view key, T Owner::*member, std::string_view help) {
  return {key, member, help};
}

}  // namespace

template <>
std::span<const Field<Scene>> fieldsOf<Scene>() {
  static const std::array fields{
      field("schema", &Scene::schema, "Version of the format; \"clothsim/1\".").alwaysWritten(),
      field("name", &Scene::name, "Short name for titles and lists."),
      field("description", &Scene::description, "What there is to see, in a sentence."),
      field("cloths", &Scene::cloths,
            "The cloths, one object each; a single one may be the object `cloth`, as in CS184.")
          .required()
          .rebuilds(),
      field("colliders", &Scene::colliders,
            "Spheres and planes; CS184's objects `plane` and `sphere` come before this list, in that order."),
      field("gravity", &Scene::gravity, "Acceleration of every free particle.").in("m/s^2"),
      field("wind", &Scene::wind, "Air that moves past the cloth; without it no wind forces are computed."),
      field("air_resistance", &Scene::airResistance,
            "Factor a of the force -a |v| v on each particle, as in CS171.")
          .in("kg/m")
          .within(notNegative),
      field("solver", &Scene::solver, "How time advances."),
      field("camera", &Scene::camera,
            "Where the picture is taken from; without a position it frames the scene."),
      field("render", &Scene::render, "Looks."),
      field("expect", &Scene::expect, "What a run of the scene must show; the tests check it."),
  };
  return fields;
}

template <>
std::span<const Field<ClothSettings>> fieldsOf<ClothSettings>() {
  using C = ClothSettings;
  static const std::array fields{
      field("width", &C::width, "Length along x, before turning.").in("m").within(positive).rebuilds(),
      field("height", &C::height, "Length along the columns.").in("m").within(positive).rebuilds(),
      field("num_width_points", &C::numWidthPoints, "Grid points in a row.").within(gridSide).rebuilds(),
      field("num_height_points", &C::numHeightPoints, "Grid points in a column.").within(gridSide).rebuilds(),
      field("orientation", &C::orientation, "Lying at y = 1 m, or standing in the plane z = 0.").rebuilds(),
      field("position", &C::position, "Added to every point.").in("m").rebuilds(),
      field("rotation", &C::rotation, "Turn about grid point (0, 0): axis times angle.")
          .in("degrees")
          .rebuilds(),
      field("density", &C::density, "Mass per area; a particle weighs width * height * density / points.")
          .in("kg/m^2")
          .within(positive)
          .rebuilds(),
      field("mass", &C::mass, "Total mass; replaces density.").in("kg").within(positive).rebuilds(),
      field("ks", &C::ks, "Spring constant, bending springs 0.2 ks (CS184's model).")
          .in("N/m")
          .within(positive)
          .byDefault("5000, unless stiffness_reference is given")
          .rebuilds(),
      field("stiffness_reference", &C::stiffnessReference,
            "Instead of ks: springs of stiffness_reference * reference_length / length (CS171's model).")
          .in("N/m")
          .within(positive)
          .rebuilds(),
      field("reference_length", &C::referenceLength,
            "Length at which a spring has the stiffness reference; does not follow the resolution.")
          .in("m")
          .within(positive)
          .rebuilds(),
      field("damping", &C::damping, "Velocity lost in a step.").in("%").within({.low = 0, .high = 100}),
      field("thickness", &C::thickness, "Half the distance that self-collision keeps between particles.")
          .in("m")
          .within(notNegative)
          .rebuilds(),
      field("enable_structural", &C::enableStructural, "Springs to left and upper neighbours.").rebuilds(),
      field("enable_shearing", &C::enableShearing, "Springs to diagonal neighbours.").rebuilds(),
      field("enable_bending", &C::enableBending, "Springs to the second neighbours left and above.")
          .rebuilds(),
      field("pinned", &C::pinned, "Points that never move; [column, row] counted from 0.").rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<GridRange>> fieldsOf<GridRange>() {
  static const std::array fields{
      field("from", &GridRange::from, "First [column, row] of a block of points.").required().rebuilds(),
      field("to", &GridRange::to, "Last [column, row], pinned too.").required().rebuilds(),
  };
  return fields;
}

template <>
std::span<const Field<Sphere>> fieldsOf<Sphere>() {
  static const std::array fields{
      field("origin", &Sphere::origin, "Centre of a sphere.").in("m"),
      field("radius", &Sphere::radius, "Radius of a sphere.").in("m").within(positive),
      field("friction", &Sphere::friction, "0 slides, 1 sticks (CS184's factor).")
          .within({.low = 0, .high = 1}),
      field("motion", &Sphere::motion, "A path in time."),
  };
  return fields;
}

template <>
std::span<const Field<Plane>> fieldsOf<Plane>() {
  static const std::array fields{
      field("point", &Plane::point, "Any point of a plane.").in("m"),
      field("normal", &Plane::normal, "Direction across a plane, of any length.").within({.nonZero = true}),
      field("friction", &Plane::friction, "0 slides, 1 sticks (CS184's factor).")
          .within({.low = 0, .high = 1}),
      field("motion", &Plane::motion, "A path in time."),
  };
  return fields;
}

template <>
std::span<const Field<Motion>> fieldsOf<Motion>() {
  static const std::array fields{
      field("keys", &Motion::keys, "Places along the path; straight lines in between.").required(),
      field("loop", &Motion::loop, "Begin again after the last key; otherwise stop there."),
  };
  return fields;
}

template <>
std::span<const Field<Motion::Key>> fieldsOf<Motion::Key>() {
  using K = Motion::Key;
  static const std::array fields{
      field("t", &K::t, "Time of the key, later than the one before.").in("s").within(notNegative).required(),
      field("position", &K::position, "Where the sphere's centre or the plane's point is then.")
          .in("m")
          .alwaysWritten()
          .byDefault("the collider's own place"),
      field("rotation", &K::rotation, "Turn: axis times angle; may exceed 360.").in("degrees"),
  };
  return fields;
}

template <>
std::span<const Field<Wind>> fieldsOf<Wind>() {
  static const std::array fields{
      field("velocity", &Wind::velocity, "Steady wind.").in("m/s"),
      field("gust", &Wind::gust, "Random change of the wind's speed along its direction."),
      field("drag", &Wind::drag, "Coefficient of the pressure along a triangle's normal.")
          .within(notNegative),
      field("lift", &Wind::lift, "Coefficient of the force across the relative wind.").within(notNegative),
      field("air_density", &Wind::airDensity, "Density of the air.").in("kg/m^3").within(notNegative),
  };
  return fields;
}

template <>
std::span<const Field<Gust>> fieldsOf<Gust>() {
  static const std::array fields{
      field("strength", &Gust::strength, "Standard deviation of the speed.").in("m/s").within(notNegative),
      field("frequency", &Gust::frequency, "How often gusts come.").in("Hz").within(positive),
      field("seed", &Gust::seed, "The same seed gives the same gusts.").within(notNegative),
  };
  return fields;
}

template <>
std::span<const Field<SolverSettings>> fieldsOf<SolverSettings>() {
  using S = SolverSettings;
  static const std::array fields{
      field("integrator", &S::integrator, "Leapfrog Verlet, or symplectic Euler."),
      field("frames_per_sec", &S::framesPerSec, "Frames in a simulated second.").in("1/s").within(positive),
      field("simulation_steps", &S::simulationSteps,
            "Steps in a frame; a step lasts 1 / (frames_per_sec * simulation_steps) seconds.")
          .within({.low = 1, .high = mostSteps}),
      field("strain_limit", &S::strainLimit, "Longest stretch of a spring, l/L - 1, kept after every step.")
          .within(notNegative)
          .as(Format::orFalse)
          .byDefault("0.1 in scenes with ks, else false"),
      field("self_collision", &S::selfCollision, "Keep parts of the cloth apart from each other.")
          .byDefault("true in scenes with ks, else false"),
  };
  return fields;
}

template <>
std::span<const Field<CameraSettings>> fieldsOf<CameraSettings>() {
  using C = CameraSettings;
  static const std::array fields{
      field("position", &C::position, "The eye.").in("m").byDefault("frames the scene"),
      field("target", &C::target, "What it looks at.").in("m").byDefault("middle of the scene"),
      field("fov", &C::fov, "Vertical field of view.").in("degrees").within({.low = 1, .high = 170}),
  };
  return fields;
}

template <>
std::span<const Field<RenderSettings>> fieldsOf<RenderSettings>() {
  using R = RenderSettings;
  constexpr Limits channel{.low = 0, .high = 1};
  static const std::array fields{
      field("shader", &R::shader, "Shading model by name."),
      field("color", &R::color, "Front of the cloth.").in("sRGB").within(channel).as(Format::color),
      field("back_color", &R::backColor, "Back of the cloth.").in("sRGB").within(channel).as(Format::color),
      field("ground", &R::ground, "Draw a floor when the scene has no level plane."),
  };
  return fields;
}

template <>
std::span<const Field<Expect>> fieldsOf<Expect>() {
  using E = Expect;
  static const std::array fields{
      field("frames", &E::frames, "Frames to run before looking.").within({.low = 1, .high = 1e6}).required(),
      field("centroid", &E::centroid, "Mean of all particles.").in("m"),
      field("centroid_tolerance", &E::centroidTolerance, "For each coordinate.").in("m").within(positive),
      field("min_y", &E::minY, "Height of the lowest particle.").in("m"),
      field("max_strain", &E::maxStrain, "Largest l/L - 1 of all springs."),
      field("kinetic_energy", &E::kineticEnergy, "Of all particles.").in("J"),
      field("max_penetration", &E::maxPenetration, "Depth inside colliders over the run.").in("m"),
  };
  return fields;
}

SolverSettings solverDefaults(bool usesKs) {
  SolverSettings solver;
  if (usesKs) {
    solver.strainLimit = 0.1;
    solver.selfCollision = true;
  }
  return solver;
}

bool usesKs(const Scene& scene) {
  return std::any_of(scene.cloths.begin(), scene.cloths.end(),
                     [](const ClothSettings& cloth) { return !cloth.stiffnessReference; });
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

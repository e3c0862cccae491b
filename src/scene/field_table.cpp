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
constexpr Change live = Change::live, rebuild = Change::rebuild;

}  // namespace

template <>
std::span<const Field<Scene>> fieldsOf<Scene>() {
  static const std::array fields{
      Field<Scene>{
          {.key = "schema", .help = "Version of the format; \"clothsim/1\".", .presence = Presence::written},
          &Scene::schema},
      Field<Scene>{{.key = "name", .help = "Short name for titles and lists."}, &Scene::name},
      Field<Scene>{{.key = "description", .help = "What there is to see, in a sentence."},
                   &Scene::description},
      Field<Scene>{
          {.key = "cloths",
           .help = "The cloths, one object each; a single one may be the object `cloth`, as in CS184.",
           .change = rebuild,
           .presence = Presence::required},
          &Scene::cloths},
      Field<Scene>{{.key = "colliders",
                    .help = "Spheres and planes; CS184's objects `plane` and `sphere` come before this list, "
                            "in that order."},
                   &Scene::colliders},
      Field<Scene>{{.key = "gravity", .help = "Acceleration of every free particle.", .unit = "m/s^2"},
                   &Scene::gravity},
      Field<Scene>{
          {.key = "wind", .help = "Air that moves past the cloth; without it no wind forces are computed."},
          &Scene::wind},
      Field<Scene>{{.key = "air_resistance",
                    .help = "Factor a of the force -a |v| v on each particle, as in CS171.",
                    .unit = "kg/m",
                    .limits = notNegative},
                   &Scene::airResistance},
      Field<Scene>{{.key = "solver", .help = "How time advances."}, &Scene::solver},
      Field<Scene>{{.key = "camera",
                    .help = "Where the picture is taken from; without a position it frames the scene."},
                   &Scene::camera},
      Field<Scene>{{.key = "render", .help = "Looks."}, &Scene::render},
      Field<Scene>{{.key = "expect", .help = "What a run of the scene must show; the tests check it."},
                   &Scene::expect},
  };
  return fields;
}

template <>
std::span<const Field<ClothSettings>> fieldsOf<ClothSettings>() {
  using C = ClothSettings;
  static const std::array fields{
      Field<C>{{.key = "width",
                .help = "Length along x, before turning.",
                .unit = "m",
                .limits = positive,
                .change = rebuild},
               &C::width},
      Field<C>{{.key = "height",
                .help = "Length along the columns.",
                .unit = "m",
                .limits = positive,
                .change = rebuild},
               &C::height},
      Field<C>{
          {.key = "num_width_points", .help = "Grid points in a row.", .limits = gridSide, .change = rebuild},
          &C::numWidthPoints},
      Field<C>{{.key = "num_height_points",
                .help = "Grid points in a column.",
                .limits = gridSide,
                .change = rebuild},
               &C::numHeightPoints},
      Field<C>{{.key = "orientation",
                .help = "Lying at y = 1 m, or standing in the plane z = 0.",
                .change = rebuild},
               &C::orientation},
      Field<C>{{.key = "position", .help = "Added to every point.", .unit = "m", .change = rebuild},
               &C::position},
      Field<C>{{.key = "rotation",
                .help = "Turn about grid point (0, 0): axis times angle.",
                .unit = "degrees",
                .change = rebuild},
               &C::rotation},
      Field<C>{{.key = "density",
                .help = "Mass per area; a particle weighs width * height * density / points.",
                .unit = "kg/m^2",
                .limits = positive,
                .change = rebuild},
               &C::density},
      Field<C>{{.key = "mass",
                .help = "Total mass; replaces density.",
                .unit = "kg",
                .limits = positive,
                .change = rebuild},
               &C::mass},
      Field<C>{{.key = "ks",
                .help = "Spring constant, bending springs 0.2 ks (CS184's model).",
                .unit = "N/m",
                .limits = positive,
                .change = rebuild,
                .defaultText = "5000, unless stiffness_reference is given"},
               &C::ks},
      Field<C>{
          {.key = "stiffness_reference",
           .help =
               "Instead of ks: springs of stiffness_reference * reference_length / length (CS171's model).",
           .unit = "N/m",
           .limits = positive,
           .change = rebuild},
          &C::stiffnessReference},
      Field<C>{
          {.key = "reference_length",
           .help = "Length at which a spring has the stiffness reference; does not follow the resolution.",
           .unit = "m",
           .limits = positive,
           .change = rebuild},
          &C::referenceLength},
      Field<C>{{.key = "damping",
                .help = "Velocity lost in a step.",
                .unit = "%",
                .limits = {.low = 0, .high = 100}},
               &C::damping},
      Field<C>{{.key = "thickness",
                .help = "Half the distance that self-collision keeps between particles.",
                .unit = "m",
                .limits = notNegative,
                .change = rebuild},
               &C::thickness},
      Field<C>{
          {.key = "enable_structural", .help = "Springs to left and upper neighbours.", .change = rebuild},
          &C::enableStructural},
      Field<C>{{.key = "enable_shearing", .help = "Springs to diagonal neighbours.", .change = rebuild},
               &C::enableShearing},
      Field<C>{{.key = "enable_bending",
                .help = "Springs to the second neighbours left and above.",
                .change = rebuild},
               &C::enableBending},
      Field<C>{{.key = "pinned",
                .help = "Points that never move; [column, row] counted from 0.",
                .change = rebuild},
               &C::pinned},
  };
  return fields;
}

template <>
std::span<const Field<GridRange>> fieldsOf<GridRange>() {
  static const std::array fields{
      Field<GridRange>{{.key = "from",
                        .help = "First [column, row] of a block of points.",
                        .change = rebuild,
                        .presence = Presence::required},
                       &GridRange::from},
      Field<GridRange>{{.key = "to",
                        .help = "Last [column, row], pinned too.",
                        .change = rebuild,
                        .presence = Presence::required},
                       &GridRange::to},
  };
  return fields;
}

template <>
std::span<const Field<Sphere>> fieldsOf<Sphere>() {
  static const std::array fields{
      Field<Sphere>{{.key = "origin", .help = "Centre of a sphere.", .unit = "m"}, &Sphere::origin},
      Field<Sphere>{{.key = "radius", .help = "Radius of a sphere.", .unit = "m", .limits = positive},
                    &Sphere::radius},
      Field<Sphere>{{.key = "friction",
                     .help = "0 slides, 1 sticks (CS184's factor).",
                     .limits = {.low = 0, .high = 1}},
                    &Sphere::friction},
      Field<Sphere>{{.key = "motion", .help = "A path in time."}, &Sphere::motion},
  };
  return fields;
}

template <>
std::span<const Field<Plane>> fieldsOf<Plane>() {
  static const std::array fields{
      Field<Plane>{{.key = "point", .help = "Any point of a plane.", .unit = "m"}, &Plane::point},
      Field<Plane>{
          {.key = "normal", .help = "Direction across a plane, of any length.", .limits = {.nonZero = true}},
          &Plane::normal},
      Field<Plane>{{.key = "friction",
                    .help = "0 slides, 1 sticks (CS184's factor).",
                    .limits = {.low = 0, .high = 1}},
                   &Plane::friction},
      Field<Plane>{{.key = "motion", .help = "A path in time."}, &Plane::motion},
  };
  return fields;
}

template <>
std::span<const Field<Motion>> fieldsOf<Motion>() {
  static const std::array fields{
      Field<Motion>{{.key = "keys",
                     .help = "Places along the path; straight lines in between.",
                     .presence = Presence::required},
                    &Motion::keys},
      Field<Motion>{{.key = "loop", .help = "Begin again after the last key; otherwise stop there."},
                    &Motion::loop},
  };
  return fields;
}

template <>
std::span<const Field<Motion::Key>> fieldsOf<Motion::Key>() {
  using K = Motion::Key;
  static const std::array fields{
      Field<K>{{.key = "t",
                .help = "Time of the key, later than the one before.",
                .unit = "s",
                .limits = notNegative,
                .presence = Presence::required},
               &K::t},
      Field<K>{{.key = "position",
                .help = "Where the sphere's centre or the plane's point is then.",
                .unit = "m",
                .presence = Presence::written,
                .defaultText = "the collider's own place"},
               &K::position},
      Field<K>{{.key = "rotation", .help = "Turn: axis times angle; may exceed 360.", .unit = "degrees"},
               &K::rotation},
  };
  return fields;
}

template <>
std::span<const Field<Wind>> fieldsOf<Wind>() {
  static const std::array fields{
      Field<Wind>{{.key = "velocity", .help = "Steady wind.", .unit = "m/s"}, &Wind::velocity},
      Field<Wind>{{.key = "gust", .help = "Random change of the wind's speed along its direction."},
                  &Wind::gust},
      Field<Wind>{{.key = "drag",
                   .help = "Coefficient of the pressure along a triangle's normal.",
                   .limits = notNegative},
                  &Wind::drag},
      Field<Wind>{{.key = "lift",
                   .help = "Coefficient of the force across the relative wind.",
                   .limits = notNegative},
                  &Wind::lift},
      Field<Wind>{
          {.key = "air_density", .help = "Density of the air.", .unit = "kg/m^3", .limits = notNegative},
          &Wind::airDensity},
  };
  return fields;
}

template <>
std::span<const Field<Gust>> fieldsOf<Gust>() {
  static const std::array fields{
      Field<Gust>{{.key = "strength",
                   .help = "Standard deviation of the speed.",
                   .unit = "m/s",
                   .limits = notNegative},
                  &Gust::strength},
      Field<Gust>{{.key = "frequency", .help = "How often gusts come.", .unit = "Hz", .limits = positive},
                  &Gust::frequency},
      Field<Gust>{{.key = "seed", .help = "The same seed gives the same gusts.", .limits = notNegative},
                  &Gust::seed},
  };
  return fields;
}

template <>
std::span<const Field<SolverSettings>> fieldsOf<SolverSettings>() {
  using S = SolverSettings;
  static const std::array fields{
      Field<S>{{.key = "integrator", .help = "Leapfrog Verlet, or symplectic Euler."}, &S::integrator},
      Field<S>{{.key = "frames_per_sec",
                .help = "Frames in a simulated second.",
                .unit = "1/s",
                .limits = positive},
               &S::framesPerSec},
      Field<S>{{.key = "simulation_steps",
                .help = "Steps in a frame; a step lasts 1 / (frames_per_sec * simulation_steps) seconds.",
                .limits = {.low = 1, .high = mostSteps}},
               &S::simulationSteps},
      Field<S>{{.key = "strain_limit",
                .help = "Longest stretch of a spring, l/L - 1, kept after every step.",
                .limits = notNegative,
                .format = Format::orFalse,
                .defaultText = "0.1 in scenes with ks, else false"},
               &S::strainLimit},
      Field<S>{{.key = "self_collision",
                .help = "Keep parts of the cloth apart from each other.",
                .defaultText = "true in scenes with ks, else false"},
               &S::selfCollision},
  };
  return fields;
}

template <>
std::span<const Field<CameraSettings>> fieldsOf<CameraSettings>() {
  using C = CameraSettings;
  static const std::array fields{
      Field<C>{{.key = "position", .help = "The eye.", .unit = "m", .defaultText = "frames the scene"},
               &C::position},
      Field<C>{
          {.key = "target", .help = "What it looks at.", .unit = "m", .defaultText = "middle of the scene"},
          &C::target},
      Field<C>{{.key = "fov",
                .help = "Vertical field of view.",
                .unit = "degrees",
                .limits = {.low = 1, .high = 170}},
               &C::fov},
  };
  return fields;
}

template <>
std::span<const Field<RenderSettings>> fieldsOf<RenderSettings>() {
  using R = RenderSettings;
  constexpr Limits channel{.low = 0, .high = 1};
  static const std::array fields{
      Field<R>{{.key = "shader", .help = "Shading model by name."}, &R::shader},
      Field<R>{{.key = "color",
                .help = "Front of the cloth.",
                .unit = "sRGB",
                .limits = channel,
                .format = Format::color},
               &R::color},
      Field<R>{{.key = "back_color",
                .help = "Back of the cloth.",
                .unit = "sRGB",
                .limits = channel,
                .format = Format::color},
               &R::backColor},
      Field<R>{{.key = "ground", .help = "Draw a floor when the scene has no level plane."}, &R::ground},
  };
  return fields;
}

template <>
std::span<const Field<Expect>> fieldsOf<Expect>() {
  using E = Expect;
  static const std::array fields{
      Field<E>{{.key = "frames",
                .help = "Frames to run before looking.",
                .limits = {.low = 1, .high = 1e6},
                .presence = Presence::required},
               &E::frames},
      Field<E>{{.key = "centroid", .help = "Mean of all particles.", .unit = "m"}, &E::centroid},
      Field<E>{{.key = "centroid_tolerance", .help = "For each coordinate.", .unit = "m", .limits = positive},
               &E::centroidTolerance},
      Field<E>{{.key = "min_y", .help = "Height of the lowest particle.", .unit = "m"}, &E::minY},
      Field<E>{{.key = "max_strain", .help = "Largest l/L - 1 of all springs."}, &E::maxStrain},
      Field<E>{{.key = "kinetic_energy", .help = "Of all particles.", .unit = "J"}, &E::kineticEnergy},
      Field<E>{{.key = "max_penetration", .help = "Depth inside colliders over the run.", .unit = "m"},
               &E::maxPenetration},
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

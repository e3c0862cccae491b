// The table of scene keys: names, units, ranges and help texts. The order is that of the written file.
#include "scene/field_table.h"

#include <algorithm>
#include <array>
#include <cmath>

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

// What every collider has at the end. The upper limit of friction depends on its law (scene_tree.cpp).
template <class Shape>
Field<Shape> frictionField() {
  return field("friction", &Shape::friction,
               "0 slides; 1 sticks under cs184, which allows no more; Coulomb's coefficient under coulomb.")
      .within(notNegative)
      .usually(0, 1);
}
template <class Shape>
Field<Shape> motionField() {
  return field("motion", &Shape::motion, "A path in time, on which the collider moves as a rigid body.");
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
            "Solid shapes; CS184's objects `plane` and `sphere` come before this list, in that order."),
      field("gravity", &Scene::gravity, "Acceleration of every free particle.").in("m/s^2").usually(-20, 20),
      field("wind", &Scene::wind, "Air that moves past the cloth; without it no wind forces are computed."),
      field("air_resistance", &Scene::airResistance,
            "Factor a of the force -a |v| v on each particle, as in CS171.")
          .in("kg/m")
          .within(notNegative)
          .usually(0, 0.01),
      field("solver", &Scene::solver,
            "How time advances: integrator, steps, strain limit, contacts, watchdog."),
      field("camera", &Scene::camera,
            "Where the picture is taken from; without a position it frames the scene."),
      field("render", &Scene::render, "Looks: shading model, colours, weave, light, background."),
      field("expect", &Scene::expect, "What a run of the scene must show; the tests check it."),
  };
  return fields;
}

template <>
std::span<const Field<ClothSettings>> fieldsOf<ClothSettings>() {
  using C = ClothSettings;
  static const std::array fields{
      field("mesh", &C::mesh,
            "OBJ file of a cloth that is no grid, beside the scene file or in clothsim's own folder.")
          .byDefault("none: a grid")
          .rebuilds(),
      field("scale", &C::scale, "Metres in a unit of the cloth's mesh file.")
          .within(positive)
          .usually(0.01, 10)
          .rebuilds(),
      field("width", &C::width, "Length along x, before turning.")
          .in("m")
          .within(positive)
          .usually(0.1, 4)
          .rebuilds(),
      field("height", &C::height, "Length along the columns.")
          .in("m")
          .within(positive)
          .usually(0.1, 4)
          .rebuilds(),
      field("num_width_points", &C::numWidthPoints, "Grid points in a row.")
          .within(gridSide)
          .usually(4, 512)
          .rebuilds(),
      field("num_height_points", &C::numHeightPoints, "Grid points in a column.")
          .within(gridSide)
          .usually(4, 512)
          .rebuilds(),
      field("orientation", &C::orientation, "Lying at y = 1 m, or standing in the plane z = 0.").rebuilds(),
      field("position", &C::position, "Added to every point: where the cloth stands.").in("m").rebuilds(),
      field("rotation", &C::rotation, "Turn about grid point (0, 0), or a mesh's origin: axis times angle.")
          .in("degrees")
          .rebuilds(),
      field("density", &C::density, "Mass per area; a particle weighs width * height * density / points.")
          .in("kg/m^2")
          .within(positive)
          .usually(1, 1000)
          .rebuilds(),
      field("mass", &C::mass, "Total mass; replaces density.")
          .in("kg")
          .within(positive)
          .usually(0.01, 100)
          .rebuilds(),
      field("ks", &C::ks, "Spring constant, bending springs 0.2 ks (CS184's model).")
          .in("N/m")
          .within(positive)
          .usually(50, 50000)
          .byDefault("5000, unless stiffness_reference is given")
          .rebuilds(),
      field("stiffness_reference", &C::stiffnessReference,
            "Instead of ks: springs of stiffness_reference * reference_length / length (CS171's model).")
          .in("N/m")
          .within(positive)
          .usually(1, 1000)
          .rebuilds(),
      field("reference_length", &C::referenceLength,
            "Length at which a spring has the stiffness reference; does not follow the resolution.")
          .in("m")
          .within(positive)
          .usually(0.01, 1)
          .rebuilds(),
      field("material", &C::material,
            "Instead of ks, density, mass, damping, thickness: a fabric in SI units, or a preset's name.")
          .rebuilds(),
      field("damping", &C::damping, "Velocity lost in a step; with the implicit integrator, in 1/2700 s.")
          .in("%")
          .within({.low = 0, .high = 100})
          .usually(0, 2),
      field("thickness", &C::thickness,
            "Self-collision keeps particles 2 thickness apart (averaged), or at least 1 (robust).")
          .in("m")
          .within(notNegative)
          .usually(0.001, 0.1)
          .rebuilds(),
      field("enable_structural", &C::enableStructural,
            "Springs to left and upper neighbours; along the edges of a mesh.")
          .rebuilds(),
      field("enable_shearing", &C::enableShearing, "Springs to diagonal neighbours.").rebuilds(),
      field("enable_bending", &C::enableBending,
            "Springs to the second neighbours left and above; across the edges of a mesh.")
          .rebuilds(),
      field("pinned", &C::pinned,
            "Points that forces do not move; [column, row] or a mesh's vertex, counted from 0.")
          .rebuilds(),
      field("pin_motion", &C::pinMotion,
            "A path in time of the pins, or a list of paths with the pins that follow each.")
          .byDefault("none"),
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
      field("shear", &M::shear, "Shear modulus of the sheet; of woven cloth it is far smaller than stretch.")
          .in("N/m")
          .within(positive)
          .rebuilds()
          .alwaysWritten(),
      field("bend", &M::bend, "Bending rigidity: moment over width and curvature.")
          .in("N m")
          .within(notNegative)
          .rebuilds()
          .alwaysWritten(),
      field("damping", &M::damping, "Rate at which motion dies down, as exp(-damping t).")
          .in("1/s")
          .within(notNegative)
          .alwaysWritten(),
      field("thickness", &M::thickness, "Of the fabric; self-collision keeps layers at least so far apart.")
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
std::span<const Field<Sphere>> fieldsOf<Sphere>() {
  static const std::array fields{
      field("origin", &Sphere::origin, "Centre of a shape other than a plane.").in("m"),
      field("radius", &Sphere::radius, "Radius of a sphere or a capsule, or of the circle inside a torus.")
          .in("m")
          .within(positive)
          .usually(0.01, 1),
      frictionField<Sphere>(),
      motionField<Sphere>(),
  };
  return fields;
}

template <>
std::span<const Field<Plane>> fieldsOf<Plane>() {
  static const std::array fields{
      field("point", &Plane::point, "Any point of a plane.").in("m"),
      field("normal", &Plane::normal, "Direction across a plane, of any length.").within({.nonZero = true}),
      frictionField<Plane>(),
      motionField<Plane>(),
  };
  return fields;
}

template <>
std::span<const Field<Capsule>> fieldsOf<Capsule>() {
  static const std::array fields{
      field("origin", &Capsule::origin, "Middle of a capsule.").in("m"),
      field("axis", &Capsule::axis, "Along a capsule, or through the hole of a torus; of any length.")
          .within({.nonZero = true}),
      field("length", &Capsule::length, "Of a capsule, without its round ends.")
          .in("m")
          .within(notNegative)
          .usually(0, 2),
      field("radius", &Capsule::radius, "Radius of a capsule.").in("m").within(positive).usually(0.01, 1),
      frictionField<Capsule>(),
      motionField<Capsule>(),
  };
  return fields;
}

template <>
std::span<const Field<Box>> fieldsOf<Box>() {
  static const std::array fields{
      field("origin", &Box::origin, "Centre of a box.").in("m"),
      field("size", &Box::size, "Of a box from face to face.").in("m").within(positive).usually(0.01, 3),
      field("rotation", &Box::rotation, "Own turn of a box or mesh: axis times angle; its motion adds to it.")
          .in("degrees"),
      field("rounding", &Box::rounding, "Radius of a box's edges, at most half its smallest size.")
          .in("m")
          .within(notNegative)
          .usually(0, 0.2),
      frictionField<Box>(),
      motionField<Box>(),
  };
  return fields;
}

template <>
std::span<const Field<Torus>> fieldsOf<Torus>() {
  static const std::array fields{
      field("origin", &Torus::origin, "Centre of a torus.").in("m"),
      field("axis", &Torus::axis, "Through the hole of a torus.").within({.nonZero = true}),
      field("radius", &Torus::radius, "Of the circle inside the tube.")
          .in("m")
          .within(positive)
          .usually(0.01, 1),
      field("tube_radius", &Torus::tubeRadius, "Of the tube of a torus, smaller than its radius.")
          .in("m")
          .within(positive)
          .usually(0.01, 1),
      frictionField<Torus>(),
      motionField<Torus>(),
  };
  return fields;
}

template <>
std::span<const Field<MeshCollider>> fieldsOf<MeshCollider>() {
  using M = MeshCollider;
  static const std::array fields{
      field("file", &M::file, "OBJ file of a closed mesh, beside the scene file or in clothsim's own folder.")
          .required()
          .rebuilds(),
      field("origin", &M::origin, "Where the mesh's own origin stands.").in("m"),
      field("rotation", &M::rotation, "Own turn of a box or mesh.").in("degrees"),
      field("scale", &M::scale, "Metres in a unit of the mesh file.").within(positive).usually(0.1, 10),
      field("cells", &M::cells,
            "Cells of the mesh's signed distance grid along its longest side: more are finer and slower to "
            "make.")
          .within({.low = 8, .high = 256}),
      frictionField<M>(),
      motionField<M>(),
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
      field("position", &K::position, "Where the collider's origin, or the plane's point, is then.")
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
      field("velocity", &Wind::velocity,
            "Steady wind; what counts is how it blows past each triangle, which may move itself.")
          .in("m/s")
          .usually(-10, 10),
      field("gust", &Wind::gust,
            "Random change of the wind's speed along its direction, the same in every run."),
      field("drag", &Wind::drag, "Coefficient of the pressure along a triangle's normal.")
          .within(notNegative)
          .usually(0, 3),
      field("lift", &Wind::lift, "Coefficient of the force across the relative wind.")
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
      field("frequency", &Gust::frequency, "How often gusts come, about so many a second.")
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
            "Leapfrog Verlet; symplectic Euler; or implicit: backward Euler, stable at any step.")
          .byDefault("\"verlet\"; in scenes with a material \"implicit\""),
      field("newton_steps", &S::newtonSteps,
            "Newton steps in a step of the implicit integrator; more come nearer to its solution.")
          .within({.low = 1, .high = 100})
          .usually(1, 8),
      field("cg_iterations", &S::cgIterations,
            "For the linear system of each Newton step; auto: 10, up to 40 in steps beyond 1/60 s, 40 or 60 "
            "of fabrics.")
          .within({.low = 1, .high = 10'000})
          .usually(1, 40),
      field("frames_per_sec", &S::framesPerSec,
            "Frames in a simulated second; states and pictures are made at their ends.")
          .in("1/s")
          .within(positive)
          .usually(15, 240),
      field("simulation_steps", &S::simulationSteps,
            "Steps in a frame, each 1 / (frames_per_sec * simulation_steps) s; auto: as few as are stable.")
          .within({.low = 1, .high = mostSteps})
          .usually(1, 200)
          .byDefault("30; in scenes with a material \"auto\""),
      field("strain_limit", &S::strainLimit,
            "Longest stretch l/L - 1: a pass after the step; with the implicit integrator a second, stiff "
            "spring.")
          .within(notNegative)
          .usually(0, 0.5)
          .as(Format::orFalse)
          .byDefault("0.1 in scenes with ks, else false"),
      field(
          "self_collision", &S::selfCollision,
          "Keep layers of cloth apart: averaged is CS184's rule and leaks, robust holds; true: see default.")
          .byDefault("false; in scenes with ks averaged. true means averaged there, else robust"),
      field("self_friction", &S::selfFriction,
            "Coulomb's coefficient of friction between layers of cloth; robust self-collision only.")
          .within({.low = 0, .high = 10})
          .usually(0, 1)
          .byDefault("the material's, else 0.3"),
      field("friction_law", &S::frictionLaw,
            "What a collider's friction means: CS184's factor, or Coulomb's coefficient.")
          .byDefault("\"cs184\"; in scenes with a material \"coulomb\""),
      field("max_speed", &S::maxSpeed, "The watchdog stops a run in which a particle is faster.")
          .in("m/s")
          .within(positive)
          .usually(1, 10000),
      field("max_strain", &S::maxStrain, "The watchdog stops a run in which a spring's l/L - 1 is larger.")
          .within(positive)
          .usually(0.1, 100),
  };
  return fields;
}

template <>
std::span<const Field<CameraSettings>> fieldsOf<CameraSettings>() {
  using C = CameraSettings;
  static const std::array fields{
      field("position", &C::position, "Where the eye is.").in("m").byDefault("frames the scene"),
      field("target", &C::target,
            "The point in the middle of the picture, about which the viewer's camera turns.")
          .in("m")
          .byDefault("middle of the scene"),
      field("fov", &C::fov, "Vertical field of view; small is a telephoto lens, large a wide angle.")
          .in("degrees")
          .within({.low = 1, .high = 170})
          .usually(15, 90),
  };
  return fields;
}

template <>
std::span<const Field<RenderSettings>> fieldsOf<RenderSettings>() {
  using R = RenderSettings;
  constexpr Limits channel{.low = 0, .high = 1};
  static const std::array fields{
      field("shader", &R::shader, "Shading model: how the cloth is looked at.").oneOf(shadingModels),
      field("color", &R::color, "Colour of the front of the cloth.")
          .in("sRGB")
          .within(channel)
          .as(Format::color),
      field("back_color", &R::backColor, "Colour of the back of the cloth.")
          .in("sRGB")
          .within(channel)
          .as(Format::color),
      field("texture", &R::texture,
            "Print (tartan, stripes, checker) or height map (quilt, knit, hammered), or the path of a PNG.")
          .byDefault("of texture: tartan; of bump and displacement: quilt; of fabric: none"),
      field("texture_repeat", &R::textureRepeat, "How often the texture fits along a cloth's longer side.")
          .within({.low = 0.01, .high = 1000})
          .usually(0.5, 50),
      field("weave", &R::weave, "How fabric's threads cross.").oneOf(weaves),
      field("thread_spacing", &R::threadSpacing,
            "From thread to thread of fabric; real cloth has 0.0003 to 0.002.")
          .in("m")
          .within({.low = 1e-5, .high = 1})
          .usually(2e-4, 0.02),
      field("gloss", &R::gloss, "Shine of fabric's threads: 0 is wool, 1 is silk.").within(channel),
      field("normal_strength", &R::normalStrength,
            "How much weaves and bumps tilt the normal: 0 flat, 1 true to their height.")
          .within({.low = 0, .high = 10})
          .usually(0, 3),
      field("height", &R::height, "Height of bump and displacement maps, from black to white.")
          .in("m")
          .within({.low = -1, .high = 1})
          .usually(-0.05, 0.05),
      field("strain_range", &R::strainRange, "Stretch, l/L - 1, at which the strain map's scale ends.")
          .within({.low = 1e-6, .high = 100})
          .usually(0.001, 1),
      field("light", &R::light, "Direction towards the main light, of any length.")
          .within({.nonZero = true})
          .byDefault("from the viewer's side, upper left"),
      field("background", &R::background, "What is behind the cloth.").oneOf(backgrounds),
      field("background_color", &R::backgroundColor, "Colour of the plain background.")
          .in("sRGB")
          .within(channel)
          .as(Format::color),
      field("ground", &R::ground, "Draw a floor when the scene has no level plane."),
  };
  return fields;
}

template <>
std::span<const Field<Expect>> fieldsOf<Expect>() {
  using E = Expect;
  static const std::array fields{
      field("frames", &E::frames, "Frames to run before looking.").within({.low = 1, .high = 1e6}).required(),
      field("centroid", &E::centroid, "Mean of all particles' places.").in("m"),
      field("centroid_tolerance", &E::centroidTolerance,
            "How far each coordinate of the centroid may be off.")
          .in("m")
          .within(positive),
      field("min_y", &E::minY, "Height of the lowest particle, from and to.").in("m"),
      field("max_strain", &E::maxStrain, "Largest l/L - 1 of all springs, from and to."),
      field("kinetic_energy", &E::kineticEnergy, "Kinetic energy of all particles, from and to.").in("J"),
      field("max_penetration", &E::maxPenetration,
            "Deepest that a particle was inside a collider over the run, from and to.")
          .in("m"),
      field("crossings", &E::crossings,
            "Most crossing pairs of triangles that are no neighbours, of all frames."),
  };
  return fields;
}

SolverSettings solverDefaults(bool usesKs, bool usesMaterial) {
  SolverSettings solver;
  if (usesMaterial) {
    solver.frictionLaw = FrictionLaw::coulomb;
    solver.integrator = Integrator::implicit;
    solver.simulationSteps.automatic = true;
  }
  if (usesKs) {
    solver.strainLimit = 0.1;
    solver.selfCollision = SelfCollision::averaged;
  }
  return solver;
}

bool usesKs(const Scene& scene) {
  return std::any_of(scene.cloths.begin(), scene.cloths.end(),
                     [](const ClothSettings& cloth) { return !cloth.stiffnessReference && !cloth.material; });
}

Usual sliderRange(const FieldTraits& traits, double now) {
  if (traits.usual.low < traits.usual.high) return traits.usual;
  const Limits& limits = traits.limits;
  const double span = now == 0 ? 1 : 10 * std::abs(now);
  return {limits.low > -infinite ? limits.low : -span, limits.high < infinite ? limits.high : span};
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

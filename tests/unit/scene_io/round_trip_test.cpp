// Saving and loading again gives the same scene, for scenes with every member set at random.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/files.h"
#include "scene_io/scene_io.h"

namespace clothsim {
namespace {

class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : engine_(seed) {}

  Scene make() {
    Scene scene;
    scene.name = text();
    scene.description = text();
    scene.cloths.clear();
    for (int i = whole(1, 3); i > 0; --i) scene.cloths.push_back(cloth());
    for (int i = whole(0, 3); i > 0; --i) scene.colliders.push_back(collider());
    scene.gravity = vector();
    if (maybe())
      scene.wind =
          Wind{vector(), {positive(), positive(), whole(0, 1 << 30)}, positive(), positive(), positive()};
    if (maybe()) scene.airResistance = positive();
    for (int i = whole(0, 2); i > 0; --i) scene.attractors.push_back({vector(), fraction(), positive()});
    for (int i = whole(0, 2); i > 0; --i) scene.seams.push_back(seam(scene));
    scene.solver = {.integrator = static_cast<Integrator>(whole(0, 2)),
                    .framesPerSec = std::min(positive(), 1e6),
                    .simulationSteps = whole(1, 1'000'000),
                    .newtonSteps = whole(1, 100),
                    .cgIterations = whole(1, 10'000),
                    .strainLimit = optionalPositive(),
                    .selfCollision = static_cast<SelfCollision>(whole(0, 2)),
                    .selfFriction = fraction(),
                    .frictionLaw = FrictionLaw::cs184};
    for (ClothSettings& cloth : scene.cloths)
      if (cloth.tearStrain && scene.solver.strainLimit) cloth.tearStrain = *scene.solver.strainLimit / 2;
    if (maybe()) makeCoulomb(scene);
    if (maybe())
      scene.camera = {vector(), vector(), 1 + 169 * fraction(), positive(), positive(), optionalPositive()};
    scene.render = renderSettings();
    if (maybe()) scene.expect = expectation();
    return scene;
  }

 private:
  bool maybe() { return whole(0, 1) == 1; }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  double fraction() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
  // All magnitudes, all 53 bits.
  double positive() { return std::exp(std::uniform_real_distribution<double>(-30, 30)(engine_)); }
  double number() { return maybe() ? positive() : maybe() ? -positive() : whole(-3, 3); }
  Vec3d vector() { return {number(), number(), number()}; }
  Vec3d color() { return {fraction(), fraction(), fraction()}; }
  SeamSide side(const Scene& scene) {
    const int cloth = whole(0, static_cast<int>(scene.cloths.size()) - 1);
    const bool isMesh = scene.cloths[static_cast<std::size_t>(cloth)].isMesh();
    return {cloth, {isMesh ? Pin(VertexPin{whole(0, 9)}) : Pin(GridSide::left)}, maybe()};
  }
  Seam seam(const Scene& scene) {
    const SeamSide a = side(scene);
    SeamSide b = side(scene);
    if (a == b) b.reverse = !a.reverse;
    return {a, b, positive(), optionalPositive()};
  }
  std::optional<double> optionalPositive() { return maybe() ? std::optional(positive()) : std::nullopt; }

  std::string text() {
    const std::string pieces[] = {"a", "\"", "\\", "\n", "\t", "\x01", "é", "布", "🧵", "/", " ", "\x7f"};
    std::string result;
    for (int i = whole(0, 8); i > 0; --i) result += pieces[whole(0, 11)];
    return result;
  }

  template <std::size_t n>
  std::string oneOf(const std::array<std::string_view, n>& words) {
    return std::string(words[static_cast<std::size_t>(whole(0, static_cast<int>(n) - 1))]);
  }

  RenderSettings renderSettings() {
    RenderSettings render;
    render.shader = oneOf(shadingModels);
    render.color = color();
    render.backColor = color();
    render.texture = text();
    render.textureRepeat = 0.01 + fraction();
    render.weave = oneOf(weaves);
    render.threadSpacing = 1e-5 + 0.1 * fraction();
    render.gloss = fraction();
    render.fuzz = 0.1 * fraction();
    render.normalStrength = 10 * fraction();
    render.height = fraction() - 0.5;
    render.strainRange = 1e-6 + fraction();
    render.lightSize = 60 * fraction();
    if (maybe()) render.light = Vec3d{positive(), number(), number()};
    render.background = oneOf(backgrounds);
    render.backgroundColor = color();
    if (maybe()) render.thickness = fraction();
    render.smooth = maybe();
    render.ground = maybe();
    return render;
  }

  ClothSettings cloth() {
    ClothSettings c;
    c.width = positive();
    c.height = positive();
    c.numWidthPoints = whole(2, 300);
    c.numHeightPoints = whole(2, 300);
    c.orientation = maybe() ? Orientation::horizontal : Orientation::vertical;
    c.position = vector();
    c.rotation = vector();
    c.mass = optionalPositive();
    if (!c.mass) c.density = positive();
    (maybe() ? c.ks : c.stiffnessReference) = positive();
    c.referenceLength = positive();
    c.damping = 100 * fraction();
    c.thickness = positive();
    c.pressure = positive();
    c.shrink = 0.5 * fraction();
    c.tearStrain = optionalPositive();
    c.enableStructural = maybe();
    c.enableShearing = maybe();
    c.enableBending = maybe();
    for (int i = whole(0, 4); i > 0; --i) c.pinned.push_back(pin(c));
    movePins(c);
    return c;
  }

  // All pins together, or blocks of rows of their own that follow a path each.
  void movePins(ClothSettings& c) {
    if (!c.pinned.empty() && maybe()) {
      c.pinMotion = {pinPath()};
      return;
    }
    for (int row = 0; row + 1 < c.numHeightPoints && maybe(); row += 2) {
      c.pinned.emplace_back(GridRange{{0, row}, {c.numWidthPoints - 1, row + 1}});
      c.pinMotion.push_back(pinPath());
      c.pinMotion.back().pinned = {GridPoint{0, row}, GridRange{{1, row}, {1, row + 1}}};
    }
  }

  PinMotion pinPath() {
    PinMotion motion;
    double t = positive();
    for (int i = whole(1, 4); i > 0; --i, t *= 1.5)
      motion.keys.push_back({t, maybe() ? std::optional(vector()) : std::nullopt, vector(), maybe()});
    motion.loop = maybe();
    if (maybe()) motion.interpolation = Interpolation::cubic;
    if (maybe()) motion.release = positive();
    return motion;
  }

  Pin pin(const ClothSettings& c) {
    const GridPoint from{whole(0, c.numWidthPoints - 1), whole(0, c.numHeightPoints - 1)};
    switch (whole(0, 2)) {
      case 0:
        return from;
      case 1:
        return GridRange{from,
                         {whole(from.column, c.numWidthPoints - 1), whole(from.row, c.numHeightPoints - 1)}};
      default:
        return static_cast<GridSide>(whole(0, 3));
    }
  }

  Collider collider() {
    std::optional<Motion> motion;
    if (maybe()) motion = path();
    const Vec3d direction{1, number(), number()};
    const double size = positive();
    switch (whole(0, 7)) {
      case 7:
        return Cone{vector(), direction, positive(), size, fraction() * size, fraction(), motion};
      case 6:
        return Cylinder{vector(), direction, positive(), size, fraction(), motion};
      case 5:
        return meshCollider(size, motion);
      case 0:
        return Sphere{vector(), size, fraction(), motion};
      case 1:
        return Capsule{vector(), direction, positive(), size, fraction(), motion};
      case 2:
        return Box{vector(), {size, 2 * size, 1.5 * size}, vector(), 0.5 * fraction() * size, fraction(),
                   motion};
      case 3:
        return Torus{vector(), direction, size, 0.9 * fraction() * size + 1e-16, fraction(), motion};
      default:
        return Plane{vector(), direction, fraction(), motion};
    }
  }

  Collider meshCollider(double scale, const std::optional<Motion>& motion) {
    MeshCollider mesh{text() + "x", vector(), vector(), scale, whole(8, 256), fraction(), motion};
    if (!maybe()) return mesh;
    mesh.file += maybe() ? "%d" : "%03d.obj";
    mesh.shapes = whole(2, 1000);
    mesh.firstShape = whole(0, 99);
    mesh.shapesPerSecond = positive();
    mesh.shapesStart = number();
    mesh.shapesLoop = maybe();
    return mesh;
  }

  // The law that allows friction above 1.
  void makeCoulomb(Scene& scene) {
    scene.solver.frictionLaw = FrictionLaw::coulomb;
    for (Collider& collider : scene.colliders)
      std::visit([&](auto& shape) { shape.friction = positive(); }, collider);
  }

  Motion path() {
    Motion motion;
    double t = positive();
    for (int i = whole(1, 4); i > 0; --i, t *= 1.5)
      motion.keys.push_back({t, maybe() ? vector() : Vec3d{0, 0, 0}, vector()});
    motion.loop = maybe();
    return motion;
  }

  std::optional<Range> range() {
    const double low = number();
    return maybe() ? std::optional(Range{low, low + positive()}) : std::nullopt;
  }

  Expect expectation() {
    return {whole(1, 1000), maybe() ? std::optional(vector()) : std::nullopt,
            positive(),     range(),
            range(),        range(),
            range(),        range()};
  }

  std::mt19937 engine_;
};

TEST(FormatScene, ReadsBackAsTheSameSceneForAHundredRandomOnes) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Scene scene = RandomScene(seed).make();
    const std::string text = formatScene(scene);
    ASSERT_EQ(parseScene(text, "formatted"), scene) << "seed " << seed << "\n" << text;
    ASSERT_EQ(formatScene(parseScene(text, "formatted")), text) << "seed " << seed;
  }
}

TEST(FormatScene, ReadsBackAsTheSameSceneForAllBundledOnes) {
  for (const BundledScene& bundled : bundledScenes()) {
    const Scene scene = loadScene(bundled.path);
    EXPECT_EQ(parseScene(formatScene(scene), "formatted"), scene) << bundled.name;
  }
}

TEST(FormatScene, ReadsBackAsTheSameSceneForCs184sFiles) {
  for (const std::string name : {"pinned2", "pinned4", "plane", "sphere", "selfCollision"}) {
    const Scene scene = loadScene(std::filesystem::path(TEST_DATA) / "data" / "cs184" / (name + ".json"));
    EXPECT_EQ(parseScene(formatScene(scene), "formatted"), scene) << name;
  }
}

TEST(FormatScene, LeavesOutWhatIsAtItsDefault) {
  EXPECT_EQ(formatScene(parseScene(R"({"cloth": {"ks": 5000.0, "width": 1.0, "damping": 0.2}})", "test")),
            "{\n  \"schema\": \"clothsim/1\",\n  \"cloth\": {\"ks\": 5000}\n}\n");
}

TEST(FormatScene, KeepsTheOrderOfTheTable) {
  const std::string text = formatScene(parseScene(
      R"({"solver": {"integrator": "euler"}, "gravity": [0, 0, 0], "cloth": {"thickness": 1, "width": 2}})",
      "test"));
  EXPECT_LT(text.find("\"width\""), text.find("\"thickness\""));
  EXPECT_LT(text.find("\"thickness\""), text.find("\"gravity\""));
  EXPECT_LT(text.find("\"gravity\""), text.find("\"solver\""));
}

TEST(FormatScene, WritesNumbersInTheFewestDigitsThatReadBackExactly) {
  const std::string text = formatScene(parseScene(
      R"({"cloth": {"ks": 100000, "width": 0.1000000000000000055, "height": 0.30000000000000004, "density": 1e-7}})",
      "test"));
  for (const std::string part :
       {"\"ks\": 100000}", "\"width\": 0.1,", "\"height\": 0.30000000000000004,", "\"density\": 1e-07"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(FormatScene, WritesAListOfClothsOnlyForSeveral) {
  Scene scene = parseScene(R"({"cloth": {}})", "test");
  EXPECT_NE(formatScene(scene).find("\"cloth\": {"), std::string::npos);
  scene.cloths.push_back(scene.cloths[0]);
  EXPECT_NE(formatScene(scene).find("\"cloths\": ["), std::string::npos);
}

TEST(FormatScene, WritesAMotionOfAllPinsAsOneObject) {
  Scene scene = parseScene(
      R"({"cloth": {"pinned": ["top", "bottom"], "pin_motion": [{"keys": [{"t": 0}, {"t": 1, "rotation": [0, 90, 0]}]}]}})",
      "test");
  EXPECT_NE(
      formatScene(scene).find(R"("pin_motion": {"keys": [{"t": 0}, {"t": 1, "rotation": [0, 90, 0]}]})"),
      std::string::npos)
      << formatScene(scene);
  scene.cloths[0].pinMotion[0].pinned = {GridSide::top};
  EXPECT_NE(formatScene(scene).find("\"pin_motion\": ["), std::string::npos);
}

TEST(FormatScene, NamesAFabricThatIsAPresetAndSpellsOutOthers) {
  Scene scene = parseScene(R"({"cloth": {"material": "denim"}})", "test");
  EXPECT_NE(formatScene(scene).find(R"("material": "denim")"), std::string::npos) << formatScene(scene);
  scene.cloths[0].material->density *= 2;
  EXPECT_EQ(formatScene(scene).find("denim"), std::string::npos);
  EXPECT_EQ(parseScene(formatScene(scene), "saved"), scene);
}

TEST(SavedScene, KeepsTheSignOfZero) {
  const Scene scene = parseScene(R"({"cloth": {"position": [0, -0, 0]}, "gravity": [-0, -9.8, -0.0],
      "sphere": {"motion": {"keys": [{"t": 0, "position": [0, 0, -0]}]}}, "air_resistance": -0})",
                                 "zeros");
  const Scene again = parseScene(formatScene(scene), "saved");
  for (const Scene& read : {scene, again}) {
    EXPECT_TRUE(std::signbit(read.cloths[0].position.y));
    EXPECT_FALSE(std::signbit(read.cloths[0].position.x));
    EXPECT_TRUE(std::signbit(read.gravity.x));
    EXPECT_TRUE(std::signbit(read.gravity.z));
    EXPECT_TRUE(std::signbit(read.airResistance));
    EXPECT_TRUE(std::signbit(std::get<Sphere>(read.colliders[0]).motion->keys[0].position.z));
  }
}

}  // namespace
}  // namespace clothsim

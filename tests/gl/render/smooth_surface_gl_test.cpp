// The smooth surface against surfaces whose shape is known.
#include "render/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "gl/gl_test.h"
#include "gl/render/picture.h"
#include "gl/render/reference_picture.h"
#include "simulation/simulation.h"

namespace clothsim {
namespace {

using Shape = std::function<glm::dvec3(double u, double v)>;  // u and v from 0 to 1

Scene squareSheet(int points, int orientation = 0) {
  Scene scene;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = points;
  scene.cloths[0].orientation = orientation == 0 ? Orientation::horizontal : Orientation::vertical;
  return scene;
}

std::vector<glm::vec4> laidOver(const Cloth& cloth, const Shape& shape) {
  std::vector<glm::vec4> positions(cloth.particleCount());
  for (const Piece& piece : cloth.pieces())
    for (int row = 0; row < piece.rows; ++row)
      for (int column = 0; column < piece.columns; ++column)
        positions[piece.particle(column, row)] =
            glm::vec4(shape(double(column) / (piece.columns - 1), double(row) / (piece.rows - 1)), 1);
  return positions;
}

struct Smoothed {
  std::uint32_t side;  // points in a row and in a column
  std::vector<glm::vec4> points, normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Of a square sheet of `points` x `points`, as seen by a picture of 400 x 400 pixels of the square from -1
// to 1.
Smoothed smoothed(const Scene& scene, const Shape& shape, std::uint32_t steps, float flatness = 0) {
  const Cloth cloth(scene);
  const gl::Buffer<glm::vec4> positions("positions", laidOver(cloth, shape));
  ClothMesh particles(cloth);
  particles.computeNormals({gl::Program::makeCompute("render/normals.comp")}, positions.name());
  shared::RenderFrame frame{};
  frame.clipFromWorld = glm::mat4(1);
  frame.pixels = {400, 400, 1.0f / 400, 1.0f / 400};
  frame.flatness = flatness;
  const gl::Buffer<shared::RenderFrame> block("frame", std::span(&frame, 1));
  block.bindUniform(RENDER_FRAME_BINDING);
  const std::array all{steps};
  SmoothSurface surface(cloth, all, flatness > 0);
  surface.compute(SmoothPrograms(), positions.name(), particles);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return {steps * static_cast<std::uint32_t>(cloth.pieces()[0].columns - 1) + 1, surface.points().download(),
          surface.normals().download(), surface.triangles()};
}

// How far the points are from those of the shape, at most, without those within `border` cells of the border.
double largestError(const Smoothed& surface, const Shape& shape, std::uint32_t border) {
  double largest = 0;
  for (std::uint32_t row = border; row + border < surface.side; ++row)
    for (std::uint32_t column = border; column + border < surface.side; ++column) {
      const double last = surface.side - 1;
      largest = std::max(largest, glm::distance(glm::dvec3(surface.points[row * surface.side + column]),
                                                shape(column / last, row / last)));
    }
  return largest;
}

// A quarter of a cylinder along z around (0, 0).
constexpr double RADIUS = 0.6;
glm::dvec3 onCylinder(double u, double v) {
  const double angle = std::numbers::pi / 2 * u + 0.3;
  return {RADIUS * std::cos(angle), RADIUS * std::sin(angle), 0.8 * v - 0.4};
}

using SmoothSurfaceTest = GlTest;

TEST_F(SmoothSurfaceTest, LiesOnACylinderWhereTrianglesLieFarBelowIt) {
  constexpr int points = 17;
  constexpr double belowTriangles =
      RADIUS * 0.5 * std::numbers::pi / 16 * std::numbers::pi / 64;  // l^2 / (8 r)
  const Smoothed surface = smoothed(squareSheet(points), onCylinder, 8);
  ASSERT_EQ(surface.points.size(), 129u * 129);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const glm::dvec3 radial(surface.points[i].x, surface.points[i].y, 0);
    EXPECT_NEAR(glm::length(radial), RADIUS, belowTriangles / 40) << "point " << i;
    const double off = glm::length(glm::cross(glm::dvec3(surface.normals[i]), radial / glm::length(radial)));
    EXPECT_LT(off, 0.004) << "normal " << i << "; beside those of triangles, off by 0.05";
  }
}

TEST_F(SmoothSurfaceTest, ComesByTheParticlesToTheFourthOrderOfTheirSpacing) {
  const Shape wave = [](double u, double v) {
    return glm::dvec3{u, 0.05 * std::sin(9 * u) * std::cos(7 * v), v};
  };
  const double coarse = largestError(smoothed(squareSheet(17), wave, 4), wave, 4 * 4),
               fine = largestError(smoothed(squareSheet(33), wave, 4), wave, 8 * 4);
  // A wave of wave number k on a spacing h loses (k h)^4 / 36 of its height.
  const double expected = 0.05 * (std::pow(9.0 / 16, 4) + std::pow(7.0 / 16, 4)) / 36;
  EXPECT_NEAR(coarse, expected, 0.15 * expected);
  EXPECT_GT(coarse / fine, 12) << "16 for the fourth order, 8 for the third";
  EXPECT_LT(coarse / fine, 20);
}

TEST_F(SmoothSurfaceTest, KeepsAFlatSheetFlatItsBordersStraightAndItsCornersInPlace) {
  const Shape plane = [](double u, double v) { return glm::dvec3{0.9 * u, 0.2, 0.7 * v}; };
  for (const int points : {2, 3, 4, 9})
    for (const std::uint32_t steps : {1u, 2u, 8u})
      EXPECT_LT(largestError(smoothed(squareSheet(points), plane, steps), plane, 0), 1e-6)
          << points << " points, " << steps << " steps";
  const Shape bent = [](double u, double v) { return glm::dvec3{u, u * u * v, v + std::sin(3 * u)}; };
  const Smoothed surface = smoothed(squareSheet(9), bent, 4);
  EXPECT_LT(glm::distance(glm::dvec3(surface.points.front()), bent(0, 0)), 1e-6);
  EXPECT_LT(glm::distance(glm::dvec3(surface.points[surface.side - 1]), bent(1, 0)), 1e-6);
  EXPECT_LT(glm::distance(glm::dvec3(surface.points.back()), bent(1, 1)), 1e-6);
}

TEST_F(SmoothSurfaceTest, FacesWhereItsTrianglesDo) {
  for (const int orientation : {0, 1}) {
    const Smoothed surface = smoothed(squareSheet(9, orientation), onCylinder, 2);
    for (const auto& [a, b, c] : surface.triangles) {
      const glm::vec3 p(surface.points[a]), q(surface.points[b]), r(surface.points[c]);
      ASSERT_GT(glm::dot(glm::cross(q - p, r - p), glm::vec3(surface.normals[a])), 0) << orientation;
    }
  }
}

// In how many triangles each side is, by its ends.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> sidesOf(const Smoothed& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& [a, b, c] : surface.triangles)
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      ++sides[std::minmax(from, to)];
  return sides;
}

TEST_F(SmoothSurfaceTest, WhenLeanHasMoreTrianglesWhereItsShapeIsSeenAndNoGapsBetweenThem) {
  const Scene scene = squareSheet(17);
  constexpr std::size_t cells = 16 * 16;
  EXPECT_EQ(smoothed(scene, onCylinder, 2, 1e6f).triangles.size(), 2 * cells) << "those of the particles";
  EXPECT_GE(smoothed(scene, onCylinder, 2, 1e-9f).triangles.size(), 6 * cells);
  // Bumps, of which parts are seen from the side.
  const Shape bumps = [](double u, double v) {
    return glm::dvec3{u - 0.5, 0.3 * std::sin(9 * u) * std::cos(7 * v) + 0.3 * v, v - 0.5};
  };
  const Smoothed lean = smoothed(scene, bumps, 2, 1.0f);
  EXPECT_GT(lean.triangles.size(), 5 * cells / 2);
  EXPECT_LT(lean.triangles.size(), 7 * cells);
  const std::uint32_t last = lean.side - 1;
  for (const auto& [side, triangles] : sidesOf(lean)) {
    const auto [a, b] = side;
    const auto isOn = [&](std::uint32_t line, auto coordinate) {
      return coordinate(a) == line && coordinate(b) == line;
    };
    const auto column = [&](std::uint32_t i) { return i % lean.side; };
    const auto row = [&](std::uint32_t i) { return i / lean.side; };
    const bool isBorder = isOn(0, column) || isOn(last, column) || isOn(0, row) || isOn(last, row);
    EXPECT_EQ(triangles, isBorder ? 1 : 2) << "between points " << a << " and " << b;
  }
}

// A picture of a sheet bent to an arch, that covers a good part of it.
Image pictureOfArch(int points, const RenderOptions& options, bool smooth = true) {
  Scene scene = squareSheet(points);
  scene.render.shader = "normal";
  scene.render.smooth = smooth;
  scene.render.ground = false;
  scene.camera.position = Vec3d{0.9, 1.3, 3.0};
  scene.camera.target = Vec3d{0, 0.2, 0};
  const Cloth cloth(scene);
  const Shape arch = [](double u, double v) {
    const double angle = 3.6 * (u - 0.5);
    return glm::dvec3{0.7 * std::sin(angle), 0.7 * std::cos(angle), 1.2 * (v - 0.5)};
  };
  const gl::Buffer<glm::vec4> positions("positions", laidOver(cloth, arch));
  Renderer renderer(cloth, scene, options);
  return renderImage(renderer, positions.name(), Camera(scene, cloth), 0, 192, 144);
}

// The oracle is a sheet of so many points that its triangles are smaller than pixels.
TEST_F(SmoothSurfaceTest, LooksOfFewPointsAsTheTrianglesOfManyDo) {
  const Image many = pictureOfArch(257, {}, false);
  const double finest = test::meanDifference(pictureOfArch(9, {}), many),
               rough = test::meanDifference(pictureOfArch(9, {}, false), many),
               lean = test::meanDifference(pictureOfArch(9, {.subdivisions = 1, .flatness = 0.2}), many);
  EXPECT_GT(rough, 0.5) << "nine points are few";
  EXPECT_LT(finest, rough / 5);
  EXPECT_LT(lean, 0.9 * rough);
  RenderOptions draft;
  draft.subdivisions = 0;
  EXPECT_EQ(pictureOfArch(9, draft).rgb, pictureOfArch(9, {}, false).rgb) << "draft is not smooth";
}

// Where a part of a picture of a folded sheet shows cloth: 480 x 270 of the pixels that lie in four times as
// many rows and columns as a picture of 1920 x 1080 has.
std::vector<bool> coverOf(const Shape& folds, Vec3d eye, Vec3d target, int points, int subdivisions) {
  Scene scene = squareSheet(points);
  scene.render.shader = "diffuse";
  scene.render.color = scene.render.backColor = {0.05, 0.05, 0.05};
  scene.render.background = "plain";
  scene.render.backgroundColor = {1, 1, 1};
  scene.render.ground = false;
  scene.camera.fov = 2 * std::atan(std::tan(20 * std::numbers::pi / 180) / 16) * 180 / std::numbers::pi;
  scene.camera.position = eye;
  scene.camera.target = target;
  const Cloth cloth(scene);
  const gl::Buffer<glm::vec4> positions("positions", laidOver(cloth, folds));
  RenderOptions options;
  options.subdivisions = subdivisions;
  options.samples = 1;
  Renderer renderer(cloth, scene, options);
  const Image image = renderImage(renderer, positions.name(), Camera(scene, cloth), 0, 480, 270);
  std::vector<bool> cover;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    cover.push_back(image.rgb[i] + image.rgb[i + 1] + image.rgb[i + 2] < 400);
  return cover;
}

// Folds of a radius of 0.85 cells of 129 x 129 points run across the grid, and end in the air.
std::vector<bool> coverOfFolds(int points, int subdivisions) {
  const Shape folds = [](double u, double v) {
    return glm::dvec3{u, 0.025 * std::sin(2 * std::numbers::pi * 11.3 * (u + 0.45 * v)), v};
  };
  return coverOf(folds, {-2.5, 0.25, 0.5}, {0.5, 0.02, 0.5}, points, subdivisions);
}

// How far, at most, a pixel of one class is from the nearest one of that class in the other picture.
double deviation(const std::vector<bool>& a, const std::vector<bool>& b) {
  constexpr int width = 480, height = 270, reach = 12;
  double largest = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool wanted = a[std::size_t(y * width + x)];
      if (b[std::size_t(y * width + x)] == wanted) continue;
      double nearest = reach;
      for (int j = std::max(0, y - reach); j < std::min(height, y + reach + 1); ++j)
        for (int i = std::max(0, x - reach); i < std::min(width, x + reach + 1); ++i)
          if (b[std::size_t(j * width + i)] == wanted) nearest = std::min(nearest, std::hypot(i - x, j - y));
      largest = std::max(largest, nearest);
    }
  return largest;
}

TEST_F(SmoothSurfaceTest, OfAFoldAt129x129HasASilhouetteWithinHalfAPixelOfThatAt513x513) {
  const std::vector<bool> fine = coverOfFolds(513, 0);
  const auto covered = std::count(fine.begin(), fine.end(), true);
  ASSERT_GT(covered, 480 * 270 / 10) << "the silhouette is in the picture";
  ASSERT_LT(covered, 480 * 270 * 9 / 10);
  const auto of = [&](int subdivisions) {  // [pixels of 1920 x 1080]
    const std::vector<bool> cover = coverOfFolds(129, subdivisions);
    return std::max(deviation(cover, fine), deviation(fine, cover)) / 4;
  };
  const double rough = of(0), smooth = of(1);
  RecordProperty("rough", std::to_string(rough));
  RecordProperty("smooth", std::to_string(smooth));
  EXPECT_LE(smooth, 0.5);
  EXPECT_GT(rough, smooth);
}

// A sheet of 129 x 129 particles that hangs in folds over a ball, as a surface. It is the judge, so that it
// is computed otherwise than the shaders do: by Lagrange's cubic through four particles each way.
constexpr int SIMULATED_POINTS = 129;
Shape drapedOverBall() {
  Scene scene = squareSheet(SIMULATED_POINTS);
  scene.cloths[0].position = {0, -0.55, 0};  // [m], just above the ball
  Sphere ball;
  ball.origin = {0.5, 0.2, 0.5};
  ball.radius = 0.2;
  scene.colliders = {ball};
  Simulation simulation{Shared<Scene>(scene)};
  simulation.stepFrames(45);
  const auto particles = std::make_shared<const std::vector<Particle4>>(simulation.state().positions);
  const auto weights = [](double t) {  // of Lagrange's polynomials at -1, 0, 1 and 2
    return std::array{-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
                      (t + 1) * t * (t - 1) / 6};
  };
  const auto firstOf = [](double place) {
    return std::clamp(static_cast<int>(place) - 1, 0, SIMULATED_POINTS - 4);
  };
  return [=](double u, double v) {
    const double x = u * (SIMULATED_POINTS - 1), y = v * (SIMULATED_POINTS - 1);
    const int column = firstOf(x), row = firstOf(y);
    const auto across = weights(x - column - 1), down = weights(y - row - 1);
    glm::dvec3 place(0);
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t at =
            (static_cast<std::size_t>(row) + j) * SIMULATED_POINTS + static_cast<std::size_t>(column) + i;
        const Particle4 p = (*particles)[at];
        place += across[i] * down[j] * glm::dvec3(p.x, p.y, p.z);
      }
    return place;
  };
}

TEST_F(SmoothSurfaceTest, OfASimulatedFoldAt129x129HasASilhouetteWithinHalfAPixelOfThatAt513x513) {
  const Shape drape = drapedOverBall();
  const auto coverAt = [&](int points, int subdivisions) {
    return coverOf(drape, {3.1, 0.25, 0.9}, {0.5, 0.02, 0.75}, points, subdivisions);
  };
  const std::vector<bool> fine = coverAt(513, 0);
  const auto covered = std::count(fine.begin(), fine.end(), true);
  ASSERT_GT(covered, 480 * 270 / 10) << "the silhouette is in the picture";
  ASSERT_LT(covered, 480 * 270 * 9 / 10);
  const auto of = [&](int subdivisions) {  // [pixels of 1920 x 1080]
    const std::vector<bool> cover = coverAt(SIMULATED_POINTS, subdivisions);
    return std::max(deviation(cover, fine), deviation(fine, cover)) / 4;
  };
  const double rough = of(0), smooth = of(1);
  RecordProperty("rough", std::to_string(rough));
  RecordProperty("smooth", std::to_string(smooth));
  EXPECT_LE(smooth, 0.5);
  EXPECT_GT(rough, smooth);
}

TEST(BrokenSmoothSurface, ASurfaceInsideOfItsBendsIsSeenInThePicture) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change("render/smooth_control.comp", "vec3(-1, 8, -1)", "vec3(0, 6, 0)"));
  const test::CommandResult result =
      resources.runTests("SmoothSurfaceTest.LooksOfFewPointsAsTheTrianglesOfManyDo");
  EXPECT_NE(result.output.find("FAILED  ] SmoothSurfaceTest"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace clothsim

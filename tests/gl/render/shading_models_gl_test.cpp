// Every shading model against a stored picture, with a tolerance that broken shading exceeds.
#include "render/shading_models.h"

#include "gl/gl_test.h"
#include "gl/render/reference_picture.h"

namespace clothsim {
namespace {

Scene drapeWith(const std::string& model) {
  Scene scene = test::drapeScene();
  scene.camera.position = Vec3d{1.05, 0.85, 1.55};
  scene.camera.target = Vec3d{0.52, 0.42, 0.5};
  scene.render.shader = model;
  scene.render.threadSpacing = 0.02;
  scene.render.smooth = false;  // whose normals have tests of their own
  Sphere inTheLight;            // throws its shadow on the cloth
  inTheLight.origin = {0.32, 1.0, 0.82};
  inTheLight.radius = 0.09;
  scene.colliders.emplace_back(inTheLight);
  return scene;
}

class ShadingModelPicture : public GlTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(ShadingModelPicture, IsTheStoredOne) {
  const Image image = test::drawDrape(drapeWith(GetParam()), {}, 160, 120);
  EXPECT_LT(test::differenceFromReference("model_" + GetParam(), image), test::TOLERANCE);
}

TEST_P(ShadingModelPicture, WithoutShadowsIsAnother) {
  RenderOptions without;
  without.shadows = false;
  const Image image = test::drawDrape(drapeWith(GetParam()), without, 160, 120);
  EXPECT_GT(test::meanDifference(image, test::loadReference("model_" + GetParam())), 2 * test::TOLERANCE);
}

INSTANTIATE_TEST_SUITE_P(All, ShadingModelPicture, ::testing::ValuesIn(shadingModelNames()),
                         [](const auto& name) { return name.param; });

// How far the picture with light worked out at vertices is from the one with light in every pixel.
double differenceByVertexLight(int points, double gloss, double threadSpacing = 0.001) {
  Scene scene = drapeWith("fabric");
  scene.render.gloss = gloss;
  scene.render.threadSpacing = threadSpacing;
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = points;
  RenderOptions atVertices;
  atVertices.lightsVertices = true;
  atVertices.subdivisions = 0;
  RenderOptions inPixels = atVertices;
  inPixels.lightsVertices = false;
  return test::meanDifference(test::drawDrape(scene, atVertices, 160, 120),
                              test::drawDrape(scene, inPixels, 160, 120));
}

using VertexLight = GlTest;
constexpr double GLOSSY = 0.6;  // too much for the plain light of matte cloth

TEST_F(VertexLight, OfFineClothIsHardToTellFromLightInEveryPixel) {
  const double difference = differenceByVertexLight(65, GLOSSY);
  EXPECT_GT(difference, 0);
  EXPECT_LT(difference, test::TOLERANCE);
}

TEST_F(VertexLight, IsNotWorkedOutForCoarseClothNorWhereThreadsAreSeen) {
  EXPECT_EQ(differenceByVertexLight(9, GLOSSY), 0);
  EXPECT_EQ(differenceByVertexLight(65, GLOSSY, 0.02), 0);
}

// Its shine is left out, and so are threads.
TEST_F(VertexLight, OfMatteClothIsHardToTellAlsoWhereItIsCoarse) {
  for (const double spacing : {0.001, 0.02}) {
    const double difference = differenceByVertexLight(9, 0.2, spacing);
    EXPECT_GT(difference, 0);
    EXPECT_LT(difference, test::TOLERANCE);
  }
}

// Narrow folds along those diagonals of cells that the springs do not have.
Image foldsOf(int points, bool lightsVertices) {
  Scene scene = drapeWith("fabric");
  scene.render.gloss = GLOSSY;
  scene.render.threadSpacing = 0.001;
  scene.colliders.clear();
  scene.cloths[0].numWidthPoints = scene.cloths[0].numHeightPoints = points;
  const Cloth cloth(scene);
  std::vector<Particle4> folded;
  for (const Vec3d& rest : cloth.positions()) {
    const double height = 0.5 + 0.012 * std::sin(60 * (rest.x - rest.z));
    folded.push_back({static_cast<float>(rest.x), static_cast<float>(height), static_cast<float>(rest.z), 1});
  }
  const gl::Buffer<Particle4> positions("positions", folded);
  RenderOptions options;
  options.lightsVertices = lightsVertices;
  options.subdivisions = 0;
  Renderer renderer(cloth, scene, options);
  return renderImage(renderer, positions.name(), Camera(scene, cloth), 0, 320, 240);
}

// The mean is 3.85 on llvmpipe. With the diagonals of the springs it is 4.75: each triangle shows as the
// tooth of a saw.
TEST_F(VertexLight, DividesCellsAlongFolds) {
  EXPECT_LT(test::meanDifference(foldsOf(65, true), foldsOf(257, false)), 4.2);
}

// Breaks one shader, and expects the comparisons of `models`, and no others, to fail by it.
void expectSeenInModel(const std::string& file, const std::string& from, const std::string& to,
                       const std::vector<std::string>& models) {
  const test::ResourceCopy resources;
  ASSERT_TRUE(resources.change(file, from, to)) << file << " has changed: so must this test";
  const test::CommandResult result = resources.runTests("All/ShadingModelPicture.IsTheStoredOne/*");
  for (const std::string& model : shadingModelNames()) {
    const bool failed =
        result.output.find("FAILED  ] All/ShadingModelPicture.IsTheStoredOne/" + model) != std::string::npos;
    const bool mustFail = std::find(models.begin(), models.end(), model) != models.end();
    EXPECT_EQ(failed, mustFail) << model << "\n" << result.output;
  }
}

// A mirror does not mind: it reflects alike for both directions of its normal.
TEST(BrokenShadingModel, FlippedNormalsAreSeenByAllThatLookAtNormals) {
  expectSeenInModel("render/normals.comp", "sum / area", "-sum / area",
                    {"fabric", "phong", "diffuse", "texture", "bump", "displacement", "normal", "strain"});
}
// In the wireframe the ball below is seen.
TEST(BrokenShadingModel, MissingShadowsOnTheClothAreSeenByAllThatAreLit) {
  expectSeenInModel("render/shadow.glsl", "return 0.25 * sum;", "return 1.0;",
                    {"fabric", "phong", "diffuse", "texture", "bump", "displacement", "wireframe"});
}
TEST(BrokenShadingModel, TangentsAlongVInsteadOfUAreSeenWhereAReliefTurnsWithThem) {
  expectSeenInModel("render/normals.comp", "vec3 along = right - left;", "vec3 along = upper - lower;",
                    {"bump", "displacement"});
}

}  // namespace
}  // namespace clothsim

// Cloth made of a mesh as it is drawn, picked and held by hand.
#include <gtest/gtest.h>

#include "core/error.h"
#include "export/formats.h"
#include "gl/gl_test.h"
#include "render/camera.h"
#include "render/cloth_mesh.h"
#include "render/renderer.h"
#include "session/session.h"
#include "simulation/gpu/solvers.h"
#include "solver/gpu/gpu_solver.h"
#include "support/mesh_sheet.h"
#include "support/throws.h"

namespace clothsim {
namespace {

using MeshTest = GlTest;

Scene waveScene() {
  Scene scene = test::meshScene({.columns = 20, .rows = 22, .edge = 0.03, .disorder = 0.15});
  scene.cloths[0].position = {0.1, 0.2, 0.3};
  return scene;
}

// The mesh at its places, pushed out of its plane and stretched along x.
State wavyState(const Cloth& cloth, const Scene& scene) {
  State state = initialState(cloth, scene);
  for (Particle4& x : state.positions) x = {1.05f * x.x, x.y, 0.04f * std::sin(12 * x.x), x.w};
  return state;
}

TEST_F(MeshTest, HasTheNormalsThatItsFilesHave) {
  const Scene scene = waveScene();
  const Cloth cloth(scene);
  const State state = wavyState(cloth, scene);
  const gl::Buffer<Particle4> positions("positions", state.positions);
  ClothMesh mesh(cloth);
  const gl::Program pieces = gl::Program::makeCompute("render/normals.comp", {}),
                    meshes = gl::Program::makeCompute("render/mesh_normals.comp", {});
  mesh.computeNormals({pieces, &meshes}, positions.name());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const std::vector<Vec3f> expected = vertexNormals(state, cloth);
  const auto normals = mesh.normals().download(), tangents = mesh.tangents().download();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const glm::vec3 normal(normals[i]), tangent(tangents[i]);
    EXPECT_LT(glm::distance(normal, glm::vec3(expected[i].x, expected[i].y, expected[i].z)), 1e-5f);
    EXPECT_NEAR(glm::length(tangent), 1, 1e-5);
    EXPECT_NEAR(glm::dot(tangent, normal), 0, 1e-5);
    EXPECT_GT(tangent.x, 0.7f) << "u goes along x, where the file has no texture coordinates";
  }
}

// The part below a tear has moved away: what is lost between both parts bends neither.
TEST_F(MeshTest, HasTheNormalsOfWhatIsLeftWhereItIsTorn) {
  const Scene scene = waveScene();
  const Cloth cloth(scene);
  State state = wavyState(cloth, scene);
  constexpr double middle = 0.47;
  state.cuts = test::tornAcross(cloth, middle);
  for (std::size_t i = 0; i < state.positions.size(); ++i)
    if (cloth.positions()[i].y < middle) state.positions[i].z += 0.3f;
  const gl::Buffer<Particle4> positions("positions", state.positions);
  ClothMesh mesh(cloth);
  const std::vector<Vec3f> expected = vertexNormals(state, cloth);
  const auto largestError = [&](const Cuts& cuts) {
    mesh.setCuts(cloth, cuts);
    const gl::Program pieces = gl::Program::makeCompute("render/normals.comp", {}),
                      meshes = gl::Program::makeCompute("render/mesh_normals.comp", {});
    mesh.computeNormals({pieces, &meshes}, positions.name());
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    float largest = 0;
    const auto normals = mesh.normals().download();
    for (std::size_t i = 0; i < expected.size(); ++i)
      largest = std::max(largest, glm::distance(glm::vec3(normals[i]),
                                                glm::vec3(expected[i].x, expected[i].y, expected[i].z)));
    return largest;
  };
  EXPECT_LT(largestError(state.cuts), 1e-5f);
  EXPECT_GT(largestError({}), 0.5f) << "and whole again";
}

TEST_F(MeshTest, IsDrawnTornAndInCrumbs) {
  Scene scene = waveScene();
  scene.render.background = "plain";
  const Cloth cloth(scene);
  GpuSolver solver(cloth, scene);
  Cuts crumbs;
  for (const MeshSpring& spring : cloth.lists().springs) tearEdge(crumbs, cloth, spring);
  for (const RenderOptions& options :
       {RenderOptions{}, RenderOptions{.subdivisions = 0}, RenderOptions{.subdivisions = 1, .thick = true}}) {
    Renderer renderer(cloth, scene, options);
    const auto pixels = [&](const Cuts& cuts) {
      renderer.setCuts(cuts);
      return renderImage(renderer, solver.positionsBuffer(), Camera(scene, cloth), 0, 96, 96).rgb;
    };
    const auto whole = pixels({}), torn = pixels(test::tornAcross(cloth, 0.47)), nothing = pixels(crumbs);
    std::size_t tear = 0, all = 0;
    for (std::size_t i = 0; i < whole.size(); i += 3) {
      tear += torn[i] != whole[i];
      all += nothing[i] != whole[i];
    }
    EXPECT_GT(tear, 60u);
    EXPECT_GT(all, 3 * tear);
    EXPECT_EQ(pixels({}), whole);
  }
}

TEST_F(MeshTest, IsDarkerInItsHollowsAndLighterOnItsRidges) {
  const Scene scene = waveScene();
  const Cloth cloth(scene);
  const State state = wavyState(cloth, scene);
  const gl::Buffer<Particle4> positions("positions", state.positions);
  ClothMesh mesh(cloth);
  const gl::Program pieces = gl::Program::makeCompute("render/normals.comp", {}),
                    meshes = gl::Program::makeCompute("render/mesh_normals.comp", {});
  mesh.computeNormals({pieces, &meshes}, positions.name());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto normals = mesh.normals().download();
  int hollows = 0, ridges = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float z = state.positions[i].z;
    if (z < -0.038f) {
      ++hollows;
      EXPECT_GT(normals[i].w, 0) << i;
    }
    if (z > 0.038f) {
      ++ridges;
      EXPECT_LT(normals[i].w, 0) << i;
    }
  }
  EXPECT_GT(hollows, 10);
  EXPECT_GT(ridges, 10);
}

TEST_F(MeshTest, ShowsItsStrain) {
  Scene scene = waveScene();
  scene.render.shader = "strain";
  const Cloth cloth(scene);
  State state = initialState(cloth, scene);
  for (Particle4& x : state.positions) x.x *= 1.2f;
  GpuSolver solver(cloth, scene);
  solver.setState(state);
  Renderer renderer(cloth, scene, {});
  (void)renderImage(renderer, solver.positionsBuffer(), Camera(scene, cloth), 0, 64, 64);
  EXPECT_NEAR(renderer.strainAt(210), 0.2, 0.01) << "the edges along x have it all";
}

TEST_F(MeshTest, IsDrawnByEveryShadingModel) {
  for (const std::string_view shader : shadingModels) {
    Scene scene = waveScene();
    scene.render.shader = std::string(shader);
    scene.render.background = "plain";
    const Cloth cloth(scene);
    GpuSolver solver(cloth, scene);
    Renderer renderer(cloth, scene, {});
    const Image image = renderImage(renderer, solver.positionsBuffer(), Camera(scene, cloth), 0, 96, 96);
    Scene empty = scene;
    empty.cloths[0].scale = 1e-3;
    const Cloth speck(empty);
    GpuSolver none(speck, empty);
    Renderer other(speck, empty, {});
    const Image without = renderImage(other, none.positionsBuffer(), Camera(scene, cloth), 0, 96, 96);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) changed += image.rgb[i] != without.rgb[i];
    EXPECT_GT(changed, 96u * 96u / 10) << shader;
  }
}

TEST_F(MeshTest, IsPickedAtACornerOfTheTriangleUnderTheCursor) {
  const Scene scene = waveScene();
  const Cloth cloth(scene);
  GpuSolver solver(cloth, scene);
  Renderer renderer(cloth, scene, {});
  const Camera camera(scene, cloth);
  const auto placeOf = [&](std::uint32_t i) {
    const Vec3f p = cloth.positions()[i].cast<float>();
    return glm::vec3(p.x, p.y, p.z);
  };
  const glm::vec4 clip = camera.projection(1) * camera.view() * glm::vec4(placeOf(205), 1);
  const Pick pick = renderer.pick(solver.positionsBuffer(), camera, 0, 200, 200,
                                  100 + 100 * double{clip.x / clip.w}, 100 - 100 * double{clip.y / clip.w});
  ASSERT_EQ(pick.kind, Pick::Kind::cloth);
  EXPECT_LT(glm::distance(pick.point, placeOf(205)), 0.005f);
  EXPECT_LT(glm::distance(pick.point, placeOf(pick.particle)), 1.4f * 0.03f);
}

TEST_F(MeshTest, IsHeldPinnedAndBlownAtButNotCut) {
  const Scene scene = waveScene();
  for (const char* backend : {"cpu", "gpu"}) {
    Session session(scene, backend, makeSolver);
    session.act(Grab{200, {0.4, 0.5, 0.8}, 1e4, 0.1});
    session.act(SetPin{0, true});
    session.act(Blow{{0.3, 0.3, 2}, {0, 0, -1}, 5, 0.3});
    (void)session.stepFrames(1);
    EXPECT_EQ(session.simulation().solver().positions(0, 1)[0].w, 0.0f);
    EXPECT_GT(session.simulation().solver().positions(200, 1)[0].z, 0.31f);
    const std::string message = test::messageThrownBy<UsageError>([&] {
      session.act(CutStroke{0, {0, 0}, {1, 1}});
    });
    EXPECT_NE(message.find("meshes cannot be cut"), std::string::npos);
    Scene edited = session.simulation().scene();
    edited.cloths[0].enableBending = false;
    const Particle4 before = session.simulation().solver().positions(200, 1)[0];
    session.act(EditScene{edited});
    EXPECT_LT(session.simulation().cloth().springCount(), Cloth(scene).springCount());
    EXPECT_EQ(session.simulation().solver().positions(200, 1)[0].z, before.z)
        << "an edit goes on from the same state";
    EXPECT_EQ(session.simulation().solver().positions(200, 1)[0].w, before.w);
  }
}

}  // namespace
}  // namespace clothsim

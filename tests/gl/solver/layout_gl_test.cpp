// The structs that C++ and GLSL share lie in memory as the driver says they do.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "gl/gl_test.h"
#include "gl/program.h"
#include "solver/divergence.h"
#include "solver/gpu/pass_programs.h"
#include "solver/hierarchy.h"
#include "solver/implicit.h"
#include "solver/mesh_lists.h"
#include "solver/pin_paths.h"
#include "solver/step_params.h"

namespace clothsim {
namespace {

using LayoutTest = GlTest;
using Step = StepParams<float>;
using SpringRow = SpringParams<float>;
using ColliderRow = ColliderParams<float>;

PassFeatures allFeatures() {
  return {.wind = true,
          .movingColliders = true,
          .coulombFriction = true,
          .movingPins = true,
          .restLengthTable = true,
          .colliderTypes = 0xffffffff,
          .particleForces = ~0u,
          .enabledSlots = 63,
          .groupColumns = 64,
          .groupRows = 1};
}

// Offset that the driver gives a member of a uniform block; -1: the program does not use it.
GLint uniformOffset(const gl::Program& program, const std::string& name) {
  const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM, name.c_str());
  if (index == GL_INVALID_INDEX) return -1;
  const GLenum property = GL_OFFSET;
  GLint offset = -1;
  glGetProgramResourceiv(program.name(), GL_UNIFORM, index, 1, &property, 1, nullptr, &offset);
  return offset;
}

GLint blockSize(const gl::Program& program, const char* block) {
  const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM_BLOCK, block);
  EXPECT_NE(index, GL_INVALID_INDEX) << block;
  const GLenum property = GL_BUFFER_DATA_SIZE;
  GLint size = 0;
  glGetProgramResourceiv(program.name(), GL_UNIFORM_BLOCK, index, 1, &property, 1, nullptr, &size);
  return size;
}

const gl::Program& programOf(PassLibrary& library, std::initializer_list<Pass> passes,
                             const PassFeatures& features) {
  std::vector<PassCall> wanted;
  for (const Pass pass : passes) wanted.push_back({pass});
  return *library.find(kernels()[kernelFor(wanted).kernel], features).back();
}

struct Programs {
  Programs(PassLibrary& library, const PassFeatures& features)
      : step(&programOf(library, {Pass::forces, Pass::integrate, Pass::collide}, features)),
        limit(&programOf(library, {Pass::limit}, features)),
        watchLimit(&programOf(library, {Pass::watchLimit}, features)),
        kick(&programOf(library, {Pass::forces, Pass::kick}, features)),
        start(&programOf(library, {Pass::checkStart}, features)) {}
  const gl::Program *step, *limit, *watchLimit, *kick, *start;
};

#define MEMBER(Struct, prefix, member) \
  { prefix #member, offsetof(Struct, member) }

TEST_F(LayoutTest, OfStepParamsIsTheDrivers) {
  PassLibrary library;
  const Programs programs(library, allFeatures());
  const std::vector<std::pair<std::string, std::size_t>> members = {
      MEMBER(Step, "StepBlock.step.", firstParticle),
      MEMBER(Step, "StepBlock.step.", columns),
      MEMBER(Step, "StepBlock.step.", rows),
      MEMBER(Step, "StepBlock.step.", totalParticles),
      MEMBER(Step, "StepBlock.step.", colliderCount),
      MEMBER(Step, "StepBlock.step.", firstCollider),
      MEMBER(Step, "StepBlock.step.", timeStep),
      MEMBER(Step, "StepBlock.step.", inverseTimeStep),
      MEMBER(Step, "StepBlock.step.", velocityKept),
      MEMBER(Step, "StepBlock.step.", airResistance),
      MEMBER(Step, "StepBlock.step.", gravityX),
      MEMBER(Step, "StepBlock.step.", gravityY),
      MEMBER(Step, "StepBlock.step.", gravityZ),
      MEMBER(Step, "StepBlock.step.", airVelocityX),
      MEMBER(Step, "StepBlock.step.", airVelocityZ),
      MEMBER(Step, "StepBlock.step.", dragFactor),
      MEMBER(Step, "StepBlock.step.", liftFactor),
      MEMBER(Step, "StepBlock.step.", planeOffset),
      MEMBER(Step, "StepBlock.step.", maxSpeedSquared),
      MEMBER(Step, "StepBlock.step.", attractorCount),
      MEMBER(Step, "StepBlock.step.", firstPinMotion)};
  int found = 0;
  for (const auto& [name, offset] : members) {
    // Drivers name members of a block without an instance name with or without the block's name.
    const std::string shortName = name.substr(name.find('.') + 1);
    const GLint driver =
        std::max(uniformOffset(*programs.step, name), uniformOffset(*programs.step, shortName));
    EXPECT_EQ(driver, static_cast<GLint>(offset)) << name;
    found += driver >= 0;
  }
  EXPECT_EQ(found, static_cast<int>(members.size()));
  EXPECT_EQ(uniformOffset(*programs.limit, "step.limitFactor"),
            static_cast<GLint>(offsetof(Step, limitFactor)));
  EXPECT_EQ(uniformOffset(*programs.kick, "step.kickTime"), static_cast<GLint>(offsetof(Step, kickTime)));
  EXPECT_EQ(uniformOffset(*programs.step, "step.attractors[1].pull"),
            static_cast<GLint>(offsetof(Step, attractors) + sizeof(shared::AttractorParams<float>) +
                               offsetof(shared::AttractorParams<float>, pull)));
  EXPECT_EQ(blockSize(*programs.step, "StepBlock"), static_cast<GLint>(sizeof(Step)));
}

TEST_F(LayoutTest, OfWhatMeshesAddToStepParamsIsTheDrivers) {
  PassFeatures features = allFeatures();
  features.mesh = true;
  PassLibrary library;
  EXPECT_EQ(uniformOffset(*Programs(library, features).step, "step.maxStretch"),
            static_cast<GLint>(offsetof(Step, maxStretch)));
  EXPECT_EQ(sizeof(MeshLists<float>::Starts), 16u) << "a texel";
  EXPECT_EQ(sizeof(MeshLists<float>::SpringAt), 16u);
  EXPECT_EQ(sizeof(MeshLists<float>::LimitedSpring), 16u);
  EXPECT_EQ(sizeof(MeshLists<float>::HingeParams), HINGE_ROWS * 16u);
}

TEST_F(LayoutTest, OfInteractionParamsIsTheDrivers) {
  using InteractionBlock = InteractionParams<float>;
  PassFeatures features = allFeatures();
  features.grab = features.jet = features.cuts = features.externalForces = true;
  PassLibrary library;
  const Programs programs(library, features);
  const std::vector<std::pair<std::string, std::size_t>> members = {
      MEMBER(InteractionBlock, "interaction.", goalX),
      MEMBER(InteractionBlock, "interaction.", velocityKept),
      MEMBER(InteractionBlock, "interaction.", pushX),
      MEMBER(InteractionBlock, "interaction.", pull),
      MEMBER(InteractionBlock, "interaction.", firstColumn),
      MEMBER(InteractionBlock, "interaction.", rows),
      MEMBER(InteractionBlock, "interaction.", largestSpeed),
      MEMBER(InteractionBlock, "interaction.", largestSpeedSquared),
      MEMBER(InteractionBlock, "interaction.", inverseRadius),
      MEMBER(InteractionBlock, "interaction.", inverseRadiusSquared),
      MEMBER(InteractionBlock, "interaction.", originX),
      MEMBER(InteractionBlock, "interaction.", jetSpeed),
      MEMBER(InteractionBlock, "interaction.", directionX),
      MEMBER(InteractionBlock, "interaction.", jetAlone)};
  for (const auto& [name, offset] : members)
    EXPECT_EQ(uniformOffset(*programs.step, name), static_cast<GLint>(offset)) << name;
  EXPECT_EQ(blockSize(*programs.step, "InteractionBlock"), static_cast<GLint>(sizeof(InteractionBlock)));
  EXPECT_EQ(sizeof(GrabSpring::Point), 16u) << "a texel";
}

TEST_F(LayoutTest, OfWhatTheImplicitIntegratorSharesIsTheDrivers) {
  using Level = LevelParams;
  PassLibrary library;
  PassFeatures features = allFeatures();
  features.limitSprings = features.grab = true;
  const gl::Program& begin = programOf(library, {Pass::begin}, features);
  EXPECT_EQ(uniformOffset(begin, "step.inertia"), static_cast<GLint>(offsetof(Step, inertia)));
  EXPECT_EQ(uniformOffset(begin, "step.guessTime"), static_cast<GLint>(offsetof(Step, guessTime)));
  EXPECT_EQ(uniformOffset(begin, "interaction.resistance"),
            static_cast<GLint>(offsetof(InteractionParams<float>, resistance)));
  EXPECT_EQ(uniformOffset(begin, "interaction.largestDisplacementSquared"),
            static_cast<GLint>(offsetof(InteractionParams<float>, largestDisplacementSquared)));
  EXPECT_EQ(uniformOffset(programOf(library, {Pass::multiply}, features), "step.limitStiffness"),
            static_cast<GLint>(offsetof(Step, limitStiffness)));

  const gl::Program& coarsen = programOf(library, {Pass::coarsen}, features);
  for (const auto& [name, offset] : std::vector<std::pair<std::string, std::size_t>>{
           MEMBER(Level, "level.", firstBlock), MEMBER(Level, "level.", endBlock)})
    EXPECT_EQ(uniformOffset(coarsen, name), static_cast<GLint>(offset)) << name;
  EXPECT_EQ(blockSize(coarsen, "LevelBlock"), static_cast<GLint>(sizeof(Level)));

  const gl::Program& restriction =
      *library
           .find(kernels()[kernelFor(std::vector<PassCall>{{Pass::restrict},
                                                           {Pass::solveCoarsest},
                                                           {Pass::prolong},
                                                           {Pass::sumFirstResidual}})
                               .kernel],
                 features)
           .front();
  for (const auto& [name, offset] : std::vector<std::pair<std::string, std::size_t>>{
           MEMBER(LevelsInARow, "row.", count),
           MEMBER(LevelsInARow, "row.", endPart),
           {"row.levels[1].coarseCount", sizeof(Level) + offsetof(Level, coarseCount)}})
    EXPECT_EQ(uniformOffset(restriction, name), static_cast<GLint>(offset)) << name;
  EXPECT_EQ(blockSize(restriction, "LevelsBlock"), static_cast<GLint>(sizeof(LevelsInARow)));

  const gl::Program& totals = programOf(library, {Pass::sumFirstResidual}, features);
  const GLuint index = glGetProgramResourceIndex(totals.name(), GL_BUFFER_VARIABLE, "scalars.residual");
  ASSERT_NE(index, GL_INVALID_INDEX);
  EXPECT_EQ(sizeof(ImplicitScalars<float>), 96u);
  EXPECT_EQ(offsetof(ImplicitScalars<float>, newtonLength), 12u);
}

// Who toggles back and forth compiles nothing, nor for a pass that does not look at what was toggled.
TEST_F(LayoutTest, OfProgramsIsSharedByScenesThatNeedTheSame) {
  PassLibrary library;
  const Programs before(library, allFeatures());
  PassFeatures features = allFeatures();
  features.grab = true;
  const Programs held(library, features);
  EXPECT_NE(held.step, before.step);
  EXPECT_EQ(held.limit, before.limit);
  EXPECT_EQ(held.kick, before.kick);
  EXPECT_EQ(Programs(library, allFeatures()).step, before.step);
}

TEST_F(LayoutTest, OfSpringsInStepParamsIsTheDrivers) {
  PassLibrary library;
  const Programs programs(library, allFeatures());
  for (std::size_t slot = 0; slot < SPRING_SLOTS; ++slot) {
    const std::string spring = "step.springs[" + std::to_string(slot) + "].";
    const std::size_t base = offsetof(Step, springs) + slot * sizeof(SpringRow);
    EXPECT_EQ(uniformOffset(*programs.step, spring + "stiffness"),
              static_cast<GLint>(base + offsetof(SpringRow, stiffness)));
    EXPECT_EQ(uniformOffset(*programs.step, spring + "maxLengthSquared"),
              static_cast<GLint>(base + offsetof(SpringRow, maxLengthSquared)));
    EXPECT_EQ(uniformOffset(*programs.limit, spring + "limitLength"),
              static_cast<GLint>(base + offsetof(SpringRow, limitLength)));
  }
}

TEST_F(LayoutTest, OfLimitColorIsTheDrivers) {
  PassLibrary library;
  const Programs programs(library, allFeatures());
  const std::vector<std::pair<std::string, std::size_t>> members = {
      MEMBER(LimitColor, "color.", slot),       MEMBER(LimitColor, "color.", firstColumn),
      MEMBER(LimitColor, "color.", columnStep), MEMBER(LimitColor, "color.", columnRun),
      MEMBER(LimitColor, "color.", endColumn),  MEMBER(LimitColor, "color.", firstRow),
      MEMBER(LimitColor, "color.", rowStep),    MEMBER(LimitColor, "color.", rowRun),
      MEMBER(LimitColor, "color.", endRow)};
  for (const auto& [name, offset] : members)
    EXPECT_EQ(uniformOffset(*programs.limit, name), static_cast<GLint>(offset)) << name;
  EXPECT_EQ(blockSize(*programs.limit, "ColorBlock"), static_cast<GLint>(sizeof(LimitColor)));
}

TEST_F(LayoutTest, OfTheWatchdogsRowIsTheDrivers) {
  PassLibrary library;
  const Programs programs(library, allFeatures());
  for (const gl::Program* program : {programs.start, programs.step, programs.watchLimit, programs.kick}) {
    const GLuint index = glGetProgramResourceIndex(program->name(), GL_BUFFER_VARIABLE, "watchRow[0]");
    ASSERT_NE(index, GL_INVALID_INDEX);
    const std::array<GLenum, 3> properties{GL_OFFSET, GL_ARRAY_SIZE, GL_ARRAY_STRIDE};
    std::array<GLint, 3> values{};
    glGetProgramResourceiv(program->name(), GL_BUFFER_VARIABLE, index, 3, properties.data(), 3, nullptr,
                           values.data());
    EXPECT_EQ(values, (std::array<GLint, 3>{0, PASSES, sizeof(WatchRow::value_type)}));
  }
}

TEST_F(LayoutTest, OfCollidersIsTheRowsThatTheShaderFetches) {
  EXPECT_EQ(sizeof(ColliderRow), COLLIDER_ROWS * 16u);
  EXPECT_EQ(offsetof(ColliderRow, radius), 12u);
  EXPECT_EQ(offsetof(ColliderRow, normalX), 16u);
  EXPECT_EQ(offsetof(ColliderRow, type), 32u);
  EXPECT_EQ(offsetof(ColliderRow, friction), 44u);
  EXPECT_EQ(offsetof(ColliderRow, friction), 44u);
  EXPECT_EQ(offsetof(ColliderRow, sweepSquared), COLLIDER_SWEEP_ROW * 16u);
  EXPECT_EQ(offsetof(ColliderRow, inverseRadius), COLLIDER_SWEEP_ROW * 16u + 8);
  EXPECT_EQ(offsetof(ColliderRow, axisXX), COLLIDER_AXES_ROW * 16u);
  EXPECT_EQ(offsetof(ColliderRow, sizeX), COLLIDER_AXES_ROW * 16u + 12);
  EXPECT_EQ(offsetof(ColliderRow, axisZX), COLLIDER_AXES_ROW * 16u + 32);
  EXPECT_EQ(offsetof(ColliderRow, rotationXX), COLLIDER_MOTION_ROW * 16u);
  EXPECT_EQ(offsetof(ColliderRow, translationX), COLLIDER_MOTION_ROW * 16u + 12);
  EXPECT_EQ(offsetof(ColliderRow, rotationZX), COLLIDER_MOTION_ROW * 16u + 32);
  EXPECT_EQ(offsetof(ColliderRow, pivotX), COLLIDER_MOTION_ROW * 16u + 48);
}

TEST_F(LayoutTest, OfPinMotionsIsTheRowsThatTheShaderFetches) {
  using PinMotionRow = PinMotionParams<float>;
  EXPECT_EQ(sizeof(PinMotionRow), PIN_MOTION_ROWS * 16u);
  EXPECT_EQ(offsetof(PinMotionRow, rotationXX), 0u);
  EXPECT_EQ(offsetof(PinMotionRow, translationX), 12u);
  EXPECT_EQ(offsetof(PinMotionRow, rotationYX), 16u);
  EXPECT_EQ(offsetof(PinMotionRow, rotationZX), 32u);
  EXPECT_EQ(offsetof(PinMotionRow, translationZ), 44u);
  EXPECT_EQ(offsetof(PinMotionRow, pivotX), 48u);
  EXPECT_EQ(offsetof(PinMotionRow, follow), 60u);
  EXPECT_EQ(offsetof(PinMotionRow, reachSquared), 68u);
}

}  // namespace
}  // namespace clothsim

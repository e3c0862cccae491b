// What the table of passes says (src/solver/pass.h) against what the compiled shaders do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "gl/gl_test.h"
#include "gl/program.h"
#include "shared/implicit.h"
#include "shared/step_params.h"
#include "solver/gpu/arrays.h"
#include "solver/gpu/pass_programs.h"

namespace clothsim {
namespace {

class PassTraitsTest : public GlTest {};

PassFeatures everything(bool mesh) {
  return {.wind = true,
          .movingColliders = true,
          .coulombFriction = true,
          .movingPins = true,
          .restLengthTable = true,
          .material = true,
          .mesh = mesh,
          .limitSprings = true,
          .contactPlanes = true,
          .history = true,
          .grab = true,
          .jet = true,
          .cuts = true,
          .externalForces = true,
          .colliderTypes = 0xffffffff,
          .particleForces = ~0u,
          .enabledSlots = 63};
}

GLint propertyOf(const gl::Program& program, GLenum interface, GLuint index, GLenum property) {
  GLint value = -1;
  glGetProgramResourceiv(program.name(), interface, index, 1, &property, 1, nullptr, &value);
  return value;
}

GLuint countOf(const gl::Program& program, GLenum interface) {
  GLint count = 0;
  glGetProgramInterfaceiv(program.name(), interface, GL_ACTIVE_RESOURCES, &count);
  return static_cast<GLuint>(count);
}

// The texture units from which a program reads.
std::vector<int> unitsOf(const gl::Program& program) {
  std::vector<int> units;
  for (GLuint i = 0; i < countOf(program, GL_UNIFORM); ++i) {
    const GLint type = propertyOf(program, GL_UNIFORM, i, GL_TYPE);
    if (type != GL_SAMPLER_BUFFER && type != GL_UNSIGNED_INT_SAMPLER_BUFFER) continue;
    GLint unit = -1;
    glGetUniformiv(program.name(), propertyOf(program, GL_UNIFORM, i, GL_LOCATION), &unit);
    units.push_back(unit);
  }
  return units;
}

// The storage blocks of a program, by binding. Drivers may count those that no statement uses: the first
// three are declared for every pass.
std::vector<int> bindingsOf(const gl::Program& program) {
  std::vector<int> bindings;
  for (GLuint i = 0; i < countOf(program, GL_SHADER_STORAGE_BLOCK); ++i)
    bindings.push_back(propertyOf(program, GL_SHADER_STORAGE_BLOCK, i, GL_BUFFER_BINDING));
  return bindings;
}

// Of the arrays that the table names, those at this texture unit or binding.
bool isDeclared(Arrays declared, int ArrayPlace::*where, int place) {
  for (int i = 0; i < ARRAY_COUNT; ++i)
    if (placeOf(static_cast<Array>(i)).*where == place && declared.contains(static_cast<Array>(i)))
      return true;
  return false;
}

bool isArray(int ArrayPlace::*where, int place) {
  for (int i = 0; i < ARRAY_COUNT; ++i)
    if (placeOf(static_cast<Array>(i)).*where == place) return true;
  return false;
}

TEST_F(PassTraitsTest, NameEveryArrayThatAShaderReadsOrWrites) {
  PassLibrary library;
  int checked = 0;
  for (const Kernel& kernel : kernels()) {
    Arrays reads, writes;
    for (const Pass pass : kernel.passes) {
      const PassTraits& traits = traitsOf(pass);
      reads = reads | traits.gathers | traits.reads | Arrays{positionsOf(pass)};
      writes = writes | traits.writes;
      if (traits.gate != Gate::none) reads = reads | Arrays{Array::scalars};
    }
    for (const bool mesh : {false, true})
      for (const gl::Program* program : library.find(kernel, everything(mesh))) {
        const std::string where = kernel.stages.front().shader + (mesh ? " of meshes" : " of grids");
        for (const int unit : unitsOf(*program)) {
          if (unit == POSITIONS_UNIT) {
            EXPECT_TRUE(reads.contains(positionsOf(kernel.passes.front()))) << where;
          } else if (isArray(&ArrayPlace::unit, unit)) {
            // What one stage of a kernel has written another may read.
            EXPECT_TRUE(isDeclared(reads | writes, &ArrayPlace::unit, unit))
                << where << " reads unit " << unit;
          }
        }
        for (const int binding : bindingsOf(*program))
          EXPECT_TRUE(binding <= WATCH_BINDING || isDeclared(reads | writes, &ArrayPlace::binding, binding))
              << where << " has a storage block at " << binding;
        ++checked;
      }
  }
  EXPECT_EQ(checked, 2 * (static_cast<int>(kernels().size()) + 6))
      << "coarsening has two shaders, preconditioning three";
}

// These are bound once a list.
TEST_F(PassTraitsTest, LeaveTheBindingsOfTheWatchAndOfForcesAlone) {
  for (int i = 0; i < ARRAY_COUNT; ++i)
    for (const int kept : {WATCH_BINDING, FORCES_BINDING}) {
      const auto array = static_cast<Array>(i);
      if (array == Array::watch || array == Array::forces) continue;
      EXPECT_NE(placeOf(array).binding, kept) << nameOf(array);
    }
}

TEST_F(PassTraitsTest, NameNoArrayThatNoShaderTouches) {
  PassLibrary library;
  for (const Kernel& kernel : kernels()) {
    if (kernel.passes.size() > 1) continue;  // whose passes hand on some arrays without storing them
    const PassTraits& traits = traitsOf(kernel.passes.front());
    std::vector<int> units, bindings;
    for (const bool mesh : {false, true})
      for (const gl::Program* program : library.find(kernel, everything(mesh))) {
        for (const int unit : unitsOf(*program)) units.push_back(unit);
        for (const int binding : bindingsOf(*program)) bindings.push_back(binding);
      }
    const auto has = [](const std::vector<int>& places, int place) {
      return std::find(places.begin(), places.end(), place) != places.end();
    };
    for (int i = 0; i < ARRAY_COUNT; ++i) {
      const auto array = static_cast<Array>(i);
      const ArrayPlace place = placeOf(array);
      const bool isPositions = array == positionsOf(traits.pass) && has(units, POSITIONS_UNIT);
      if (traits.writes.contains(array) && place.binding >= 0) {
        EXPECT_TRUE(has(bindings, place.binding)) << traits.name << " does not write " << nameOf(array);
      }
      if ((traits.gathers | traits.reads).contains(array) && place.unit >= 0) {
        EXPECT_TRUE(isPositions || has(units, place.unit))
            << traits.name << " does not read " << nameOf(array);
      }
    }
  }
}

}  // namespace
}  // namespace clothsim

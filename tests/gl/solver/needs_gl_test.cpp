// What the passes take of the limits of a driver is what the program asks for at its start.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "gl/gl_test.h"
#include "gl/requirements.h"
#include "render/renderer.h"
#include "solver/gpu/gpu_solver.h"
#include "support/compared_scenes.h"
#include "support/throws.h"

namespace clothsim {
namespace {

// The most that any program took which was linked while this lives, by limit.
class NeedsOfPrograms {
 public:
  NeedsOfPrograms() {
    needs.clear();
    original = glad_glLinkProgram;
    glad_glLinkProgram = [](GLuint program) {
      original(program);
      note(program);
    };
  }
  ~NeedsOfPrograms() { glad_glLinkProgram = original; }
  NeedsOfPrograms(const NeedsOfPrograms&) = delete;
  NeedsOfPrograms& operator=(const NeedsOfPrograms&) = delete;
  static inline std::map<GLenum, GLint> needs;

 private:
  static void raise(GLenum limit, GLint need) { needs[limit] = std::max(needs[limit], need); }
  static GLint count(GLuint program, GLenum interface) {
    GLint number = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &number);
    return number;
  }
  static GLint valueOf(GLuint program, GLenum interface, GLint resource, GLenum property) {
    GLint value = 0;
    glGetProgramResourceiv(program, interface, static_cast<GLuint>(resource), 1, &property, 1, nullptr,
                           &value);
    return value;
  }

  static void noteBlocks(GLuint program, GLenum interface, GLenum number, GLenum bindings) {
    raise(number, count(program, interface));
    for (GLint i = 0; i < count(program, interface); ++i)
      raise(bindings, valueOf(program, interface, i, GL_BUFFER_BINDING) + 1);
  }
  static void note(GLuint program) {
    GLint shaders = 0, group[3] = {};
    glGetProgramiv(program, GL_ATTACHED_SHADERS, &shaders);
    if (shaders != 1) return;  // one that draws
    glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, group);
    raise(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, group[0] * group[1] * group[2]);
    noteBlocks(program, GL_SHADER_STORAGE_BLOCK, GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS,
               GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
    noteBlocks(program, GL_UNIFORM_BLOCK, GL_MAX_COMPUTE_UNIFORM_BLOCKS, GL_MAX_UNIFORM_BUFFER_BINDINGS);
    GLint textures = 0;
    for (GLint i = 0; i < count(program, GL_UNIFORM); ++i) {
      if (valueOf(program, GL_UNIFORM, i, GL_BLOCK_INDEX) != -1) continue;
      GLint unit = 0;
      glGetUniformiv(program, valueOf(program, GL_UNIFORM, i, GL_LOCATION), &unit);
      raise(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, unit + 1);
      ++textures;
    }
    raise(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, textures);
  }
  static inline PFNGLLINKPROGRAMPROC original = nullptr;
};

using NeedsTest = GlTest;

TEST_F(NeedsTest, OfThePassesAreThoseThatAContextIsAskedFor) {
  const NeedsOfPrograms programs;
  std::vector<Scene> scenes{test::meshWithEverything(8, SelfCollision::robust)};
  Scene contact = test::implicitly(test::withWind(test::withColliders(test::materialScene(16))));
  contact.solver.selfCollision = SelfCollision::contact;
  scenes.push_back(test::inSecondOrder(contact));
  for (const Scene& scene : scenes) {
    const Cloth cloth(scene);
    const GpuSolver solver(cloth, scene, {.storageLoads = false});  // taken only where there is room for more
    const Renderer renderer(cloth, scene, {});
  }
  for (const gl::NeededLimit& limit : gl::neededLimits()) {
    SCOPED_TRACE(limit.what);
    EXPECT_LE(NeedsOfPrograms::needs[limit.name], limit.least);
    NeedsOfPrograms::needs.erase(limit.name);
  }
  EXPECT_TRUE(NeedsOfPrograms::needs.empty()) << "a limit that nobody asks for";
}

TEST_F(NeedsTest, ThatADriverCannotMeetAreToldInASentence) {
  const Scene scene = test::sheetScene(257);
  const Cloth cloth(scene);
  static PFNGLGETINTEGER64VPROC original = nullptr;
  original = glad_glGetInteger64v;
  glad_glGetInteger64v = [](GLenum name, GLint64* value) {  // the least that OpenGL promises
    original(name, value);
    if (name == GL_MAX_TEXTURE_BUFFER_SIZE) *value = 65536;
  };
  EXPECT_EQ(test::messageThrownBy<OpenGlError>([&] { GpuSolver(cloth, scene); }),
            "this cloth needs 66049 particles in one buffer, and this driver allows 65536. Use a smaller "
            "--resolution, or --backend cpu.");
  glad_glGetInteger64v = original;
}

TEST_F(NeedsTest, ThatAContextCannotMeetAreNamed) {
  static PFNGLGETINTEGERVPROC original = nullptr;
  original = glad_glGetIntegerv;
  glad_glGetIntegerv = [](GLenum name, GLint* value) {
    original(name, value);
    if (name == GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS) *value = 8;
  };
  EXPECT_EQ(gl::missingCapability(testContext()),
            "it allows 8 storage buffers in a compute shader, fewer than 9");
  glad_glGetIntegerv = original;
}

}  // namespace
}  // namespace clothsim

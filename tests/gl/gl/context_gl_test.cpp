#include "gl/context.h"

#include "core/error.h"
#include "gl/api.h"
#include "gl/gl_test.h"
#include "gl/requirements.h"

namespace clothsim {
namespace {

using ContextTest = GlTest;

TEST_F(ContextTest, TellsWhatItIs) {
  const gl::ContextInfo& info = testContext();
  EXPECT_GE(info.major * 10 + info.minor, 45);
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_GE(info.maxWorkGroupCountX, 65535);
  EXPECT_GE(info.maxWorkGroupInvocations, 128);
  EXPECT_GE(info.maxStorageBlockBytes, 1LL << 27);
  EXPECT_EQ(info.software, info.renderer.find("llvmpipe") != std::string::npos);
}

TEST_F(ContextTest, CanDoAllThatTheShadersNeed) { EXPECT_EQ(gl::missingCapability(testContext()), ""); }

TEST_F(ContextTest, AnErrorOfTheDriverThrowsAtTheNextCheckAndOnlyThere) {
  glBindBuffer(GL_TEXTURE_2D, 0);  // not a buffer target
  try {
    gl::checkErrors("a deliberate mistake");
    FAIL() << "the error went unnoticed";
  } catch (const OpenGlError& error) {
    EXPECT_NE(std::string(error.what()).find("a deliberate mistake"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("GL_INVALID_ENUM"), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(gl::checkErrors("the line after"));
}

TEST_F(ContextTest, AnOldVersionIsRefusedByName) {
  gl::ContextInfo old = testContext();
  old.major = 4;
  old.minor = 2;
  old.version = "4.2 (Core Profile)";
  try {
    gl::requireCapabilities(old);
    FAIL() << "4.2 was accepted";
  } catch (const OpenGlError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("4.2 (Core Profile)"), std::string::npos) << message;
    EXPECT_NE(message.find("OpenGL 4.5 core with compute shaders"), std::string::npos) << message;
    EXPECT_NE(message.find("libgl1-mesa-dri"), std::string::npos) << message;
    EXPECT_NE(message.find("clothsim run --backend cpu"), std::string::npos) << message;
  }
}

// What needs a process without a context: contexts replace each other as the current one, and drivers read
// the environment once. "threadsafe" starts the program anew for each, since a fork of llvmpipe's threads
// would hang.
class FreshProcessTest : public ::testing::Test {
 protected:
  void SetUp() override { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
  static void expectRefusal(const char* variable, const char* value, const char* message) {
    EXPECT_EXIT(
        {
          setenv(variable, value, 1);
          try {
            const gl::HeadlessContext context;
            std::cerr << "accepted " << context.info().version;
          } catch (const Error& error) {
            std::cerr << error.what();
            std::exit(static_cast<int>(error.exitCode()));
          }
          std::exit(0);
        },
        ::testing::ExitedWithCode(4), message);
  }
};

TEST_F(FreshProcessTest, AContextCanBeMadeAgainAfterTheFirstIsGone) {
  EXPECT_EXIT(
      {
        { const gl::HeadlessContext first; }
        const gl::HeadlessContext second;
        std::exit(glGetError() == GL_NO_ERROR ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST_F(FreshProcessTest, AVersionHeldDownByTheEnvironmentIsReportedWithTheVariable) {
  expectRefusal("MESA_GL_VERSION_OVERRIDE", "4.2", "unset.*MESA_GL_VERSION_OVERRIDE=4.2");
}

TEST_F(FreshProcessTest, AFolderWithoutDriversIsReportedWithTheVariable) {
  expectRefusal("LIBGL_DRIVERS_PATH", "/nonexistent", "unset.*LIBGL_DRIVERS_PATH=/nonexistent");
}

TEST_F(FreshProcessTest, ADriverWithoutComputeShadersIsReportedWithTheVariable) {
  expectRefusal("GALLIUM_DRIVER", "softpipe", "softpipe.*unset.*GALLIUM_DRIVER=softpipe");
}

}  // namespace
}  // namespace clothsim

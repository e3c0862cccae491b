#include "gl/program.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/files.h"
#include "gl/buffer.h"
#include "gl/gl_test.h"

namespace clothsim {
namespace {

// Shaders written for one test into a folder of their own under shaders/, the one place that is searched.
class ProgramTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    std::filesystem::create_directories(resourceRoot() / "shaders" / folder());
  }
  void TearDown() override {
    std::filesystem::remove_all(resourceRoot() / "shaders" / folder());
    GlTest::TearDown();
  }
  // The same file name may be used by tests that run at the same time in other processes.
  [[nodiscard]] static std::string folder() {
    return std::string("test_") + ::testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  [[nodiscard]] static std::string write(const std::string& name, const std::string& text) {
    std::ofstream(resourceRoot() / "shaders" / folder() / name) << text;
    return folder() + "/" + name;
  }
  static std::string errorOf(const std::string& file) {
    try {
      static_cast<void>(gl::Program::makeCompute(file));
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(ProgramTest, ComputesWithAnIncludedConstantAndADefine) {
  const std::string header = write("constants.h", "const uint three = 3u;\n");
  const std::string file = write("sum.comp", "#include \"" + header + R"("
layout(local_size_x = GROUP_SIZE) in;
layout(std430, binding = 0) buffer Out { uint values[]; };
void main() {
  if (gl_GlobalInvocationID.x < 100u) values[gl_GlobalInvocationID.x] = three * gl_GlobalInvocationID.x;
}
)");
  const gl::Program program = gl::Program::makeCompute(file, {{"GROUP_SIZE", "32"}});
  const gl::Buffer<std::uint32_t> out("out", std::vector<std::uint32_t>(101, 7u));
  out.bindStorage(0);
  program.bind();
  gl::dispatch(100, 32);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const std::vector<std::uint32_t> values = out.download();
  EXPECT_EQ(values[1], 3u);
  EXPECT_EQ(values[99], 297u);
  EXPECT_EQ(values[100], 7u) << "the last, partly filled work group must not write past the end";
}

// Dear ImGui notes the program in use, draws, and uses that one again.
TEST_F(ProgramTest, ThatGoesIsInUseNoLonger) {
  const std::string file = write("nothing.comp", "layout(local_size_x = 1) in;\nvoid main() {}\n");
  gl::Program::makeCompute(file).bind();
  GLint used = -1;
  glGetIntegerv(GL_CURRENT_PROGRAM, &used);
  EXPECT_EQ(used, 0);
}

TEST_F(ProgramTest, AnErrorNamesTheFileAndLine) {
  const std::string file =
      write("wrong.comp", "layout(local_size_x = 1) in;\nvoid main() {\n  nonsense = 1;\n}\n");
  EXPECT_NE(errorOf(file).find("shaders/" + file + ":3"), std::string::npos) << errorOf(file);
}

TEST_F(ProgramTest, AnErrorInAnIncludedFileNamesThatFileAndItsLine) {
  const std::string header = write("wrong.glsl", "\n\nfloat f() { return nonsense; }\n");
  const std::string file =
      write("a.comp", "#include \"" + header + "\"\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
  EXPECT_NE(errorOf(file).find("shaders/" + header + ":3"), std::string::npos) << errorOf(file);
}

TEST_F(ProgramTest, AnErrorInAnIncludedFunctionDoesSoToo) {
  const std::string header = write("wrong2.glsl", "\n\nvoid f() {\n  nonsense;\n}\n");
  const std::string file =
      write("d.comp", "#include \"" + header + "\"\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
  EXPECT_NE(errorOf(file).find("shaders/" + header + ":4"), std::string::npos) << errorOf(file);
}

TEST_F(ProgramTest, LinesAfterAnIncludeKeepTheirNumbers) {
  const std::string header = write("fine.glsl", "\n\n\n\n");
  const std::string file =
      write("b.comp", "// first\n#include \"" + header + "\"\nlayout(local_size_x = 1) in;\nnonsense\n");
  EXPECT_TRUE(errorOf(file).find("shaders/" + file + ":4") != std::string::npos ||
              errorOf(file).find("shaders/" + file + ":5") !=
                  std::string::npos)  // the parser may notice a line later
      << errorOf(file);
}

TEST_F(ProgramTest, AFileIncludedByTwoOthersAppearsOnce) {
  const std::string common = write("common.glsl", "const int common_number = 1;\n");
  const std::string user = write("user.glsl", "#include \"" + common + "\"\n");
  const std::string file = write("c.comp", "#include \"" + common + "\"\n#include \"" + user +
                                               "\"\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
  EXPECT_NO_THROW(static_cast<void>(gl::Program::makeCompute(file)));
}

TEST_F(ProgramTest, AnIncludeThatGoesRoundInACircleIsAnErrorThatShowsTheCircle) {
  const std::string a = folder() + "/a.glsl";
  const std::string b = write("b.glsl", "#include \"" + a + "\"\n");
  EXPECT_EQ(write("a.glsl", "#include \"" + b + "\"\n"), a);
  const std::string expected = "shaders/" + a + " -> shaders/" + b + " -> shaders/" + a;
  EXPECT_NE(errorOf(a).find(expected), std::string::npos) << errorOf(a);
}

TEST_F(ProgramTest, AMissingFileIsAnInputOutputError) {
  EXPECT_THROW(static_cast<void>(gl::Program::makeCompute("render/absent.comp")), InputOutputError);
}

TEST(ReadableLogTest, UnderstandsTheWayEachDriverWritesAPlace) {
  const gl::ShaderSource source{"", {"sim/step.comp", "shared/layout.h"}};
  EXPECT_EQ(gl::readableLog("1:12(5): error: x", source), "shaders/shared/layout.h:12: error: x\n");  // Mesa
  EXPECT_EQ(gl::readableLog("0(7) : error C1503: x", source),
            "shaders/sim/step.comp:7 : error C1503: x\n");  // NVIDIA
  EXPECT_EQ(gl::readableLog("ERROR: 0:3: 'x' : undeclared", source),
            "ERROR: shaders/sim/step.comp:3: 'x' : undeclared\n");  // AMD, glslang
  EXPECT_EQ(gl::readableLog("no place at all", source), "no place at all\n");
}

}  // namespace
}  // namespace clothsim

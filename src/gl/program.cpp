#include "gl/program.h"

#include <array>
#include <cassert>
#include <chrono>

#include "core/error.h"

namespace clothsim::gl {
namespace {

// A compiled shader that is deleted with its scope; a linked program keeps what it needs of it.
class Shader {
 public:
  Shader(GLenum stage, const std::string& file, const Defines& defines) {
    const ShaderSource source = loadShaderSource(file, defines);
    name_ = glCreateShader(stage);
    const char* text = source.text.c_str();
    glShaderSource(name_, 1, &text, nullptr);
    glCompileShader(name_);
    glObjectLabel(GL_SHADER, name_, static_cast<GLsizei>(file.size()), file.c_str());
    GLint compiled = GL_FALSE;
    glGetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return;
    GLint length = 0;
    glGetShaderiv(name_, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetShaderInfoLog(name_, length, nullptr, log.data());
    glDeleteShader(name_);
    throw OpenGlError("shaders/" + file + " does not compile:\n" + readableLog(log.c_str(), source));
  }
  ~Shader() { glDeleteShader(name_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

void link(GLuint program, const std::string& label) {
  glLinkProgram(program);
  glObjectLabel(GL_PROGRAM, program, static_cast<GLsizei>(label.size()), label.c_str());
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  glGetProgramInfoLog(program, length, nullptr, log.data());
  throw OpenGlError(label + " does not link:\n" + log.c_str());
}

thread_local std::vector<Compilation> compiled;

}  // namespace

const std::vector<Compilation>& compilations() { return compiled; }

Program Program::make(const std::vector<Stage>& stages, const Defines& defines) {
  const auto start = std::chrono::steady_clock::now();
  std::string label;
  Program program;
  program.name_ = glCreateProgram();
  for (const Stage& stage : stages) {
    const Shader shader(stage.kind, stage.file, defines);
    // The attached shader lives until its program is linked and lets it go.
    glAttachShader(program.name_, shader.name());
    label += (label.empty() ? "" : " + ") + stage.file;
  }
  link(program.name_, label);
  std::array<GLuint, 3> attached{};
  GLsizei count = 0;
  glGetAttachedShaders(program.name_, static_cast<GLsizei>(attached.size()), &count, attached.data());
  for (GLsizei i = 0; i < count; ++i) glDetachShader(program.name_, attached[static_cast<std::size_t>(i)]);
  compiled.push_back(
      {label, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
  return program;
}

Program Program::makeCompute(const std::string& file, const Defines& defines) {
  Program program = make({{GL_COMPUTE_SHADER, file}}, defines);
  GLint size[3] = {};
  glGetProgramiv(program.name_, GL_COMPUTE_WORK_GROUP_SIZE, size);
  program.group_ = {size[0], size[1]};
  return program;
}

Program Program::makeRender(const std::string& vertexFile, const std::string& fragmentFile,
                            const Defines& defines) {
  return make({{GL_VERTEX_SHADER, vertexFile}, {GL_FRAGMENT_SHADER, fragmentFile}}, defines);
}

Program Program::makeRender(const std::string& vertexFile, const std::string& geometryFile,
                            const std::string& fragmentFile, const Defines& defines) {
  return make({{GL_VERTEX_SHADER, vertexFile},
               {GL_GEOMETRY_SHADER, geometryFile},
               {GL_FRAGMENT_SHADER, fragmentFile}},
              defines);
}

Program::~Program() {
  if (name_ == 0) return;
  // One that is in use lives on, nameless, until another is. Who notes its name until then, as Dear ImGui
  // does to use it again when all is drawn, causes an error.
  GLint used = 0;
  glGetIntegerv(GL_CURRENT_PROGRAM, &used);
  if (static_cast<GLuint>(used) == name_) glUseProgram(0);
  glDeleteProgram(name_);
}

namespace {

thread_local std::uint64_t dispatches = 0;

}  // namespace

std::uint64_t dispatchCount() { return dispatches; }

void dispatch(std::uint32_t columns, std::uint32_t rows, int groupColumns, int groupRows) {
  assert(groupColumns > 0 && groupRows > 0 && "a work group has at least one invocation");
  const auto width = static_cast<std::uint32_t>(groupColumns), height = static_cast<std::uint32_t>(groupRows);
  const std::uint32_t groupsX = (columns + width - 1) / width, groupsY = (rows + height - 1) / height;
  assert(groupsX <= 65535 && groupsY <= 65535 &&
         "every driver takes 65,535 work groups, and no more is promised");
  if (groupsX == 0 || groupsY == 0) return;
  ++dispatches;
  glDispatchCompute(groupsX, groupsY, 1);
}

void dispatch(std::size_t count, int workGroupSize) {
  dispatch(static_cast<std::uint32_t>(count), 1, workGroupSize, 1);
}

void dispatchIndirect(std::size_t offset) {
  ++dispatches;
  glDispatchComputeIndirect(static_cast<GLintptr>(offset));
}

}  // namespace clothsim::gl

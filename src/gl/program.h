// A linked shader program, made from the files under shaders/; move-only.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gl/api.h"
#include "gl/bindings.h"
#include "gl/shader_source.h"

namespace clothsim::gl {

// Invocations of a work group.
struct GroupShape {
  int columns = 1, rows = 1;
};

class Program {
 public:
  Program() = default;
  // @throws OpenGlError with file, line and the driver's message
  [[nodiscard]] static Program makeCompute(const std::string& file, const Defines& defines = {});
  [[nodiscard]] static Program makeRender(const std::string& vertexFile, const std::string& fragmentFile,
                                          const Defines& defines = {});
  [[nodiscard]] static Program makeRender(const std::string& vertexFile, const std::string& geometryFile,
                                          const std::string& fragmentFile, const Defines& defines = {});
  ~Program();
  Program(Program&& other) noexcept { *this = std::move(other); }
  Program& operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(group_, other.group_);
    return *this;
  }

  [[nodiscard]] GLuint name() const { return name_; }
  [[nodiscard]] GroupShape group() const { return group_; }  // as its shader declares it
  void bind() const {
    if (KeptBindings::changes(KeptBindings::Kind::program, 0, {name_})) glUseProgram(name_);
  }

 private:
  struct Stage {
    GLenum kind;
    std::string file;
  };
  static Program make(const std::vector<Stage>& stages, const Defines& defines);

  GLuint name_ = 0;
  GroupShape group_;
};

// Work groups for columns x rows invocations; asserts that they stay within the 65,535 that every driver
// takes: beyond it the dispatch does nothing, and nobody says so.
void dispatch(std::uint32_t columns, std::uint32_t rows, int groupColumns, int groupRows);
void dispatch(std::size_t count, int workGroupSize);
// As many work groups as the bound buffer says, at this byte (GL_DISPATCH_INDIRECT_BUFFER).
void dispatchIndirect(std::size_t offset);
// What this thread has compiled and linked so far, in order.
struct Compilation {
  std::string program;  // its files
  double seconds = 0;
};
[[nodiscard]] const std::vector<Compilation>& compilations();
// How many dispatches this thread has made so far.
[[nodiscard]] std::uint64_t dispatchCount();

}  // namespace clothsim::gl

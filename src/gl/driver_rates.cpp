// Copies, loads and arithmetic as in a step, and dispatches that do next to nothing.
#include "gl/driver_rates.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "gl/api.h"
#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/program.h"

namespace clothsim::gl {
namespace {

using Point = std::array<float, 4>;

std::string sizeText(int size) { return std::to_string(size) + "x" + std::to_string(size); }

void measureCopies(bool small, const TellRate& tell) {
  const Program copy = Program::makeCompute("probe/copy.comp");
  const auto largest = static_cast<std::size_t>(currentContextInfo().maxStorageBlockBytes);
  for (const std::size_t mebibytes : {1, 4, 16, 64, 256, 1024}) {
    const std::size_t bytes = mebibytes << 20;
    if (bytes > largest || (small && mebibytes > 16)) break;
    const Buffer<float> source("copied", bytes / sizeof(float)), target("copy", bytes / sizeof(float));
    static constexpr GLfloat one = 1;
    glClearNamedBufferData(source.name(), GL_R32F, GL_RED, GL_FLOAT, &one);
    checkErrors("the making of what is copied");
    source.bindStorage(0);
    target.bindStorage(1);
    copy.bind();
    constexpr std::size_t bytesOfAGroup = 256 * 16;
    const auto groups = static_cast<std::uint32_t>(bytes / bytesOfAGroup);
    const std::uint32_t across = std::min(groups, 32768u);
    const int count = small ? 2 : static_cast<int>(std::clamp<std::size_t>((4096 / mebibytes), 8, 500));
    const WorkTime time = timeWork(count, [&] {
      dispatch(across, groups / across, 1, 1);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    });
    tell("copy " + std::to_string(mebibytes) + " MiB, read and written",
         2e-9 * static_cast<double>(bytes) / time.seconds, "GB/s");
  }
}

void measureStencils(bool small, const TellRate& tell) {
  const int size = small ? 128 : 1024;
  const std::size_t count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const Buffer<Point> points("points", count), sums("sums", count);
  const BufferTexture texture("points", points.name(), GL_RGBA32F);
  glClearNamedBufferData(points.name(), GL_RGBA32F, GL_RGBA, GL_FLOAT, nullptr);
  points.bindStorage(0);
  sums.bindStorage(1);
  texture.bind(0);
  const char* loads[] = {"texels", "a storage block", "a tile in shared memory"};
  for (int load = 0; load < 3; ++load)
    for (const auto& [columns, rows] : {std::pair{64, 1}, std::pair{32, 8}, std::pair{16, 16}}) {
      const Program stencil =
          Program::makeCompute("probe/stencil.comp", {{"GROUP_COLUMNS", std::to_string(columns)},
                                                      {"GROUP_ROWS", std::to_string(rows)},
                                                      {"SIZE", std::to_string(size) + "u"},
                                                      {"LOADS", std::to_string(load)}});
      stencil.bind();
      const WorkTime time = timeWork(small ? 2 : 200, [&, columns = columns, rows = rows] {
        dispatch(static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size), columns, rows);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
      });
      tell("13 loads a point of " + sizeText(size) + " by " + loads[load] + ", groups of " +
               std::to_string(columns) + "x" + std::to_string(rows),
           time.seconds * 1e6, "us");
    }
}

void measureSprings(bool small, const TellRate& tell) {
  const std::uint32_t count = small ? 1u << 12 : 1u << 20, springs = small ? 16 : 64;
  const Buffer<Point> forces("forces", count);
  forces.bindStorage(0);
  const char* arithmetics[] = {"exact", "with fused products and sums", "with the driver's inversesqrt"};
  for (int arithmetic = 0; arithmetic < 3; ++arithmetic) {
    const Program program = Program::makeCompute(
        "probe/springs.comp",
        {{"ARITHMETIC", std::to_string(arithmetic)}, {"SPRINGS", std::to_string(springs) + "u"}});
    program.bind();
    const WorkTime time = timeWork(small ? 1 : 20, [&] {
      dispatch(count, 64);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    });
    tell(std::string("springs, ") + arithmetics[arithmetic], count * springs / time.seconds * 1e-9,
         "G springs/s");
  }
}

}  // namespace

std::vector<std::pair<std::string, long long>> driverLimits() {
  std::vector<std::pair<std::string, long long>> limits;
  const auto add = [&](const char* name, GLenum limit) {
    GLint64 value = 0;
    glGetInteger64v(limit, &value);
    limits.emplace_back(name, value);
  };
  add("texture_buffer_texels", GL_MAX_TEXTURE_BUFFER_SIZE);
  add("storage_block_bytes", GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  add("storage_blocks_a_pass", GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
  add("storage_bindings", GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
  add("storage_offset_alignment", GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
  add("uniform_block_bytes", GL_MAX_UNIFORM_BLOCK_SIZE);
  add("uniform_blocks_a_pass", GL_MAX_COMPUTE_UNIFORM_BLOCKS);
  add("uniform_bindings", GL_MAX_UNIFORM_BUFFER_BINDINGS);
  add("uniform_offset_alignment", GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT);
  add("textures_a_pass", GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS);
  add("texture_units", GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
  add("shared_memory_bytes", GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
  add("invocations_a_group", GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
  for (const auto& [name, axis] : {std::pair{"groups_across", 0u}, std::pair{"groups_along", 1u}}) {
    GLint groups = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &groups);
    limits.emplace_back(name, groups);
  }
  return limits;
}

void measureDispatches(bool small, const TellRate& tell) {
  const Program first = Program::makeCompute("probe/dispatch.comp"),
                second = Program::makeCompute("probe/dispatch.comp");
  const Buffer<float> numbers("numbers", 128), others("other numbers", 128);
  for (const Buffer<float>* buffer : {&numbers, &others})
    glClearNamedBufferData(buffer->name(), GL_R32F, GL_RED, GL_FLOAT, nullptr);
  const std::array<std::uint32_t, 3> none[] = {{0, 1, 1}};
  const Buffer<std::array<std::uint32_t, 3>> groups("no groups", std::span(none));
  groups.bindDispatches();
  numbers.bindStorage(0);
  first.bind();
  constexpr GLbitfield storage = GL_SHADER_STORAGE_BARRIER_BIT, texels = GL_TEXTURE_FETCH_BARRIER_BIT,
                       commands = GL_COMMAND_BARRIER_BIT, ofAPass = storage | texels | commands;
  const auto dispatchBefore = [](GLbitfield barrier) {
    dispatch(std::size_t{64}, 64);
    if (barrier != 0) glMemoryBarrier(barrier);
  };
  const auto measure = [&](const std::string& name, const std::function<void()>& work) {
    const WorkTime time = timeWork(small ? 20 : 2000, work);
    tell(name, time.seconds * 1e6, "us/dispatch");
    tell(name + ", submitting", time.submit * 1e6, "us/dispatch");
  };
  measure("no barrier", [&] { dispatchBefore(0); });
  measure("barrier: storage", [&] { dispatchBefore(storage); });
  measure("barrier: texels", [&] { dispatchBefore(texels); });
  measure("barrier: storage, texels", [&] { dispatchBefore(storage | texels); });
  measure("barrier: commands", [&] { dispatchBefore(commands); });
  measure("barrier: storage, texels, commands", [&] { dispatchBefore(ofAPass); });
  bool turn = false;
  measure("that, and another program", [&] {
    (turn ? first : second).bind();
    turn = !turn;
    dispatchBefore(ofAPass);
  });
  measure("that, and another storage buffer", [&] {
    (turn ? numbers : others).bindStorage(0);
    turn = !turn;
    dispatchBefore(ofAPass);
  });
  measure("indirect with no groups", [&] {
    dispatchIndirect(0);
    glMemoryBarrier(ofAPass);
  });
}

void measureRoofs(bool small, const TellRate& tell) {
  measureCopies(small, tell);
  measureStencils(small, tell);
  measureSprings(small, tell);
}

}  // namespace clothsim::gl

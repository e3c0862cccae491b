// Measurements of a driver: its limits, its compiler, and how fast it does what a step is made of.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "commands/bench.h"
#include "commands/probe.h"
#include "core/error.h"
#include "gl/api.h"
#include "gl/buffer.h"
#include "gl/buffer_texture.h"
#include "gl/context.h"
#include "gl/program.h"
#include "render/renderer.h"
#include "scene_io/scene_io.h"
#include "scene_io/scene_options.h"
#include "solver/gpu/gpu_solver.h"

namespace clothsim {
namespace {

using Clock = std::chrono::steady_clock;

void addValue(const ProbeLine& line, const std::string& name, double value, const char* unit) {
  line({{"case", name}, {"value", value}, {"unit", unit}});
}

// Seconds of `count` times `work`, divided by `count`: the median of five. `submit`: those until the calls
// return.
struct WorkTime {
  double seconds = 0, submit = 0;
};
template <class Work>
WorkTime timeWork(int count, Work work) {
  work();  // some drivers compile now
  std::vector<double> whole, submit;
  for (int repetition = 0; repetition < 5; ++repetition) {
    glFinish();
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < count; ++i) work();
    submit.push_back(std::chrono::duration<double>(Clock::now() - start).count() / count);
    glFinish();
    whole.push_back(std::chrono::duration<double>(Clock::now() - start).count() / count);
  }
  std::sort(whole.begin(), whole.end());
  std::sort(submit.begin(), submit.end());
  return {whole[2], submit[2]};
}

// A configuration of the scene `pinned2`, in steps as PERFORMANCE.md counts them.
struct Configuration {
  const char* name;
  std::vector<std::string> settings;
};
const std::vector<Configuration>& configurations() {
  static const std::vector<Configuration> all{
      {"plain", {"solver.strain_limit=false", "solver.self_collision=false"}},
      {"limiter", {"solver.strain_limit=0.1", "solver.self_collision=false"}},
      {"robust", {"solver.strain_limit=0.1", "solver.self_collision=robust"}},
      {"implicit",
       {"solver.strain_limit=false", "solver.self_collision=false", "solver.integrator=implicit",
        "solver.frames_per_sec=60", "solver.simulation_steps=1", "solver.newton_steps=4",
        "solver.cg_iterations=10"}},
      {"implicit with contact",
       {"cloth.material=cotton", "solver.strain_limit=false", "solver.self_collision=contact",
        "solver.integrator=implicit", "solver.frames_per_sec=60", "solver.simulation_steps=1",
        "solver.newton_steps=4", "solver.cg_iterations=10"}}};
  return all;
}

Scene sceneOf(const Configuration& configuration, int size) {
  return readScene({"pinned2", GridSize{size, size}, configuration.settings, {}}).scene;
}

std::string sizeText(int size) { return std::to_string(size) + "x" + std::to_string(size); }

// What is too large for the driver is a line of its own.
template <class Measure>
void measureOrSay(const ProbeLine& line, const std::string& name, Measure measure) {
  try {
    measure();
  } catch (const OpenGlError& error) {
    line({{"case", name}, {"error", error.what()}});
  }
}

void probeCopies(bool small, const ProbeLine& line) {
  const gl::Program copy = gl::Program::makeCompute("probe/copy.comp");
  const auto largest = static_cast<std::size_t>(gl::currentContextInfo().maxStorageBlockBytes);
  for (const std::size_t mebibytes : {1, 4, 16, 64, 256, 1024}) {
    const std::size_t bytes = mebibytes << 20;
    if (bytes > largest || (small && mebibytes > 16)) break;
    const gl::Buffer<float> source("copied", bytes / sizeof(float)), target("copy", bytes / sizeof(float));
    static constexpr GLfloat one = 1;
    glClearNamedBufferData(source.name(), GL_R32F, GL_RED, GL_FLOAT, &one);
    gl::checkErrors("the making of what is copied");
    source.bindStorage(0);
    target.bindStorage(1);
    copy.bind();
    constexpr std::size_t bytesOfAGroup = 256 * 16;
    const auto groups = static_cast<std::uint32_t>(bytes / bytesOfAGroup);
    const std::uint32_t across = std::min(groups, 32768u);
    const int count = small ? 2 : static_cast<int>(std::clamp<std::size_t>((4096 / mebibytes), 8, 500));
    const WorkTime time = timeWork(count, [&] {
      gl::dispatch(across, groups / across, 1, 1);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    });
    addValue(line, "copy " + std::to_string(mebibytes) + " MiB, read and written",
             2e-9 * static_cast<double>(bytes) / time.seconds, "GB/s");
  }
}

void probeStencils(bool small, const ProbeLine& line) {
  const int size = small ? 128 : 1024;
  const std::size_t count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const gl::Buffer<Particle4> points("points", count), sums("sums", count);
  const gl::BufferTexture texture("points", points.name(), GL_RGBA32F);
  glClearNamedBufferData(points.name(), GL_RGBA32F, GL_RGBA, GL_FLOAT, nullptr);
  points.bindStorage(0);
  sums.bindStorage(1);
  texture.bind(0);
  const char* loads[] = {"texels", "a storage block", "a tile in shared memory"};
  for (int load = 0; load < 3; ++load)
    for (const auto& [columns, rows] : {std::pair{64, 1}, std::pair{32, 8}, std::pair{16, 16}}) {
      const gl::Program stencil =
          gl::Program::makeCompute("probe/stencil.comp", {{"GROUP_COLUMNS", std::to_string(columns)},
                                                          {"GROUP_ROWS", std::to_string(rows)},
                                                          {"SIZE", std::to_string(size) + "u"},
                                                          {"LOADS", std::to_string(load)}});
      stencil.bind();
      const WorkTime time = timeWork(small ? 2 : 200, [&] {
        gl::dispatch(static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size), columns, rows);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
      });
      addValue(line,
               "13 loads a point of " + sizeText(size) + " by " + loads[load] + ", groups of " +
                   std::to_string(columns) + "x" + std::to_string(rows),
               time.seconds * 1e6, "us");
    }
}

void probeSprings(bool small, const ProbeLine& line) {
  const std::uint32_t count = small ? 1u << 12 : 1u << 20, springs = small ? 16 : 64;
  const gl::Buffer<Particle4> forces("forces", count);
  forces.bindStorage(0);
  const char* arithmetics[] = {"exact", "with fused products and sums", "with the driver's inversesqrt"};
  for (int arithmetic = 0; arithmetic < 3; ++arithmetic) {
    const gl::Program program = gl::Program::makeCompute(
        "probe/springs.comp",
        {{"ARITHMETIC", std::to_string(arithmetic)}, {"SPRINGS", std::to_string(springs) + "u"}});
    program.bind();
    const WorkTime time = timeWork(small ? 1 : 20, [&] {
      gl::dispatch(count, 64);
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    });
    addValue(line, std::string("springs, ") + arithmetics[arithmetic], count * springs / time.seconds * 1e-9,
             "G springs/s");
  }
}

}  // namespace

void probeLimits(const ProbeLine& line) {
  const gl::ContextInfo info = gl::currentContextInfo();
  nlohmann::ordered_json json{{"vendor", info.vendor},
                              {"renderer", info.renderer},
                              {"version", info.version},
                              {"software", info.software}};
  const auto add = [&](const char* name, GLenum limit) {
    GLint64 value = 0;
    glGetInteger64v(limit, &value);
    json["limits"][name] = value;
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
  GLint groups = 0;
  glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &groups);
  json["limits"]["groups_across"] = info.maxWorkGroupCountX;
  json["limits"]["groups_along"] = groups;
  line(json);
}

void probePrograms(const ProbeLine& line) {
  std::size_t told = 0;
  const auto tellFrom = [&](const std::string& name) {
    const std::vector<gl::Compilation>& all = gl::compilations();
    for (; told < all.size(); ++told) addValue(line, name + ": " + all[told].program, all[told].seconds, "s");
  };
  for (const Configuration& configuration : configurations()) {
    const Scene scene = sceneOf(configuration, 33);
    const Cloth cloth(scene);
    const GpuSolver solver(cloth, scene);
    tellFrom(configuration.name);
  }
  const Scene demo = loadSceneByName("demo");
  const Cloth cloth(demo);
  const Renderer renderer(cloth, demo, {});
  tellFrom("drawing the demo");
}

void probeDispatches(bool small, const ProbeLine& line) {
  const gl::Program first = gl::Program::makeCompute("probe/dispatch.comp"),
                    second = gl::Program::makeCompute("probe/dispatch.comp");
  const gl::Buffer<float> numbers("numbers", 128), others("other numbers", 128);
  for (const gl::Buffer<float>* buffer : {&numbers, &others})
    glClearNamedBufferData(buffer->name(), GL_R32F, GL_RED, GL_FLOAT, nullptr);
  const Groups none[] = {{0, 1, 1}};
  const gl::Buffer<Groups> groups("no groups", std::span<const Groups>(none));
  groups.bindDispatches();
  numbers.bindStorage(0);
  first.bind();
  constexpr GLbitfield storage = GL_SHADER_STORAGE_BARRIER_BIT, texels = GL_TEXTURE_FETCH_BARRIER_BIT,
                       commands = GL_COMMAND_BARRIER_BIT, ofAPass = storage | texels | commands;
  const auto dispatch = [](GLbitfield barrier) {
    gl::dispatch(std::size_t{64}, 64);
    if (barrier != 0) glMemoryBarrier(barrier);
  };
  const auto measure = [&](const std::string& name, const std::function<void()>& work) {
    const WorkTime time = timeWork(small ? 20 : 2000, work);
    addValue(line, name, time.seconds * 1e6, "us/dispatch");
    addValue(line, name + ", submitting", time.submit * 1e6, "us/dispatch");
  };
  measure("no barrier", [&] { dispatch(0); });
  measure("barrier: storage", [&] { dispatch(storage); });
  measure("barrier: texels", [&] { dispatch(texels); });
  measure("barrier: storage, texels", [&] { dispatch(storage | texels); });
  measure("barrier: commands", [&] { dispatch(commands); });
  measure("barrier: storage, texels, commands", [&] { dispatch(ofAPass); });
  bool turn = false;
  measure("that, and another program", [&] {
    (turn ? first : second).bind();
    turn = !turn;
    dispatch(ofAPass);
  });
  measure("that, and another storage buffer", [&] {
    (turn ? numbers : others).bindStorage(0);
    turn = !turn;
    dispatch(ofAPass);
  });
  measure("indirect with no groups", [&] {
    gl::dispatchIndirect(0);
    glMemoryBarrier(ofAPass);
  });
}

void probeRoofs(bool small, const ProbeLine& line) {
  probeCopies(small, line);
  probeStencils(small, line);
  probeSprings(small, line);
}

void probeSteps(bool small, const ProbeLine& line) {
  for (const int size : small ? std::vector{32} : std::vector{128, 512, 1024})
    for (const Configuration& configuration : configurations()) {
      const std::string name = std::string(configuration.name) + " " + sizeText(size);
      measureOrSay(line, name, [&] {
        const StepRate rate = measureStepRate(sceneOf(configuration, size), "gpu", small ? 0.02 : 0.7);
        addValue(line, name, rate.secondsPerStep * 1e6, "us/step");
        addValue(line, name + ", submitting", rate.submitSecondsPerStep * 1e6, "us/step");
        addValue(line, name + ", dispatches", static_cast<double>(rate.dispatchesPerStep), "1/step");
        for (const PassTime& pass : rate.passes)
          addValue(line, name + ", pass " + pass.name, pass.seconds * 1e6, "us/step");
      });
    }
}

void probeGroups(bool small, const ProbeLine& line) {
  const int size = small ? 32 : 1024;
  for (const std::size_t configuration : {0, 1}) {
    const Scene scene = sceneOf(configurations()[configuration], size);
    const Cloth cloth(scene);
    for (const auto& [columns, rows] :
         {std::pair{64, 1}, std::pair{128, 1}, std::pair{32, 4}, std::pair{32, 8}, std::pair{16, 16}}) {
      GpuSolver solver(cloth, scene, {.groupColumns = columns, .groupRows = rows});
      const WorkTime time = timeWork(small ? 2 : 200, [&] { solver.step(1); });
      addValue(line,
               std::string(configurations()[configuration].name) + " " + sizeText(size) + ", groups of " +
                   std::to_string(columns) + "x" + std::to_string(rows),
               time.seconds * 1e6, "us/step");
    }
  }
}

void probeDemo(bool small, const ProbeLine& line) {
  for (const int size : small ? std::vector{32} : std::vector{512, 1024}) {
    const DemoRate rate = small ? measureDemo(size, "gpu", 160, 90) : measureDemo(size, "gpu", 3840, 2160);
    addValue(line, "demo " + sizeText(size) + ", a 30th of a second", rate.simulationSeconds * 1e3, "ms");
    addValue(line, "demo " + sizeText(size) + (small ? ", drawn at 160x90" : ", drawn at 3840x2160"),
             rate.drawSeconds * 1e3, "ms");
  }
}

}  // namespace clothsim

// The command line of DESIGN.md section 5: argv in, options out.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <type_traits>

#include "app/commands.h"
#include "app/viewer.h"
#include "core/error.h"
#include "core/interrupt.h"

namespace clothsim {
namespace {

// "30,-10", "30,-10,1.5".
ViewTurn parseView(const std::string& text) {
  ViewTurn turn;
  int afterTwo = 0, afterThree = 0;
  const int numbers =
      std::sscanf(text.c_str(), "%lf,%lf%n,%lf%n", &turn.right, &turn.up, &afterTwo, &turn.zoom, &afterThree);
  const bool isPlain = text.find_first_not_of("+-.,0123456789eE") == std::string::npos;
  const bool isWhole =
      isPlain && static_cast<std::size_t>(numbers == 3 ? afterThree : afterTwo) == text.size();
  if (numbers < 2 || !isWhole || !(std::abs(turn.right) <= 360) || !(std::abs(turn.up) <= 180) ||
      !(turn.zoom >= 0.01 && turn.zoom <= 100))
    throw UsageError(
        "--view " + text +
        ": expected RIGHT,UP or RIGHT,UP,ZOOM, in degrees and a factor from 0.01 to 100, as 30,-10,1.5");
  return turn;
}

// Of a picture, within bounds.
GridSize parsePixels(const std::string& text) {
  const GridSize size = parseSize(text, "--size");
  if (size.columns < 16 || size.rows < 16 || size.columns > 8192 || size.rows > 8192)
    throw UsageError("--size " + text + ": expected 16x16 to 8192x8192 pixels");
  return size;
}

// CLI11's own checks let NaN pass, and read 010 as 8.
template <class Number>
CLI::Validator numberWithin(Number low, Number high, const std::string& what) {
  const auto read = [low, high, what](std::string& text) -> std::string {
    Number number{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (code == std::errc() && end == text.data() + text.size() && low <= number && number <= high) {
      if constexpr (std::is_integral_v<Number>) text = std::to_string(number);
      return "";
    }
    std::ostringstream message;
    message << "expected " << what << " from " << low << " to " << high << ", found \"" << text << '"';
    return message.str();
  };
  return {read, ""};
}
CLI::Validator wholeNumber(std::int64_t low, std::int64_t high) {
  return numberWithin(low, high, "a whole number");
}
CLI::Validator number(double low, double high) { return numberWithin(low, high, "a number"); }

// The flags as they arrive; each command takes the ones it declared.
struct Arguments {
  bool draw = false;
  std::string scene = "pinned2", backend = "gpu", from, shader, size = "1280x720", key, replay;
  std::string cellSize = "560x420", out, view = "0,0";
  std::vector<std::string> variations, settings, saves, outs, resolutions, backends;
  int frames = 0, every = 1, around = 64, down = 48;
  double fps = 30, seconds = 1, jitter = 0;
  std::uint32_t seed = 1;
  bool json = false, checkCrossings = false, timings = false;

  [[nodiscard]] SceneOptions sceneOptions() const {
    SceneOptions options{.scene = scene, .resolution = std::nullopt, .settings = settings, .varied = {}};
    if (!resolutions.empty()) options.resolution = parseSize(resolutions.front(), "--resolution");
    return options;
  }
};

CLI::Option* addSceneFlags(CLI::App& app, Arguments& a, bool sceneRequired) {
  CLI::Option* file = app.add_option("-f,--scene", a.scene,
                                     "a bundled scene's name, or a path (with a '/' or ending in .json)");
  if (sceneRequired) file->required();
  app.add_option("--set", a.settings,
                 "set any key of the scene: --set cloth.damping=0.5 (see `clothsim describe`)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  return file;
}

void addResolution(CLI::App& app, Arguments& a) {
  app.add_option("--resolution", a.resolutions,
                 "rebuild the cloth's grid with this many points; pins keep their place")
      ->type_name("WxH")
      ->expected(1);
}

CLI::Option* addBackend(CLI::App& app, Arguments& a) {
  return app.add_option("--backend", a.backend, "gpu (compute shaders) or cpu: the same cloth to the bit")
      ->check(CLI::IsMember({"gpu", "cpu"}))
      ->capture_default_str();
}

CLI::Option* addFrames(CLI::App& app, Arguments& a, bool required = true) {
  return app
      .add_option("--frames", a.frames,
                  "how many frames to simulate (solver.frames_per_sec of them make a second)")
      ->required(required)
      ->transform(wholeNumber(0, 10'000'000));
}

void addSphereSegments(CLI::App& app, Arguments& a) {
  app.add_option("-a,--sphere-around", a.around, "horizontal segments of drawn spheres")
      ->transform(wholeNumber(3, 1024));
  app.add_option("-o,--sphere-down", a.down, "vertical segments of drawn spheres")
      ->transform(wholeNumber(2, 1024));
}

void addJson(CLI::App& app, Arguments& a) {
  app.add_flag("--json", a.json, "print one JSON object on stdout");
}

void addCheckCrossings(CLI::App& app, Arguments& a) {
  app.add_flag("--check-crossings", a.checkCrossings,
               "count pairs of triangles that cross, exactly, at the end of every frame (needs CGAL)");
}

using Task = std::function<int()>;

void declareRun(CLI::App& app, Arguments& a, Task& task) {
  CLI::App* run =
      app.add_subcommand("run", "Simulate without a window, save states, and sum the run up in numbers");
  CLI::Option* scene = addSceneFlags(*run, a, false);
  CLI::Option* frames = addFrames(*run, a, false);
  addResolution(*run, a);
  CLI::Option* backend = addBackend(*run, a);
  run->add_option("--save", a.saves,
                  "write the last state: .csv .ply .obj .png, or .state (exact); with %04d in the name every "
                  "K-th frame; all frames in one file: .pc2 (with the mesh it moves, FILE_rest.obj), .usda "
                  "(every K-th), .mp4 (in real time; needs ffmpeg); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  run->add_option("--every", a.every, "K for numbered files, .pc2 and .usda")
      ->transform(wholeNumber(1, 1'000'000));
  CLI::Option* from = run->add_option("--from", a.from, "begin with a saved .state")->type_name("STATE");
  CLI::Option* jitter =
      run->add_option("--jitter", a.jitter,
                      "begin with free particles moved at random, by 0 to so many metres along each axis (0)")
          ->transform(number(0.0, 1.0));
  run->add_option("--seed", a.seed, "of --jitter (1)")->transform(wholeNumber(0, UINT32_MAX));
  CLI::Option* replay =
      run->add_option("--replay", a.replay,
                      "do again what a recording of the viewer holds, on its backends or that of --backend")
          ->type_name("FILE");
  for (CLI::Option* other : {scene, from, jitter, run->get_option("--set"), run->get_option("--resolution")})
    replay->excludes(other);
  addCheckCrossings(*run, a);
  addJson(*run, a);
  run->footer("Example: clothsim run -f sphere --frames 300 --save drape.obj --json");
  run->callback([&a, &task, scene, frames, backend, replay] {
    if (replay->count() == 0 && scene->count() == 0) throw CLI::RequiredError("-f,--scene or --replay");
    if (replay->count() == 0 && frames->count() == 0) throw CLI::RequiredError("--frames");
    RunOptions options{a.sceneOptions(), {},       {},     a.saves, a.every, a.from, a.json,
                       a.checkCrossings, a.jitter, a.seed, a.replay};
    if (frames->count() > 0) options.frames = a.frames;
    if (backend->count() > 0) options.backend = a.backend;
    task = [options] { return runCommand(options); };
  });
}

void declareSimulationCommands(CLI::App& app, Arguments& a, Task& task) {
  declareRun(app, a, task);

  CLI::App* compare =
      app.add_subcommand("compare", "Run both backends side by side; exit code 0 when every bit agrees");
  addSceneFlags(*compare, a, true);
  addFrames(*compare, a);
  addResolution(*compare, a);
  addCheckCrossings(*compare, a);
  addJson(*compare, a);
  compare->footer("Example: clothsim compare -f pinned2 --frames 300");
  compare->callback([&] {
    task = [&] { return compareCommand({a.sceneOptions(), a.frames, a.json, a.checkCrossings}); };
  });

  CLI::App* bench = app.add_subcommand(
      "bench", "Measure steps and passes on both backends, and the largest demo in real time");
  addSceneFlags(*bench, a, false);
  bench
      ->add_option("--resolution", a.resolutions,
                   "grid sizes to measure; may be repeated (64x64 128x128 256x256)")
      ->type_name("WxH");
  bench->add_option("--backend", a.backends, "gpu, cpu; may be repeated (both)")
      ->check(CLI::IsMember({"gpu", "cpu"}));
  bench->add_option("--seconds", a.seconds, "of measuring for each figure")->transform(number(0.01, 600.0));
  bench->add_option("--after", a.frames, "measure the cloth as it lies after so many frames (0)")
      ->transform(wholeNumber(0, 10'000'000));
  bench->add_flag("--draw", a.draw, "measure drawing instead: every shading model at 1280x720, pass by pass");
  addJson(*bench, a);
  bench->footer(
      "Steps are timed in 7 stretches; the median counts. Example: clothsim bench --resolution 256x256");
  bench->callback([&] {
    task = [&] {
      BenchOptions options{
          {a.scene, std::nullopt, a.settings, {}}, {}, a.backends, a.seconds, a.frames, a.json, a.draw};
      for (const std::string& resolution : a.resolutions)
        options.resolutions.push_back(parseSize(resolution, "--resolution"));
      return benchCommand(options);
    };
  });
}

void addLooks(CLI::App& app, Arguments& a) {
  app.add_option("--shader", a.shader, "shading model instead of the scene's own");
  app.add_option(
         "--view", a.view,
         "turn the camera about what it looks at, to the right and up, in degrees, and go nearer by a "
         "factor: 30,-10,1.5")
      ->type_name("RIGHT,UP[,ZOOM]");
}

void declareRender(CLI::App& app, Arguments& a, Task& task) {
  CLI::App* render =
      app.add_subcommand("render", "Simulate and draw into pictures or a film, without a window");
  addSceneFlags(*render, a, true);
  addFrames(*render, a);
  addResolution(*render, a);
  addBackend(*render, a);
  render
      ->add_option("--out", a.outs,
                   "still.png (the last frame), frame_%04d.png, clip.mp4 (needs ffmpeg); may be repeated")
      ->required()
      ->type_name("FILE")
      ->allow_extra_args(false);
  render->add_option("--size", a.size, "pixels")->type_name("WxH")->capture_default_str();
  render->add_option("--every", a.every, "numbered pictures: every so many frames")
      ->transform(wholeNumber(1, 1'000'000));
  render->add_option("--fps", a.fps, "pictures a second of a film, at most; it plays in real time")
      ->transform(number(1.0, 1000.0));
  addLooks(*render, a);
  render->add_option("--from", a.from, "begin with a saved .state")->type_name("STATE");
  addSphereSegments(*render, a);
  render->footer("Example: clothsim render -f demo --frames 240 --out clip.mp4");
  render->callback([&] {
    task = [&] {
      const GridSize size = parsePixels(a.size);
      return renderCommand({a.sceneOptions(), a.frames, a.backend, a.outs, size.columns, size.rows, a.every,
                            a.fps, a.shader, a.around, a.down, a.from, parseView(a.view)});
    };
  });
}

void declareSweep(CLI::App& app, Arguments& a, Task& task) {
  CLI::App* sweep = app.add_subcommand(
      "sweep", "Simulate every combination of some values; one labelled picture and a table of measures");
  addSceneFlags(*sweep, a, true);
  CLI::Option* frames = addFrames(*sweep, a, false);
  sweep
      ->add_option("--vary", a.variations,
                   "any key of the scene, `frame` or `resolution`, and the values it takes: the first along "
                   "the columns, the others down the rows")
      ->required()
      ->type_name("KEY=V,V,...")
      ->allow_extra_args(false);
  addResolution(*sweep, a);
  addBackend(*sweep, a);
  sweep->add_option("--out", a.out, "sheet.png; the measures go to sheet.csv beside it")
      ->required()
      ->type_name("FILE");
  sweep->add_option("--size", a.cellSize, "pixels of each picture; the text grows with it")
      ->type_name("WxH")
      ->capture_default_str();
  addLooks(*sweep, a);
  addJson(*sweep, a);
  sweep->footer(
      "A combination that blows up is shown as it last was, and the others go on; `finite` is false for it.\n"
      "Examples: clothsim sweep -f pinned2 --vary cloth.ks=500,5000,50000 --vary "
      "solver.integrator=verlet,implicit\n              --frames 60 --out sheet.png\n"
      "          clothsim sweep -f selfCollision --vary frame=20,50,90 --vary cloth.ks=500,5000 --out "
      "time.png");
  sweep->callback([&a, &task, frames] {
    task = [&a, frames] {
      const GridSize size = parsePixels(a.cellSize);
      SweepOptions options{a.sceneOptions(), a.variations, {},       a.backend,         a.out,
                           size.columns,     size.rows,    a.shader, parseView(a.view), a.json};
      if (frames->count() > 0) options.frames = a.frames;
      return sweepCommand(options);
    };
  });
}

void declareInfoCommands(CLI::App& app, Arguments& a, Task& task) {
  // Without a footer of its own a command would print the viewer's.
  app.add_subcommand("scenes", "List the bundled scenes")
      ->footer("Example: clothsim -f twist shows the one of that name")
      ->callback([&] { task = [] { return scenesCommand(); }; });

  CLI::App* doctor =
      app.add_subcommand("doctor", "Show the OpenGL device and its limits, and test that CPU and GPU agree");
  addJson(*doctor, a);
  doctor->footer("Exit code 0 when the backends agree, 1 when they do not, 4 without usable OpenGL");
  doctor->callback([&] { task = [&] { return doctorCommand(a.json); }; });

  CLI::App* describe =
      app.add_subcommand("describe", "Explain every scene key: type, unit, range, default, meaning");
  describe->add_option("key", a.key, "one key or group, as cloth.ks, cloth or damping");
  describe->footer("Examples: clothsim describe, clothsim describe solver, clothsim describe strain_limit");
  describe->callback([&] { task = [&] { return describeCommand(a.key); }; });
}

void declareViewer(CLI::App& app, Arguments& a, Task& task) {
  addSceneFlags(app, a, false);
  addResolution(app, a);
  addBackend(app, a);
  addSphereSegments(app, a);
  app.add_flag("--timings", a.timings, "viewer: print at the end where the time of a displayed frame went");
  app.footer("Without a command: the viewer.\n\nKeys and mouse in the viewer:\n" + viewerKeysText() +
             "\nExit codes: 0 done, 1 the simulation failed or differs, 2 wrong usage, 3 scene error,\n"
             "            4 no usable OpenGL or no display, 5 input/output");
  task = [&] {
    runViewer(loadScene(a.sceneOptions()), {a.scene, a.backend, a.around, a.down, a.timings});
    return 0;
  };
}

}  // namespace

int runCommandLine(int argc, char** argv) {
  CLI::App app{"clothsim: cloth on the GPU and the CPU, the same to the bit", "clothsim"};
  app.set_version_flag("--version", "clothsim " CLOTHSIM_VERSION);
  app.set_help_all_flag("--help-all", "help of all commands");
  app.require_subcommand(0, 1);
  Arguments arguments;
  Task task;
  declareViewer(app, arguments, task);
  declareSimulationCommands(app, arguments, task);
  declareRender(app, arguments, task);
  declareSweep(app, arguments, task);
  declareInfoCommands(app, arguments, task);
  try {
    app.parse(argc, argv);
    if (!app.get_subcommands().empty()) catchInterrupts();  // the viewer closes by its window
    return task();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  } catch (const Error& error) {
    std::cerr << "clothsim: " << error.what() << '\n';
    return static_cast<int>(error.exitCode());
  } catch (const std::bad_alloc&) {
    std::cerr << "clothsim: not enough memory for this cloth; use a smaller --resolution\n";
    return static_cast<int>(ExitCode::failed);
  }
}

}  // namespace clothsim

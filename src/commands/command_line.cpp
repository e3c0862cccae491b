// Reads the command line with CLI11 and runs the subcommand.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "commands/commands.h"
#include "commands/proposal.h"
#include "commands/unknown_words.h"
#include "commands/version.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/standard_streams.h"
#include "core/thread_team.h"
#include "render/quality.h"
#include "viewer/viewer.h"

namespace clothsim {
namespace {

// Reads "30,-10" or "30,-10,1.5".
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

// The size of a picture, within bounds.
GridSize parsePixels(const std::string& text) {
  const GridSize size = parseSize(text, "--size");
  if (size.columns < 16 || size.rows < 16 || size.columns > 8192 || size.rows > 8192)
    throw UsageError("--size " + text + ": expected 16x16 to 8192x8192 pixels");
  return size;
}

// CLI11's own checks accept NaN, and read 010 as 8.
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

// The values of all flags. Each command uses those that it declares.
struct Arguments {
  bool draw = false;
  bool describeStep = false, markdown = false, small = false;
  std::string scene = "pinned2", backend = "auto", from, quality = "auto", viewerQuality = "auto", shader,
              size = "1280x720", key, replay, only;
  std::string cellSize = "560x420", out, view = "0,0", trace;
  std::vector<std::string> variations, settings, saves, outs, resolutions, backends;
  int frames = 0, every = 1, firstFrame = 0, exposures = 0, around = 64, down = 48, threads = 0;
  double fps = 30, seconds = 1, jitter = 0, restartAfter = 0;
  std::uint32_t seed = 1;
  bool json = false, checkCrossings = false, timings = false, strict = false;

  [[nodiscard]] SceneOptions sceneOptions() const {
    SceneOptions options{.scene = scene, .resolution = std::nullopt, .settings = settings, .varied = {}};
    if (!resolutions.empty()) options.resolution = parseResolution(resolutions.front());
    return options;
  }
};

// --resolution auto: as proposed here, with what else is "auto".
void followProposal(Arguments& a) {
  if (a.resolutions.empty() || a.resolutions.front() != "auto") return;
  const Proposal proposal = proposalHere();
  a.resolutions.front() = resolutionOf(proposal);
  if (a.backend == "auto") a.backend = proposal.backend;
  if (a.viewerQuality == "auto") a.viewerQuality = nameOf(proposal.quality);
}

struct SceneFlags {
  CLI::Option *file, *settings;
};

SceneFlags addSceneFlags(CLI::App& app, Arguments& a, bool sceneRequired) {
  CLI::Option* file =
      app.add_option("-f,--scene", a.scene,
                     "name of a bundled scene, a path (containing '/' or ending in .json), or a mesh (.obj)");
  if (sceneRequired) file->required();
  CLI::Option* settings =
      app.add_option("--set", a.settings,
                     "set any key of the scene, e.g. --set cloth.damping=0.5 (see `clothsim describe`)")
          ->type_name("KEY=VALUE")
          ->allow_extra_args(false);
  return {file, settings};
}

CLI::Option* addResolution(CLI::App& app, Arguments& a) {
  return app
      .add_option(
          "--resolution", a.resolutions,
          "change the number of grid points; pins keep their place on the cloth; the thickness of cloth "
          "with ks changes with the spacing; auto: as many as suit this machine in the demo (`clothsim "
          "doctor`)")
      ->type_name("WxH")
      ->expected(1);
}

CLI::Option* addBackend(CLI::App& app, std::string& backend) {
  return app
      .add_option("--backend", backend,
                  "auto: the GPU, or the CPU where OpenGL is a software renderer; the results are identical")
      ->check(CLI::IsMember({"auto", "gpu", "cpu"}))
      ->capture_default_str();
}

void addThreads(CLI::App& app, Arguments& a) {
  app.add_option("--threads", a.threads,
                 "threads of the CPU backend (CLOTHSIM_THREADS, otherwise one a core); the same bits")
      ->transform(wholeNumber(1, ThreadTeam::MOST_THREADS));
}

constexpr const char* qualityHelp =
    "of the picture: draft (fast), normal, final (the mean of 64 exposures: soft shadows, light in folds)";

CLI::Option* addFrames(CLI::App& app, Arguments& a, bool required = true) {
  return app
      .add_option("--frames", a.frames, "number of frames to simulate (solver.frames_per_sec per second)")
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

void addFirstFrame(CLI::App& app, Arguments& a) {
  app.add_option(
         "--first-frame", a.firstFrame,
         "number of the first frame in file names and USD, for a run that goes on with --from (default 0)")
      ->transform(wholeNumber(0, 1'000'000));
}

void addStrict(CLI::App& app, Arguments& a) {
  app.add_flag("--strict", a.strict,
               "end with exit code 1 when there was a warning: contact lost, springs stretched too far...");
}

void addCheckCrossings(CLI::App& app, Arguments& a) {
  app.add_flag("--check-crossings", a.checkCrossings,
               "count intersecting pairs of triangles exactly, after every frame (needs CGAL)");
}

constexpr const char* outOfMemory = "not enough memory for this cloth; use a smaller --resolution";

using Task = std::function<int()>;

void declareRun(CLI::App& app, Arguments& a, Task& task) {
  CLI::App* run = app.add_subcommand("run", "Simulate without a window, save states, and print measurements");
  const auto [scene, settings] = addSceneFlags(*run, a, false);
  CLI::Option* frames = addFrames(*run, a, false);
  CLI::Option* resolution = addResolution(*run, a);
  CLI::Option* backend = addBackend(*run, a.backend);
  addThreads(*run, a);
  run->add_option("--save", a.saves,
                  "save the last state as .csv .ply .obj .glb .npz .png, or .state (exact); with %04d in the "
                  "name every K-th frame; all frames in one file: .pc2 (with its mesh, FILE_rest.obj), .usda "
                  ".usdc .usd "
                  "(every K-th), .mp4 .webp (real time; needs ffmpeg); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  run->add_option("--every", a.every, "K for numbered files, .pc2 and USD")
      ->transform(wholeNumber(1, 1'000'000));
  addFirstFrame(*run, a);
  CLI::Option* from = run->add_option("--from", a.from, "start from a saved .state")->type_name("STATE");
  CLI::Option* jitter =
      run->add_option(
             "--jitter", a.jitter,
             "displace free particles at the start by up to this many metres along each axis (default 0)")
          ->transform(number(0.0, 1.0));
  run->add_option("--seed", a.seed, "seed of the random displacements of --jitter (default 1)")
      ->needs(jitter)
      ->transform(wholeNumber(0, UINT32_MAX));
  CLI::Option* replay =
      run->add_option("--replay", a.replay,
                      "repeat the actions of a viewer recording, on its own backends or on --backend")
          ->type_name("FILE");
  for (CLI::Option* other : {scene, from, jitter, settings, resolution}) replay->excludes(other);
  run->add_option("--trace", a.trace,
                  "write a row of measures for each frame: energies, momentum, strain, contacts, iterations")
      ->type_name("FILE.csv|npz");
  addCheckCrossings(*run, a);
  addStrict(*run, a);
  addJson(*run, a);
  run->footer("Example: clothsim run -f sphere --frames 300 --save drape.obj --json");
  run->callback([&a, &task, scene = scene, frames, backend, replay] {
    if (replay->count() == 0 && scene->count() == 0) throw CLI::RequiredError("-f,--scene or --replay");
    if (replay->count() == 0 && frames->count() == 0) throw CLI::RequiredError("--frames");
    const RunOptions options{.scene = a.sceneOptions(),
                             .frames = frames->count() > 0 ? std::optional(a.frames) : std::nullopt,
                             .backend = backend->count() > 0 ? std::optional(a.backend) : std::nullopt,
                             .saves = a.saves,
                             .every = a.every,
                             .firstFrame = a.firstFrame,
                             .from = a.from,
                             .json = a.json,
                             .checkCrossings = a.checkCrossings,
                             .jitter = a.jitter,
                             .seed = a.seed,
                             .replay = a.replay,
                             .strict = a.strict,
                             .trace = a.trace};
    task = [options] { return runCommand(options); };
  });
}

void declareSimulationCommands(CLI::App& app, Arguments& a, Task& task) {
  declareRun(app, a, task);

  CLI::App* compare =
      app.add_subcommand("compare", "Run both backends side by side; exit code 0 if they are bit-identical");
  addSceneFlags(*compare, a, true);
  addFrames(*compare, a);
  addResolution(*compare, a);
  addThreads(*compare, a);
  addCheckCrossings(*compare, a);
  addJson(*compare, a);
  compare->footer("Example: clothsim compare -f pinned2 --frames 300");
  compare->callback([&] {
    task = [&] {
      return compareCommand({.scene = a.sceneOptions(),
                             .frames = a.frames,
                             .json = a.json,
                             .checkCrossings = a.checkCrossings});
    };
  });

  CLI::App* bench = app.add_subcommand(
      "bench", "Measure steps and passes on both backends, and the largest demo that runs in real time");
  addSceneFlags(*bench, a, false);
  bench
      ->add_option("--resolution", a.resolutions,
                   "grid sizes to measure; may be repeated (64x64 128x128 256x256)")
      ->type_name("WxH");
  bench->add_option("--backend", a.backends, "gpu, cpu; may be repeated (both)")
      ->check(CLI::IsMember({"gpu", "cpu"}));
  addThreads(*bench, a);
  bench->add_option("--seconds", a.seconds, "duration of each measurement of steps")
      ->transform(number(0.01, 600.0));
  bench->add_option("--after", a.frames, "measure the cloth after this many frames (default 0)")
      ->transform(wholeNumber(0, 10'000'000));
  bench->add_flag("--draw", a.draw, "measure drawing instead: each pass of every shading model at 1280x720");
  addJson(*bench, a);
  bench->footer(
      "The median of 7 measurements is reported. On the CPU it is compared with roofs that are measured "
      "beside it:\n"
      "a loop that copies as many bytes as the solver has, and one that multiplies and adds in registers. "
      "What\n"
      "springs, integration and strain limit need at least counts, each spring once; contacts do not. Passes "
      "are\n"
      "timed one by one: they take longer than in a step, where they share a wave.\n"
      "Example: clothsim bench --resolution 256x256");
  bench->callback([&] {
    task = [&] {
      BenchOptions options{.scene = {a.scene, std::nullopt, a.settings, {}},
                           .resolutions = {},
                           .backends = a.backends,
                           .seconds = a.seconds,
                           .afterFrames = a.frames,
                           .json = a.json,
                           .draw = a.draw};
      for (const std::string& resolution : a.resolutions)
        options.resolutions.push_back(parseSize(resolution, "--resolution"));
      return benchCommand(options);
    };
  });
}

void addLooks(CLI::App& app, Arguments& a) {
  app.add_option("--shader", a.shader, "shading model instead of the scene's own");
  app.add_option("--view", a.view,
                 "orbit the camera to the right and up, in degrees, and zoom in by a factor, "
                 "e.g. 30,-10,1.5")
      ->type_name("RIGHT,UP[,ZOOM]");
}

void declareRender(CLI::App& app, Arguments& a, Task& task) {
  CLI::App* render =
      app.add_subcommand("render", "Simulate and render pictures or a video, without a window");
  addSceneFlags(*render, a, true);
  addFrames(*render, a);
  addResolution(*render, a);
  addBackend(*render, a.backend);
  addThreads(*render, a);
  render
      ->add_option("--out", a.outs,
                   "still.png (the last frame), frame_%04d.png, clip.mp4 or clip.webp (needs ffmpeg); may be "
                   "repeated")
      ->required()
      ->type_name("FILE")
      ->allow_extra_args(false);
  render->add_option("--size", a.size, "pixels")->type_name("WxH")->capture_default_str();
  render->add_option("--every", a.every, "numbered pictures: save every K-th frame")
      ->transform(wholeNumber(1, 1'000'000));
  addFirstFrame(*render, a);
  render->add_option("--fps", a.fps, "maximum frame rate of a video; it plays in real time")
      ->transform(number(1.0, 1000.0));
  addLooks(*render, a);
  render->add_option("--quality", a.quality, qualityHelp + std::string("; auto: final for stills"))
      ->check(CLI::IsMember({"auto", "draft", "normal", "final"}))
      ->capture_default_str();
  render
      ->add_option(
          "--exposures", a.exposures,
          "draw each picture so many times and take the mean, instead of as often as the quality does")
      ->transform(wholeNumber(1, MOST_EXPOSURES));
  render->add_option("--from", a.from, "start from a saved .state")->type_name("STATE");
  addSphereSegments(*render, a);
  addStrict(*render, a);
  render->footer("Example: clothsim render -f demo --frames 240 --out clip.mp4");
  render->callback([&] {
    task = [&] {
      const GridSize size = parsePixels(a.size);
      followProposal(a);
      return renderCommand({.scene = a.sceneOptions(),
                            .frames = a.frames,
                            .backend = a.backend,
                            .outs = a.outs,
                            .width = size.columns,
                            .height = size.rows,
                            .every = a.every,
                            .firstFrame = a.firstFrame,
                            .framesPerSecond = a.fps,
                            .shader = a.shader,
                            .sphereSegmentsAround = a.around,
                            .sphereSegmentsDown = a.down,
                            .from = a.from,
                            .view = parseView(a.view),
                            .strict = a.strict,
                            .quality = a.quality,
                            .exposures = a.exposures});
    };
  });
}

void declareSweep(CLI::App& app, Arguments& a, Task& task) {
  CLI::App* sweep = app.add_subcommand(
      "sweep",
      "Simulate every combination of given values: one labelled picture and a table of measurements");
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
  addBackend(*sweep, a.backend);
  addThreads(*sweep, a);
  sweep->add_option("--out", a.out, "sheet.png; the measurements are written to sheet.csv")
      ->required()
      ->type_name("FILE");
  sweep->add_option("--size", a.cellSize, "pixels of each picture; the text is scaled with it")
      ->type_name("WxH")
      ->capture_default_str();
  addLooks(*sweep, a);
  addJson(*sweep, a);
  addStrict(*sweep, a);
  sweep->footer(
      "A combination that blows up is shown in its last good state, with `finite` false; the others "
      "continue.\n"
      "Examples: clothsim sweep -f pinned2 --vary cloth.ks=500,5000,50000 --vary "
      "solver.integrator=verlet,implicit\n              --frames 60 --out sheet.png\n"
      "          clothsim sweep -f selfCollision --vary frame=20,50,90 --vary cloth.ks=500,5000 --out "
      "time.png");
  sweep->callback([&a, &task, frames] {
    task = [&a, frames] {
      const GridSize size = parsePixels(a.cellSize);
      return sweepCommand({.scene = a.sceneOptions(),
                           .variations = a.variations,
                           .frames = frames->count() > 0 ? std::optional(a.frames) : std::nullopt,
                           .backend = a.backend,
                           .out = a.out,
                           .width = size.columns,
                           .height = size.rows,
                           .shader = a.shader,
                           .view = parseView(a.view),
                           .json = a.json,
                           .strict = a.strict});
    };
  });
}

void declareInfoCommands(CLI::App& app, Arguments& a, Task& task) {
  // A command without a footer would print the viewer's.
  app.add_subcommand("scenes", "List the bundled scenes")
      ->footer("Example: clothsim -f twist opens the scene twist")
      ->callback([&] { task = [] { return scenesCommand(); }; });

  CLI::App* doctor =
      app.add_subcommand("doctor", "Show the OpenGL device and its limits, and check that CPU and GPU agree");
  addJson(*doctor, a);
  doctor->footer("Exit code 0 when the backends agree, 1 when they do not, 4 without usable OpenGL");
  doctor->callback([&] { task = [&] { return doctorCommand(a.json); }; });

  CLI::App* probe = app.add_subcommand(
      "probe",
      "Measure the OpenGL driver, a line of JSON for each finding (tools/measure_gpu runs all blocks)");
  probe->add_option("block", a.key, "limits, programs, contract, dispatches, roofs, steps, groups, demo")
      ->required()
      ->check(CLI::IsMember(
          {"limits", "programs", "contract", "dispatches", "roofs", "steps", "groups", "demo"}));
  probe->add_flag("--small", a.small, "with fewer points, frames and repetitions, for software renderers");
  probe->add_option("--only", a.only, "of contract and steps, only the cases whose names contain this text")
      ->type_name("TEXT");
  probe->footer(
      "Exit code 1 when contract finds a number that differs between CPU and GPU. docs/gpu.md explains the "
      "blocks");
  probe->callback([&] { task = [&] { return probeCommand(a.key, a.small, a.only); }; });

  CLI::App* describe = app.add_subcommand(
      "describe", "Explain every scene key: type, unit, range, default, meaning; or a step");
  CLI::Option* key =
      describe->add_option("key", a.key, "one key or group, as cloth.ks, cloth, sphere or damping");
  CLI::Option* step =
      describe
          ->add_flag("--step", a.describeStep,
                     "list the passes that a step of the scene is made of, in order: what each "
                     "runs over, reads, writes and depends on")
          ->excludes(key);
  describe->add_flag("--markdown", a.markdown, "print all keys as a page, as in docs/scene-format.md")
      ->excludes(key)
      ->excludes(step);
  const SceneFlags scene = addSceneFlags(*describe, a, false);
  for (CLI::Option* option : {scene.file, scene.settings, addResolution(*describe, a)}) option->needs(step);
  describe->footer(
      "Examples: clothsim describe, clothsim describe solver, clothsim describe strain_limit,\n"
      "          clothsim describe --step -f pinned2 --set solver.integrator=implicit");
  describe->callback([&] {
    task = [&] {
      if (a.markdown) return describeMarkdownCommand();
      return a.describeStep ? describeStepCommand(a.sceneOptions()) : describeCommand(a.key);
    };
  });
}

void declareViewer(CLI::App& app, Arguments& a, Task& task) {
  addSceneFlags(app, a, false);
  addResolution(app, a);
  addBackend(app, a.backend);
  addSphereSegments(app, a);
  app.add_option("--quality", a.viewerQuality, qualityHelp + std::string("; auto: draft on software OpenGL"))
      ->check(CLI::IsMember({"auto", "draft", "normal", "final"}))
      ->capture_default_str();
  app.add_option(
         "--restart", a.restartAfter,
         "viewer: start again after so many simulated seconds, until you touch the cloth or change something")
      ->transform(number(0.001, 1e9))
      ->type_name("SECONDS");
  app.add_flag("--timings", a.timings, "viewer: print on exit how long each part of a displayed frame took");
  app.footer(
      "Without a command: the viewer.\n\nKeys and mouse in the viewer:\n" + viewerKeysText() +
      "\nExit codes: 0 done, 1 the simulation failed or the backends differ, 2 wrong usage, 3 scene error,\n"
      "            4 no usable OpenGL or no display, 5 input/output, 130 interrupted");
  task = [&] {
    followProposal(a);
    runViewer(loadScene(a.sceneOptions()), {.sceneName = a.scene,
                                            .backend = a.backend,
                                            .sphereSegmentsAround = a.around,
                                            .sphereSegmentsDown = a.down,
                                            .timings = a.timings,
                                            .quality = a.viewerQuality,
                                            .restartAfter = a.restartAfter});
    return 0;
  };
}

int parseAndRun(int argc, char** argv) {
  CLI::App app{"clothsim: cloth simulation, bit-identical on GPU and CPU", "clothsim"};
  app.set_version_flag("--version", std::string("clothsim ") + versionText());
  app.set_help_all_flag("--help-all", "help of all commands");
  app.require_subcommand(0, 1);
  Arguments arguments;
  Task task;
  declareViewer(app, arguments, task);
  declareSimulationCommands(app, arguments, task);
  declareRender(app, arguments, task);
  declareSweep(app, arguments, task);
  declareInfoCommands(app, arguments, task);
  refuseEmptyValues(app);
  try {
    app.parse(argc, argv);
    catchInterrupts();
    if (arguments.threads > 0) ThreadTeam::setSharedThreads(arguments.threads);
    return task();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0)
      if (const std::string unknown = unknownWord(app, {argv + 1, argv + argc}); !unknown.empty())
        throw UsageError(unknown + "\nRun with --help or --help-all for more information.");
    const std::string text = error.what(), twice = ": At Most 1 required";
    if (const std::size_t end = text.find(twice); end != std::string::npos)
      throw UsageError(text.substr(0, end) + ": expected once, found more often");
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
}

int fail(ExitCode code, const char* message) {
  std::cerr << "clothsim: " << message << '\n';
  return static_cast<int>(code);
}

// Runs `work` and prints what it throws.
template <class Work>
int exitCodeOf(Work work) {
  try {
    return work();
  } catch (const Error& error) {
    return fail(error.exitCode(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::failed, outOfMemory);
  } catch (const std::length_error&) {  // a vector beyond the address space
    return fail(ExitCode::failed, outOfMemory);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(ExitCode::inputOutput, error.what());
  } catch (const std::exception& error) {
    return fail(ExitCode::failed, error.what());
  }
}

// Called where no handler can catch, as in a destructor or a parallel loop. Nothing is cleaned up then.
[[noreturn]] void endWithMessage() {
  const std::exception_ptr thrown = std::current_exception();
  if (!thrown) std::abort();
  std::_Exit(exitCodeOf([&]() -> int { std::rethrow_exception(thrown); }));
}

}  // namespace

int runCommandLine(int argc, char** argv) {
  holdStandardStreams();
  std::set_terminate(endWithMessage);
  const int code = exitCodeOf([&] { return parseAndRun(argc, argv); });
  const int written = exitCodeOf([] {
    finishStandardOutput();
    return 0;
  });
  return code != 0 ? code : written;
}

}  // namespace clothsim

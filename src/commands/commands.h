// The subcommands of `clothsim`, one function each; command_line.cpp turns argv into their options. Results
// go to stdout, progress and remarks to stderr. Each returns the exit code or throws an Error.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene_io/scene_options.h"
#include "simulation/simulation.h"

namespace clothsim {

// Reads "512x512". @throws UsageError that names the flag
[[nodiscard]] GridSize parseSize(const std::string& text, const std::string& flag);
// Of --resolution: "512x512", or "auto" for what is proposed here (proposal.h). @throws UsageError,
// OpenGlError
[[nodiscard]] GridSize parseResolution(const std::string& text);

// loadState() into a simulation; says on stderr what of it is not as in the scene.
void continueFrom(const std::string& file, Simulation& simulation);
// readScene(); prints its remarks on stderr.
[[nodiscard]] Scene loadScene(const SceneOptions& options);

struct RunOptions {
  SceneOptions scene;
  std::optional<int> frames;           // none: as many as the recording has
  std::optional<std::string> backend;  // none: auto, or those of the recording
  std::vector<std::string> saves;      // files by extension; numbered ones get every `every`-th frame
  int every = 1;
  int firstFrame = 0;  // number of the first frame in names and USD
  std::string from;    // a .state file to begin with
  bool json = false;
  bool checkCrossings = false;
  double jitter = 0;       // moves every free particle at the start by up to this along each axis [m]
  std::uint32_t seed = 1;  // of the jitter
  std::string replay;      // a recording to repeat instead of a scene
  bool strict = false;     // warnings end it with exit code 1
  std::string trace;       // a .csv file with a row of measures for each frame; "": none
};
int runCommand(const RunOptions& options);

// How the camera is rotated about its target, from where the scene puts it, and how much nearer it is.
struct ViewTurn {
  double right = 0, up = 0;  // [degrees]
  double zoom = 1;           // 2: from half the distance
};
inline constexpr double radians = std::numbers::pi / 180;  // in a degree

struct RenderCommandOptions {
  SceneOptions scene;
  int frames = 0;
  std::string backend = "auto";
  std::vector<std::string> outs;  // still.png, frame_%04d.png, clip.mp4
  int width = 1280, height = 720;
  int every = 1;                // numbered pictures: every so many frames
  int firstFrame = 0;           // number of the first of them
  double framesPerSecond = 30;  // of a film, at most
  std::string shader;           // "" for the scene's own
  int sphereSegmentsAround = 64, sphereSegmentsDown = 48;
  std::string from;  // a .state file to begin with
  ViewTurn view{};
  bool strict = false;           // warnings end it with exit code 1
  std::string quality = "auto";  // final, but of many pictures each one exposure
  int exposures = 0;             // of which a picture is the mean; 0: as the quality says
};
int renderCommand(const RenderCommandOptions& options);

struct SweepOptions {
  SceneOptions scene;
  std::vector<std::string> variations;  // --vary key=value,value...; also of `frame` and `resolution`
  std::optional<int> frames;            // none: the values of `frame`
  std::string backend = "auto";
  std::string out;                // sheet.png, with sheet.csv beside it
  int width = 560, height = 420;  // of one picture
  std::string shader;             // "" for the scene's own
  ViewTurn view;
  bool json = false;
  bool strict = false;  // warnings end it with exit code 1
};
int sweepCommand(const SweepOptions& options);

struct CompareOptions {
  SceneOptions scene;
  int frames = 0;
  bool json = false;
  bool checkCrossings = false;
};
int compareCommand(const CompareOptions& options);

struct BenchOptions {
  SceneOptions scene;
  std::vector<GridSize> resolutions;
  std::vector<std::string> backends;
  double seconds = 1;   // spent on each timing
  int afterFrames = 0;  // simulated before the timing
  bool json = false;
  bool draw = false;  // times drawing instead: every shading model, pass by pass
};
int benchCommand(const BenchOptions& options);

// `block`: one of those in probe.h. `small`: in seconds, with fewer points, frames and repetitions.
// `only`: of the contract, the cases whose names contain it.
int probeCommand(const std::string& block, bool small, const std::string& only);
int doctorCommand(bool json);
int scenesCommand();
int describeCommand(const std::string& key);  // "": all keys
int describeMarkdownCommand();
int describeStepCommand(const SceneOptions& options);

// Parses argv, runs the subcommand, prints errors to stderr; returns the exit code.
int runCommandLine(int argc, char** argv);

}  // namespace clothsim

// The subcommands behind `clothsim`, one function each; command_line.cpp turns argv into their options.
// Results go to stdout, progress and remarks to stderr. Each returns the exit code of DESIGN.md section 5 or
// throws an Error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

struct GridSize {
  int columns = 0, rows = 0;
};

// What every command that simulates takes.
struct SceneOptions {
  std::string scene = "pinned2";       // -f
  std::optional<GridSize> resolution;  // --resolution
  std::vector<std::string> settings;   // --set key=value
};
// Loads the scene, changes its resolution, applies --set, and says on stderr what the user should know of the
// result.
// @throws SceneError, UsageError
[[nodiscard]] Scene loadScene(const SceneOptions& options);

struct RunOptions {
  SceneOptions scene;
  std::optional<int> frames;           // not given: as many as the recording has
  std::optional<std::string> backend;  // not given: gpu, or those of the recording
  std::vector<std::string> saves;      // files by extension; numbered ones take every `every`-th frame
  int every = 1;
  std::string from;  // a .state file to begin with
  bool json = false;
  bool checkCrossings = false;
  double jitter = 0;       // start with every free particle moved by up to so much along each axis [m]
  std::uint32_t seed = 1;  // of the jitter
  std::string replay;      // a recording to do again, instead of a scene
};
int runCommand(const RunOptions& options);

struct RenderCommandOptions {
  SceneOptions scene;
  int frames = 0;
  std::string backend = "gpu";
  std::vector<std::string> outs;  // still.png, frame_%04d.png, clip.mp4
  int width = 1280, height = 720;
  int every = 1;                // numbered pictures: every so many frames
  double framesPerSecond = 30;  // of a film, at most
  std::string shader;           // "" for the scene's own
  int sphereSegmentsAround = 64, sphereSegmentsDown = 48;
  std::string from;  // a .state file to begin with
};
int renderCommand(const RenderCommandOptions& options);

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
  double seconds = 1;   // of measuring, for each figure
  int afterFrames = 0;  // measure the cloth as it lies then
  bool json = false;
  bool draw = false;  // measure drawing instead: every shading model, pass by pass
};
int benchCommand(const BenchOptions& options);

int doctorCommand(bool json);
int scenesCommand();
int describeCommand(const std::string& key);  // "" for all

// Parses argv, runs the subcommand, prints errors to stderr; returns the exit code.
int runCommandLine(int argc, char** argv);

}  // namespace clothsim

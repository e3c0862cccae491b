#include "app/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <utility>

#include "app/blow_up.h"
#include "app/pace.h"
#include "app/simulation.h"
#include "app/viewer_keys.h"
#include "app/viewer_overlay.h"
#include "app/viewer_window.h"
#include "gl/context.h"
#include "render/camera.h"
#include "render/renderer.h"

namespace clothsim {
namespace {

constexpr double noticeSeconds = 2.5;
constexpr double zoomPerStep = 0.88;  // of the wheel

class Clock {
 public:
  // Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// 9216 -> "9,216"
std::string withCommas(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

// "gpu", "llvmpipe (LLVM 15.0.6, 256 bits)" -> "GPU: llvmpipe"; "gpu", "NVIDIA H200/PCIe/SSE2" -> "GPU:
// NVIDIA H200"; "cpu", "CPU, 2 threads" -> "CPU: 2 threads"
std::string backendText(const Solver& solver) {
  std::string device = solver.device();
  if (device.starts_with("CPU, ")) device.erase(0, 5);
  device.erase(std::min(device.size(), device.find_first_of("(/")));
  return (solver.backend() == "gpu" ? "GPU: " : "CPU: ") + device;
}

const char* nameOf(Integrator integrator) { return integrator == Integrator::verlet ? "verlet" : "euler"; }

ViewerAction actionOf(int glfwKey) {
  switch (glfwKey) {
    case GLFW_KEY_P:
      return ViewerAction::pause;
    case GLFW_KEY_N:
      return ViewerAction::stepFrame;
    case GLFW_KEY_R:
      return ViewerAction::restart;
    case GLFW_KEY_B:
      return ViewerAction::toggleBackend;
    case GLFW_KEY_I:
      return ViewerAction::toggleIntegrator;
    case GLFW_KEY_SPACE:
      return ViewerAction::resetCamera;
    case GLFW_KEY_F1:
      return ViewerAction::toggleKeyList;
    case GLFW_KEY_F2:
      return ViewerAction::toggleOverlay;
    case GLFW_KEY_ESCAPE:
      return ViewerAction::quit;
    default:
      return ViewerAction::none;
  }
}

// "50 x 50", or several of them.
std::string gridSizes(const Cloth& cloth) {
  std::string text;
  for (const Grid& grid : cloth.grids())
    text +=
        (text.empty() ? "" : ", ") + std::to_string(grid.columns) + " \u00d7 " + std::to_string(grid.rows);
  return text;
}

// Antialiasing as fine as the device draws at a fluent rate: llvmpipe pays for every sample.
RenderOptions renderOptions(const ViewerOptions& options) {
  RenderOptions render;
  render.sphereSegmentsAround = options.sphereSegmentsAround;
  render.sphereSegmentsDown = options.sphereSegmentsDown;
  if (gl::currentContextInfo().software) render.samples = 2;
  return render;
}

// "pinned2", also for "my/scenes/pinned2.json"
std::string displayName(const std::string& sceneName) {
  return std::filesystem::path(sceneName).stem().string();
}

class Viewer {
 public:
  Viewer(const Scene& scene, const ViewerOptions& options)
      : options_(options),
        window_("clothsim", options.sceneName),
        simulation_(scene, options.backend),
        camera_(scene, simulation_.cloth()),
        renderer_(simulation_.cloth(), scene, renderOptions(options)),
        pace_(1 / scene.solver.framesPerSec) {
    window_.setInput({.key = [this](int key) { act(actionOf(key)); },
                      .drag = [this](double dx, double dy, bool pan) { onDrag(dx, dy, pan); },
                      .scroll = [this](double steps, double x, double y) { onScroll(steps, x, y); }},
                     [] { return false; });
  }

  void run() {
    clock_.lap();  // what loading took is not simulated time
    while (!window_.shouldClose()) {
      if (paused_)
        window_.waitEvents(0.25);
      else
        window_.pollEvents();
      const double elapsed = clock_.lap();
      const int frames = simulate(elapsed);
      meter_.add(elapsed, frames * frameSeconds());
      draw();
      notice_.secondsLeft -= elapsed;
      // Without a display that sets the pace, nothing is gained by drawing the same picture again at once.
      if (!paused_ && frames == 0) window_.waitEvents(pace_.secondsUntilDue());
    }
  }

 private:
  struct Notice {
    std::string text;
    double secondsLeft = 0;
    bool isError = false;
  };

  double frameSeconds() const { return 1 / simulation_.scene().solver.framesPerSec; }
  int simulate(double elapsed);
  void draw();
  void act(ViewerAction action);
  void switchBackend();
  void switchIntegrator();
  void onDrag(double dx, double dy, bool pan);
  void onScroll(double steps, double x, double y);
  OverlayFacts facts() const;
  std::string title() const;
  void say(const std::string& text) { notice_ = {text, noticeSeconds, false}; }

  ViewerOptions options_;
  ViewerWindow window_;
  ViewerOverlay overlay_{window_.handle()};
  Simulation simulation_;
  Camera camera_;
  Renderer renderer_;
  Pace pace_;
  SpeedMeter meter_;
  Clock clock_;
  Notice notice_;
  std::string title_;
  const bool software_ = gl::currentContextInfo().software;  // OpenGL is the CPU in disguise, and slower
  bool paused_ = false, stepAsked_ = false, showOverlay_ = true, showKeys_ = false;
};

// Returns the number of frames that were simulated.
int Viewer::simulate(double elapsed) {
  const int frames = paused_ ? std::exchange(stepAsked_, false) : pace_.framesDue(elapsed);
  if (frames == 0) return 0;
  Clock clock;
  simulation_.stepFrames(frames);
  simulation_.finish();
  if (const std::optional<Trouble> trouble = simulation_.checkFrame()) {
    paused_ = true;
    notice_ = {blowUpText(*trouble, simulation_.cloth(), simulation_.scene()) +
                   "\nPaused at the last good state. R restarts.",
               1e9, true};
  }
  pace_.simulated(frames, clock.lap());
  return frames;
}

void Viewer::draw() {
  const ViewerWindow::Size size = window_.size();
  if (size.width == 0 || size.height == 0) return;  // minimised
  renderer_.draw(simulation_.positionsBuffer(), camera_, simulation_.time(), 0, size.width, size.height);
  overlay_.draw(facts(), window_.textScale(), showOverlay_, showKeys_);
  window_.swap();
  if (const std::string now = title(); now != title_) window_.setTitle(title_ = now);
}

void Viewer::act(ViewerAction action) {
  switch (action) {
    case ViewerAction::none:
      break;
    case ViewerAction::pause:
      paused_ = !paused_;
      if (notice_.isError) notice_ = {};
      break;
    case ViewerAction::stepFrame:
      stepAsked_ = paused_;
      break;
    case ViewerAction::restart:
      simulation_.restart();
      if (notice_.isError) paused_ = false;  // trouble had paused it
      notice_ = {};
      break;
    case ViewerAction::toggleBackend:
      switchBackend();
      break;
    case ViewerAction::toggleIntegrator:
      switchIntegrator();
      break;
    case ViewerAction::resetCamera:
      camera_.reset();
      break;
    case ViewerAction::toggleKeyList:
      showKeys_ = !showKeys_;
      break;
    case ViewerAction::toggleOverlay:
      showOverlay_ = !showOverlay_;
      break;
    case ViewerAction::quit:
      window_.requestClose();
      break;
  }
}

void Viewer::switchBackend() {
  simulation_.switchBackend(simulation_.solver().backend() == "gpu" ? "cpu" : "gpu");
  say(std::string("Continues on the ") + (simulation_.solver().backend() == "gpu" ? "GPU" : "CPU") +
      ", from the same state to the bit");
}

void Viewer::switchIntegrator() {
  Scene scene = simulation_.scene();
  Integrator& integrator = scene.solver.integrator;
  integrator = integrator == Integrator::verlet ? Integrator::euler : Integrator::verlet;
  simulation_.configure(scene);
  say(std::string("Continues with ") + nameOf(integrator));
}

void Viewer::onDrag(double dx, double dy, bool pan) {
  if (pan)
    camera_.pan(-dx, -dy);  // the cloth follows the hand
  else
    camera_.orbit(-dx * std::numbers::pi, -dy * std::numbers::pi);
}

void Viewer::onScroll(double steps, double x, double y) {
  const double factor = std::pow(zoomPerStep, steps);
  camera_.pan(x * (1 - factor), y * (1 - factor));  // what is under the cursor stays there
  camera_.zoom(factor);
}

std::string Viewer::title() const {
  const double rate = meter_.framesPerSecond();
  return displayName(options_.sceneName) + " - " + simulation_.solver().backend() +
         (paused_    ? " - paused"
          : rate > 0 ? formatted(" - %.0f fps", rate)
                     : "") +
         " - clothsim";
}

OverlayFacts Viewer::facts() const {
  const Solver& solver = simulation_.solver();
  const Cloth& cloth = simulation_.cloth();
  const double factor = meter_.realTimeFactor(), rate = meter_.framesPerSecond();
  const bool slow = rate > 0 && factor < 0.95;

  OverlayFacts facts;
  facts.title = displayName(options_.sceneName);
  facts.rows = {{"backend", backendText(solver)},
                {"cloth", gridSizes(cloth) + " = " + withCommas(cloth.particleCount()) + " particles"},
                {"integrator", nameOf(simulation_.scene().solver.integrator)},
                {"time", formatted("%.2f s", simulation_.time())}};
  if (paused_)
    facts.rows.push_back({"speed", "paused (N: one frame)", true});
  else if (rate == 0)
    facts.rows.push_back({"speed", "measuring"});
  else
    facts.rows.push_back({"speed",
                          formatted(slow ? "%.2f" : "%.1f", factor) + "\u00d7 real time" +
                              (slow && software_ && solver.backend() == "gpu" ? ", B: try the CPU" : ""),
                          slow});
  if (rate > 0 && !paused_) facts.rows.push_back({"display", formatted("%.0f frames/s", rate)});
  facts.rows.push_back({"help", "F1 lists the keys"});
  if (notice_.secondsLeft > 0) {
    facts.notice = notice_.text;
    facts.noticeIsError = notice_.isError;
  }
  return facts;
}

}  // namespace

void runViewer(const Scene& scene, const ViewerOptions& options) { Viewer(scene, options).run(); }

std::string viewerKeysText() {
  std::string text;
  for (const ViewerKey& key : viewerKeys) {
    text += "  " + std::string(key.input);
    text.append(12 - key.input.size(), ' ');
    text += std::string(key.effect) + "\n";
  }
  return text;
}

}  // namespace clothsim

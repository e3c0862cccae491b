// The loop of the window: input, simulation, picture, panels. What the mouse does is in hands.h, what is open
// in open_scene.h, what the panels hold in panels/.
#include "app/viewer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "app/blow_up.h"
#include "app/compare_card.h"
#include "app/frame_timings.h"
#include "app/hands.h"
#include "app/numbered_files.h"
#include "app/open_scene.h"
#include "app/pace.h"
#include "app/panels/panels.h"
#include "app/picture_taker.h"
#include "app/timeline_bar.h"
#include "app/ui_frame.h"
#include "app/viewer_config.h"
#include "app/viewer_facts.h"
#include "app/viewer_keys.h"
#include "app/viewer_marks.h"
#include "app/viewer_overlay.h"
#include "app/viewer_window.h"
#include "core/error.h"
#include "gl/context.h"
#include "render/shading_models.h"

namespace clothsim {
namespace {

constexpr double noticeSeconds = 2.5, longNoticeSeconds = 8;
constexpr float panelsFrom = 54;        // em of window width, for the panels to be open at the first start
constexpr int drawsAfterInput = 3;      // of a paused window, until controls have settled
constexpr double pinsShownSeconds = 2;  // after one was set

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

// Antialiasing as fine as the device draws at a fluent rate: llvmpipe pays for every sample.
RenderOptions renderOptions(const ViewerOptions& options) {
  RenderOptions render;
  render.sphereSegmentsAround = options.sphereSegmentsAround;
  render.sphereSegmentsDown = options.sphereSegmentsDown;
  if (gl::currentContextInfo().software) render.samples = 2;
  return render;
}

class Viewer {
 public:
  Viewer(const Scene& scene, const ViewerOptions& options)
      : options_(options),
        window_("clothsim", options.sceneName),
        open_(std::make_unique<OpenScene>(scene, options.sceneName, options.backend, renderOptions(options))),
        pace_(open_->frameSeconds()) {
    LoadedConfig loaded = loadViewerConfig(viewerConfigPath());
    config_ = savedConfig_ = loaded.config;
    if (!loaded.notice.empty()) say(loaded.notice, longNoticeSeconds);
    widgets_.offer("render.shader", shadingModelNames());
    listen();
  }

  void run();

 private:
  struct Notice {
    std::string text;
    double secondsLeft = 0;
    bool isError = false;
  };

  // By the controls of one picture; heeded after it, since much of that draws elsewhere.
  struct Asked {
    FieldEdits edits;
    PanelRequests panels;
    TimelineRequests timeline;
  };

  // --- input (all of it comes from the window)
  void listen();
  void onPress(ViewerWindow::Button button, ViewerWindow::Cursor cursor, bool control, bool shift);
  void act(ViewerAction action);
  void actOnFile(ViewerAction action);

  // --- what can be asked for, by key or panel
  void switchBackend(const std::string& backend);
  void switchIntegrator();
  void nextShader();
  void edit(const Scene& scene, bool continues);
  void undo(bool again);
  void seek(int frame);
  void restart();
  void openScene(const std::string& source);
  void saveSceneAs(const std::filesystem::path& path);
  void reloadShaders();
  void togglePanels();

  // --- a turn of the loop
  int simulate(double elapsed);
  void draw();
  void measure();
  void drawControls();
  void drawPanels();
  void heedControls();
  void heed(const FieldEdits& edits);
  void heed(const PanelRequests& requests);
  void heed(const TimelineRequests& requests);
  void keepConfig();

  [[nodiscard]] Session& session() { return open_->session(); }
  [[nodiscard]] bool looksBack() const { return open_->session().frame() < open_->session().newestFrame(); }
  [[nodiscard]] bool showsPanels() const;
  [[nodiscard]] PictureArea pictureArea() const;
  [[nodiscard]] bool isOverPicture(ViewerWindow::Cursor cursor) const;
  [[nodiscard]] Reach reach();
  [[nodiscard]] bool isIdle() const;

  void say(const std::string& text, double seconds = noticeSeconds) { notice_ = {text, seconds, false}; }
  void complain(const std::string& text) { notice_ = {text, longNoticeSeconds, true}; }
  // Something a person asked for, which may be impossible: then it says so and the window goes on.
  template <class Deed>
  void attempt(Deed&& deed) {
    try {
      deed();
    } catch (const Error& error) {
      complain(error.what());
    }
  }

  ViewerOptions options_;
  ViewerWindow window_;
  UiFrame ui_{window_.handle()};
  std::unique_ptr<OpenScene> open_;
  Hands hands_;
  PanelColumn column_;
  FieldWidgets widgets_;
  CompareCard compare_;
  PictureTaker taker_;
  Pace pace_;
  SpeedMeter meter_;
  Clock clock_;
  FrameTimings timings_{options_.timings};
  Notice notice_;
  ViewerConfig config_, savedConfig_;
  Asked asked_;
  Scene draft_;                 // what the panels edit
  bool draftHeld_ = false;      // some control of theirs is held: the draft is ahead of the scene
  bool editContinues_ = false;  // the next edit belongs to the one before
  std::string confirmed_;       // a file that the next Save may write over
  std::string title_;
  double now_ = 0, pinsShownUntil_ = 0;  // [s] since the start
  int drawsLeft_ = drawsAfterInput;
  bool paused_ = false, stepAsked_ = false, showKeys_ = false;
};

void Viewer::run() {
  clock_.lap();  // what loading took is not simulated time
  while (!window_.shouldClose()) {
    timings_.time(FrameTimings::input, [&] { isIdle() ? window_.waitEvents(0.25) : window_.pollEvents(); });
    const double elapsed = clock_.lap();
    now_ += elapsed;
    int frames = 0;
    timings_.time(FrameTimings::simulate, [&] { frames = simulate(elapsed); });
    meter_.add(elapsed, frames * open_->frameSeconds());
    attempt([&] { taker_.shown(*open_, paused_ ? elapsed : frames * open_->frameSeconds()); });
    draw();
    keepConfig();
    notice_.secondsLeft -= elapsed;
    // Without a display that sets the pace, nothing is gained by drawing the same picture again at once.
    if (!paused_ && frames == 0 && !compare_.isRunning()) window_.waitEvents(pace_.secondsUntilDue());
  }
  taker_.abandonClip();
  std::fputs(timings_.report().c_str(), stderr);
}

// --- input

void Viewer::listen() {
  window_.setInput({.key =
                        [this](const KeyStroke& stroke, bool repeated) {
                          drawsLeft_ = drawsAfterInput;
                          if (ui_.wantsKeys()) return;
                          const ViewerAction action = actionOf(stroke);
                          // Held down, a key repeats what makes sense many times over.
                          const bool repeats = action == ViewerAction::stepBack ||
                                               action == ViewerAction::stepForward ||
                                               action == ViewerAction::stepFrame ||
                                               action == ViewerAction::undo || action == ViewerAction::redo;
                          if (!repeated || repeats) attempt([&] { act(action); });
                        },
                    .press = [this](ViewerWindow::Button button, ViewerWindow::Cursor cursor, bool control,
                                    bool shift) { onPress(button, cursor, control, shift); },
                    .move =
                        [this](ViewerWindow::Cursor cursor) {
                          drawsLeft_ = drawsAfterInput;
                          attempt([&] { hands_.move(reach(), cursor); });
                        },
                    .release =
                        [this](ViewerWindow::Button button) {
                          drawsLeft_ = drawsAfterInput;
                          attempt([&] { hands_.release(reach(), button); });
                        },
                    .scroll =
                        [this](double steps, ViewerWindow::Cursor cursor) {
                          drawsLeft_ = drawsAfterInput;
                          if (isOverPicture(cursor)) hands_.scroll(reach(), steps, cursor);
                        },
                    .drop =
                        [this](const std::vector<std::string>& paths) {
                          drawsLeft_ = drawsAfterInput;
                          if (!paths.empty()) attempt([&] { openScene(paths.front()); });
                        }});
}

void Viewer::onPress(ViewerWindow::Button button, ViewerWindow::Cursor cursor, bool control, bool shift) {
  drawsLeft_ = drawsAfterInput;
  if (!isOverPicture(cursor)) return;
  attempt([&] {
    const std::string said = hands_.press(reach(), button, cursor, {control, shift, window_.holds(cutKey)});
    if (said.empty()) return;
    pinsShownUntil_ = now_ + pinsShownSeconds;
    say(said);
  });
}

void Viewer::act(ViewerAction action) {
  switch (action) {
    case ViewerAction::none:
      return;
    case ViewerAction::pause:
      paused_ = !paused_;
      if (notice_.isError) notice_ = {};
      return;
    case ViewerAction::stepFrame:
      stepAsked_ = paused_;
      return;
    case ViewerAction::restart:
      return restart();
    case ViewerAction::stepBack:
      return seek(session().frame() - 1);
    case ViewerAction::stepForward:
      return seek(session().frame() + 1);
    case ViewerAction::toggleBackend:
      return switchBackend(open_->backend() == "gpu" ? "cpu" : "gpu");
    case ViewerAction::compareBackends:
      return compare_.start(session());
    case ViewerAction::toggleIntegrator:
      return switchIntegrator();
    case ViewerAction::nextShader:
      return nextShader();
    case ViewerAction::resetCamera:
      return open_->camera().reset();
    case ViewerAction::undo:
      return undo(false);
    case ViewerAction::redo:
      return undo(true);
    case ViewerAction::toggleKeyList:
      showKeys_ = !showKeys_;
      return;
    case ViewerAction::toggleOverlay:
      config_.showOverlay = !config_.showOverlay;
      return;
    case ViewerAction::togglePanels:
      return togglePanels();
    case ViewerAction::reloadShaders:
      return reloadShaders();
    case ViewerAction::quit:
      return window_.requestClose();
    default:
      return actOnFile(action);
  }
}

void Viewer::actOnFile(ViewerAction action) {
  const PictureArea area = pictureArea();
  const int width = static_cast<int>(area.width), height = static_cast<int>(area.height);
  if (action == ViewerAction::screenshot) say(taker_.screenshot(*open_, width, height), longNoticeSeconds);
  if (action == ViewerAction::recordClip) say(taker_.toggleClip(*open_, width, height), longNoticeSeconds);
  if (action == ViewerAction::saveScene) saveSceneAs(freeName(outputFolder(), open_->name(), ".json"));
  if (action == ViewerAction::saveRecording) {
    const auto path = freeName(outputFolder(), open_->name() + "-recording", ".json");
    session().recording().save(path);
    say("Saved " + path.string() + "; clothsim run --replay " + path.string() + " repeats it",
        longNoticeSeconds);
  }
}

// --- what can be asked for

void Viewer::switchBackend(const std::string& backend) {
  session().act(SwitchBackend{backend});
  say(std::string("Continues on the ") + (backend == "gpu" ? "GPU" : "CPU") +
      ", from the same state to the bit");
}

void Viewer::switchIntegrator() {
  Scene scene = open_->scene();
  Integrator& integrator = scene.solver.integrator;
  integrator = integrator == Integrator::verlet ? Integrator::euler : Integrator::verlet;
  edit(scene, false);
  say(std::string("Continues with ") + nameOf(integrator));
}

void Viewer::nextShader() {
  const std::vector<std::string> names = shadingModelNames();
  Scene scene = open_->scene();
  const auto at = std::find(names.begin(), names.end(), scene.render.shader);
  scene.render.shader = at == names.end() || at + 1 == names.end() ? names.front() : *(at + 1);
  edit(scene, false);
  say("Shading model: " + scene.render.shader);
}

void Viewer::edit(const Scene& scene, bool continues) {
  const double before = open_->frameSeconds();
  open_->edit(scene, continues);
  if (open_->frameSeconds() != before) pace_ = Pace(open_->frameSeconds());
}

void Viewer::undo(bool again) {
  if (again ? !session().canRedo() : !session().canUndo())
    return say(again ? "Nothing to redo" : "Nothing to undo");
  again ? session().redo() : session().undo();
  pace_ = Pace(open_->frameSeconds());
  say(again ? "Redone" : "Undone");
}

void Viewer::seek(int frame) {
  if (frame < session().oldestFrame() || frame > session().newestFrame())
    return say(frame > session().newestFrame() ? "This is the newest frame; N simulates the next one"
                                               : "No earlier frame is kept");
  if (frame == session().frame()) return;
  hands_.letGo(session());
  session().seek(frame);
  paused_ = true;
  pace_ = Pace(open_->frameSeconds());
}

void Viewer::restart() {
  hands_.letGo(session());
  session().act(Restart{});
  column_.measures().forget();
  if (notice_.isError) paused_ = false;  // trouble had paused it
  notice_ = {};
}

void Viewer::openScene(const std::string& source) {
  auto next =
      std::make_unique<OpenScene>(loadSceneByName(source), source, open_->backend(), renderOptions(options_));
  next->view = open_->view;
  taker_.abandonClip();
  compare_.close();
  hands_ = {};
  open_ = std::move(next);
  column_.measures().forget();
  pace_ = Pace(open_->frameSeconds());
  draftHeld_ = paused_ = false;
  notice_ = {};
}

// Files that were there before are written over only when that is asked for twice.
void Viewer::saveSceneAs(const std::filesystem::path& path) {
  if (std::filesystem::exists(path) && confirmed_ != path.string()) {
    confirmed_ = path.string();
    return complain(path.string() + " is there already; Save again writes over it");
  }
  saveScene(open_->scene(), path);
  confirmed_ = path.string();
  column_.scenes().remember(path.string());
  say("Saved " + path.string(), longNoticeSeconds);
}

void Viewer::reloadShaders() {
  if (const std::optional<std::string> trouble = open_->renderer().reloadShaders())
    notice_ = {*trouble + "\nThe shaders from before are still in use.", 1e9, true};
  else
    say("Shaders loaded again");
}

void Viewer::togglePanels() { config_.showPanels = !showsPanels(); }

// --- a turn of the loop

bool Viewer::showsPanels() const {
  const double wanted = static_cast<double>(panelsFrom) * 16 * window_.textScale();
  return config_.showPanels.value_or(window_.size().width >= wanted);
}

PictureArea Viewer::pictureArea() const {
  const ViewerWindow::Size size = window_.size();
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  if (!showsPanels()) return {width, height};
  return {width - PanelColumn::width(width, static_cast<float>(16 * window_.textScale())), height};
}

// Known without Dear ImGui, which learns where the mouse is only with the next frame.
bool Viewer::isOverPicture(ViewerWindow::Cursor cursor) const {
  const PictureArea area = pictureArea();
  const bool inside = cursor.x >= 0 && cursor.x < static_cast<double>(area.width) && cursor.y >= 0 &&
                      cursor.y < static_cast<double>(area.height - timelineHeight());
  return inside && !((ui_.hasPopup() || compare_.isOpen()) && ui_.wantsMouse());
}

Reach Viewer::reach() {
  const PictureArea area = pictureArea();
  return {session(),
          open_->renderer(),
          open_->camera(),
          std::max(1, static_cast<int>(area.width)),
          std::max(1, static_cast<int>(area.height)),
          paused_};
}

bool Viewer::isIdle() const {
  return paused_ && !stepAsked_ && drawsLeft_ <= 0 && !compare_.isRunning() && !taker_.recordedSeconds();
}

// Returns the number of frames that were simulated.
int Viewer::simulate(double elapsed) {
  if (drawsLeft_ > 0) --drawsLeft_;
  attempt([&] {
    compare_.advance();
    const bool blows = !paused_ && !ui_.wantsKeys() && window_.holds(blowKey);
    hands_.beforeStep(reach(), window_.cursor(), blows);
  });
  if (compare_.isRunning()) return 0;
  const int frames = paused_ ? std::exchange(stepAsked_, false) : pace_.framesDue(elapsed);
  if (frames == 0) return 0;
  Clock clock;
  const std::optional<Trouble> trouble = session().stepFrames(frames);
  session().simulation().finish();
  const double seconds = clock.lap();
  if (trouble) {
    paused_ = true;
    notice_ = {blowUpText(*trouble, session().simulation().cloth(), open_->scene()) +
                   "\nPaused at the last good state. R restarts.",
               1e9, true};
  }
  pace_.simulated(frames, seconds);
  column_.measures().stepped(static_cast<double>(session().simulation().cloth().particleCount()) * frames *
                                 open_->scene().solver.simulationSteps,
                             seconds);
  return frames;
}

void Viewer::draw() {
  const ViewerWindow::Size size = window_.size();
  if (size.width == 0 || size.height == 0) return;  // minimised
  const PictureArea area = pictureArea();
  const ViewOptions wanted = open_->view;
  open_->view.showPins = wanted.showPins || now_ < pinsShownUntil_ || window_.holdsShift();
  attempt([&] { open_->update(); });
  open_->view = wanted;
  open_->frameFor(static_cast<int>(area.width), static_cast<int>(area.height));
  timings_.time(FrameTimings::picture,
                [&] { open_->draw(static_cast<int>(area.width), static_cast<int>(area.height)); });
  timings_.time(FrameTimings::controls, [&] {
    ui_.begin(window_.textScale());
    drawControls();
    ui_.end();
  });
  timings_.time(FrameTimings::drawControls, [&] { ui_.draw(); });
  timings_.time(FrameTimings::swap, [&] { window_.swap(); });
  timings_.time(FrameTimings::after, [&] {
    heedControls();
    measure();
  });
  if (const std::string now = viewerTitle(*open_, meter_, paused_); now != title_)
    window_.setTitle(title_ = now);
}

// Between two pictures, since picking draws elsewhere.
void Viewer::measure() {
  column_.measures().update(session(), now_, [&]() -> std::optional<std::uint32_t> {
    const ViewerWindow::Cursor cursor = window_.cursor();
    if (!isOverPicture(cursor)) return std::nullopt;
    const Reach r = reach();
    const Pick pick = r.renderer.pick(r.session.simulation().positionsBuffer(), r.camera,
                                      r.session.simulation().time(), r.width, r.height, cursor.x, cursor.y);
    return pick.kind == Pick::Kind::cloth ? std::optional(pick.particle) : std::nullopt;
  });
}

void Viewer::drawControls() {
  const PictureArea area = pictureArea();
  drawMarks(hands_.marks(reach(), window_.cursor()));
  const bool roomForBoth = area.width > 66 * em();
  if (config_.showOverlay && (roomForBoth || !showKeys_))
    drawFacts(viewerFacts(*open_, meter_, paused_, looksBack()), area);
  if (showsPanels()) drawPanels();
  asked_.timeline = drawTimeline({session().oldestFrame(), session().frame(), session().newestFrame(),
                                  open_->frameSeconds(), paused_, taker_.recordedSeconds()},
                                 area);
  compare_.draw(area);
  if (notice_.secondsLeft > 0) drawNotice(notice_.text, notice_.isError, area, timelineHeight());
  if (showKeys_) drawKeyList(area);
}

void Viewer::drawPanels() {
  if (!draftHeld_) draft_ = open_->scene();
  const glm::vec3 target = open_->camera().target();
  const std::string name = open_->name();
  PanelContext context{draft_, widgets_, session(), open_->view, {target.x, target.y, target.z}, name};
  column_.draw(context, config_);
  asked_.edits = widgets_.takeEdits();
  asked_.panels = std::move(context.requests);
}

// What the controls of the last picture ask for.
void Viewer::heedControls() {
  const Asked asked = std::exchange(asked_, {});
  heed(asked.edits);
  heed(asked.panels);
  heed(asked.timeline);
}

void Viewer::heed(const FieldEdits& edits) {
  draftHeld_ = edits.holding;
  const bool edited = edits.live || edits.rebuild;
  if (edited) {
    attempt([&] {
      draftHeld_ = false;  // should the edit be impossible, the panels show what is
      edit(draft_, editContinues_);
      draftHeld_ = edits.holding;
    });
  }
  editContinues_ = edits.holding && (editContinues_ || edited);
}

void Viewer::heed(const PanelRequests& requests) {
  attempt([&] {
    for (const ViewerAction action : requests.actions) act(action);
    if (requests.backend) switchBackend(*requests.backend);
    if (requests.saveSceneAs) saveSceneAs(*requests.saveSceneAs);
    if (requests.resetScene) {
      edit(open_->loaded(), false);
      restart();
    }
    if (requests.openScene) openScene(*requests.openScene);
  });
}

void Viewer::heed(const TimelineRequests& requests) {
  attempt([&] {
    if (requests.seek) seek(*requests.seek);
    if (requests.stepBack) act(ViewerAction::stepBack);
    if (requests.stepForward) act(ViewerAction::stepForward);
    if (requests.togglePause) act(ViewerAction::pause);
    if (requests.screenshot) act(ViewerAction::screenshot);
    if (requests.toggleRecording) act(ViewerAction::recordClip);
  });
}

void Viewer::keepConfig() {
  if (config_ == savedConfig_) return;
  const std::string trouble = saveViewerConfig(config_, viewerConfigPath());
  savedConfig_ = config_;  // one try for each change
  if (!trouble.empty()) complain("The panels will not be remembered: " + trouble);
}

}  // namespace

void runViewer(const Scene& scene, const ViewerOptions& options) { Viewer(scene, options).run(); }

std::string viewerKeysText() {
  std::size_t widest = 0;
  for (const ViewerKey& key : viewerKeys) widest = std::max(widest, key.input.size());
  std::string text;
  for (const ViewerKey& key : viewerKeys) {
    text += "  " + std::string(key.input);
    text.append(widest + 2 - key.input.size(), ' ');
    text += std::string(key.effect) + "\n";
  }
  return text;
}

}  // namespace clothsim

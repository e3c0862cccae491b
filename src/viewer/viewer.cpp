// The main loop of the viewer: it simulates, and draws the picture and what is over it (viewer_controls.cpp).
// mouse_tools.h has what the mouse does, open_scene.h the open scene.
#include "viewer/viewer.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "core/thread_team.h"
#include "gl/context.h"
#include "output/numbered_files.h"
#include "render/textures.h"
#include "simulation/gpu/solvers.h"
#include "viewer/viewer_facts.h"
#include "viewer/viewer_program.h"

namespace clothsim {
namespace {

constexpr float panelsFrom =
    54;  // width of the window in em from which the panels are open at the first start
constexpr double quickPicture = 0.015;          // takes so long at most [s]
constexpr double slowSeconds = 2.5;             // after which remedies are tried
constexpr double longestWaitForFrame = 1;       // of edits and of other scenes [s]
constexpr double longestWait = 0.25;            // for input [s]: notices disappear
constexpr double mostSimulationSeconds = 0.05;  // between two pictures, where a frame takes less

}  // namespace

Quality chosenQuality(const std::string& wish) {
  const Quality automatic = gl::currentContextInfo().software ? Quality::draft : Quality::final;
  return qualityNamed(wish).value_or(automatic);
}

RenderOptions Viewer::renderOptions() const {
  RenderOptions render;
  render.sphereSegmentsAround = options_.sphereSegmentsAround;
  render.sphereSegmentsDown = options_.sphereSegmentsDown;
  return withQuality(render, quality_, gl::currentContextInfo().software);
}

Viewer::Viewer(const Shared<Scene>& scene, const ViewerOptions& options,
               const std::optional<LostSession>& lost)
    : options_(options), window_("clothsim", options.sceneName) {
  setQuality(chosenQuality(options.quality));
  LoadedConfig loaded = loadViewerConfig(viewerConfigPath());
  config_ = savedConfig_ = loaded.config;
  if (!loaded.notice.empty()) say(loaded.notice, longNoticeSeconds);
  std::vector<std::string> textures = bundledTextures();
  textures.insert(textures.begin(), "");
  widgets_.offer("render.texture", std::move(textures));
  listen();
  const std::string source = lost ? lost->source : options.sceneName;
  const std::string backend = announcedBackend(options.backend);
  open_ = load(source, [&] {
    return std::make_unique<OpenScene>(lost ? lost->loaded : scene, source, lost ? "cpu" : backend,
                                       renderOptions());
  });
  if (lost) {
    if (lost->edited != lost->loaded) open_->edit(*lost->edited, false);
    session().goOnFrom(lost->past);
    complain(lost->reason + "\nThe scene restarts on the CPU; your edits and the recording are kept.");
  }
  pace_ = Pace(open_->frameSeconds());
  watchSteps();
  warnOfPaths();
}

std::optional<LostSession> Viewer::run() {
  clock_.lap();  // the time for loading is not simulated
  while (!window_.shouldClose() && !lost_) iterate();
  endClip();
  endFrames();
  if (lost_ && !window_.shouldClose())
    return LostSession{open_->source(), open_->loaded(), open_->sharedScene(), session().past(), *lost_};
  std::fputs(timings_.report().c_str(), stderr);
  return std::nullopt;
}

void Viewer::iterate() {
  timings_.time(FrameTimings::input, [&] { waitForInput(); });
  if (sceneToOpen_ && !isStepping() &&
      !attempt([&] { openScene(*std::exchange(sceneToOpen_, std::nullopt)); }))
    tellDialog();
  const double elapsed = clock_.lap();
  now_ += elapsed;
  notice_.secondsLeft -= elapsed;
  compare_.pass(elapsed);
  hurrySteps();
  int frames = 0;
  timings_.time(FrameTimings::simulate, [&] { frames = simulate(elapsed); });
  // Until the next frame is there, the picture changes only by what the user does.
  const bool draws =
      frames > 0 || mayChange() || (paused_ && !steps_.isBusy()) || now_ - lastDrawn_ > longestWait;
  if (!trials_.isRunning()) meter_.add(elapsed, frames * open_->frameSeconds(), draws ? 1 : 0);
  watchPace(elapsed);
  timings_.simulated(frames * open_->frameSeconds());
  if (!draws) return;
  lastDrawn_ = now_;
  attempt([&] { taker_.shown(*open_, paused_ ? elapsed : frames * open_->frameSeconds()); });
  LapClock drawing;
  attempt([&] { draw(); });
  meter_.spent(0, drawing.lap());
  keepConfig();
  attempt(gl::checkContext);
}

// Without a frame of the simulation.
bool Viewer::mayChange() { return drawsLeft_ > 0 || !window_.inputQueue().isEmpty() || compare_.isRunning(); }

// And for the next frame, if there is nothing else to do.
void Viewer::waitForInput() {
  if (isIdle() || (steps_.isBusy() && !steps_.isDone() && !mayChange()))
    return window_.waitEvents(longestWait);
  const double left = pace_.secondsUntilDue() / tempo_ - clock_.sinceLap();
  const bool waits = !paused_ && !steps_.isBusy() && !mayChange() && left > 0;
  waits ? window_.waitEvents(std::min(longestWait, left)) : window_.pollEvents();
}

bool Viewer::showsPanels() const {
  return config_.showPanels.value_or(static_cast<float>(window_.size().width) >= panelsFrom * textHeight());
}

PictureArea Viewer::pictureArea() const {
  const ViewerWindow::Size size = window_.size();
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  if (!showsPanels()) return {width, height};
  return {width - PanelColumn::width(width, textHeight()), height};
}

CoveredEdges Viewer::coveredEdges() const {
  const PictureArea area = pictureArea();
  CoveredEdges covered = compare_.coveredEdges(area);
  covered.bottom = std::min(0.45, double{timelineHeight() / area.height});
  return covered;
}

// Computed here, since Dear ImGui learns the position of the mouse only in the next frame.
bool Viewer::isOverPicture(ViewerWindow::Cursor cursor) const {
  if (dialog_.isOpen()) return false;
  const PictureArea area = pictureArea();
  const bool inside = cursor.x >= 0 && cursor.x < static_cast<double>(area.width) && cursor.y >= 0 &&
                      cursor.y < static_cast<double>(area.height - timelineHeight());
  return inside && !((ui_.hasPopup() || compare_.isOpen() || showKeys_ || advice()) && ui_.wantsMouse());
}

std::optional<AxisEnd> Viewer::axisEndUnder(ViewerWindow::Cursor cursor) const {
  if (!config_.showOverlay) return std::nullopt;
  return axisEndAt(open_->camera(), pictureArea(), textHeight(), glm::vec2(cursor.x, cursor.y));
}

std::optional<GizmoMode> Viewer::gizmoButtonUnder(ViewerWindow::Cursor cursor) const {
  if (!config_.showOverlay) return std::nullopt;
  return gizmoButtonAt(pictureArea().width, textHeight(), glm::vec2(cursor.x, cursor.y));
}

MouseContext Viewer::mouseContext() {
  const PictureArea area = pictureArea();
  return {*open_,
          open_->renderer(),
          open_->camera(),
          std::max(1, static_cast<int>(area.width)),
          std::max(1, static_cast<int>(area.height)),
          textHeight(),
          paused_,
          [this](const Action& action, bool continues) {
            whenIdle([=, this] { session().act(action, continues); });
          }};
}

bool Viewer::isIdle() {
  return paused_ && !stepAsked_ && !isStepping() && drawsLeft_ <= 0 && window_.inputQueue().isEmpty() &&
         !compare_.isRunning() && !taker_.recordedSeconds() && !isRefining();
}

// In final quality what rests is exposed again and again.
bool Viewer::isRefining() const {
  return paused_ && quality_ == Quality::final && refined_.exposures() < FINAL_EXPOSURES;
}

std::optional<int> Viewer::refinedExposures() const {
  return paused_ && quality_ == Quality::final ? std::optional(refined_.exposures()) : std::nullopt;
}

// Returns the number of frames that were simulated since the last call.
int Viewer::simulate(double elapsed) {
  if (drawsLeft_ > 0) --drawsLeft_;
  unpaced_ += elapsed;
  int done = 0;
  if (steps_.isBusy()) {
    if (!steps_.isDone()) return 0;
    done = takeFrames();
    attempt([&] { measure(); });
  }
  attempt([&] {
    compare_.advance();
    const bool blows = !paused_ && !ui_.wantsKeys() && window_.holds(blowKey);
    mouse_.beforeStep(mouseContext(), window_.cursor(), blows);
  });
  const double unpaced = std::exchange(unpaced_, 0);
  if (compare_.isRunning() || sceneToOpen_ || lost_ || tryRemedies()) return done;
  if (startsAgain()) {
    restart();
    say("Starts again, until you touch the cloth or change something");
  }
  const bool onGpu = open_->backend() != "cpu";
  const int frames = paused_ ? std::exchange(stepAsked_, false) : pace_.framesDue(tempo_ * unpaced, onGpu);
  if (frames == 0) return done;
  if (session().frame() < session().newestFrame()) column_.measures().dropFuture(session());
  if (onGpu) return done + stepFrames(frames);
  attempt([&] { startFrames(frames); });
  return done;
}

// On the GPU: on this thread, which has the context.
int Viewer::stepFrames(int frames) {
  LapClock clock;
  const int before = session().frame();
  stepping_ = true;
  std::optional<Divergence> divergence;
  double seconds = 0;
  const bool went = attempt([&] {
    for (int i = 0; i < frames && !divergence && seconds < mostSimulationSeconds && !window_.shouldClose();
         ++i) {
      divergence = session().stepFrames(1);
      session().simulation().finish();
      seconds += clock.lap();
    }
  });
  stepping_ = false;
  return finishedFrames(std::max(0, session().frame() - before), seconds, went, divergence);
}

// On the CPU: the thread has the session until takeFrames(), and this one shows the state from before.
void Viewer::startFrames(int frames) {
  shownVersion_ = session().simulation().version();
  open_->hold();
  steps_.start(session(), frames, mostSimulationSeconds);
}

int Viewer::takeFrames() {
  StepThread::Result result = steps_.take();
  open_->release();
  session().freeDropped();
  const bool went = attempt([&] {
    if (result.error) std::rethrow_exception(result.error);
  });
  return finishedFrames(result.frames, result.seconds, went, result.divergence);
}

int Viewer::finishedFrames(int frames, double seconds, bool went,
                           const std::optional<Divergence>& divergence) {
  if (!went) paused_ = pausedByError_ = true;
  doWaiting();
  if (divergence) {
    paused_ = pausedByError_ = true;
    notice_ = {blowUpText(*divergence, session().simulation().cloth(), open_->scene(),
                          session().frameSinceStart() + 1) +
                   "\nPaused at the last good state. Press R to restart.",
               1e9, true};
  }
  pace_.simulated(frames, seconds);
  meter_.spent(seconds, 0);
  column_.measures().stepped(static_cast<double>(session().simulation().cloth().particleCount()) * frames *
                                 open_->scene().solver.simulationSteps,
                             seconds);
  return frames;
}

// What was asked for within a frame.
void Viewer::doWaiting() {
  if (waitingEdit_) attempt([&] { edit(*std::exchange(waitingEdit_, std::nullopt), editContinues_); });
  for (const auto& task : std::exchange(waiting_, {})) attempt(task);
}

// A frame that takes long is given up for what waits for its end.
void Viewer::hurrySteps() {
  const bool waits = sceneToOpen_ || waitingEdit_ || !waiting_.empty();
  if (!waits || !steps_.isBusy()) return static_cast<void>(waitingSince_ = now_);
  if (now_ - waitingSince_ < longestWaitForFrame) return;
  steps_.stop();
  say("Waiting for the end of a step");
}

// Before the end: a step that does not end soon ends with the program.
void Viewer::endFrames() {
  if (trials_.isRunning() && !trials_.isDone()) leaveAtOnce();
  if (!steps_.isBusy()) return;
  steps_.stop();
  if (lost_ || steps_.waitFor(std::chrono::milliseconds(150))) return static_cast<void>(takeFrames());
  leaveAtOnce();
}

// Without waiting for other threads.
void Viewer::leaveAtOnce() {
  std::fputs(timings_.report().c_str(), stderr);
  std::fflush(nullptr);
  std::_Exit(0);
}

void Viewer::draw() {
  const ViewerWindow::Size size = window_.size();
  if (size.width == 0 || size.height == 0) return;  // minimised
  const WorkAlone whileDrawing(ThreadTeam::shared(), gl::currentContextInfo().software);
  const PictureArea area = pictureArea();
  const ViewOptions wanted = open_->view;
  open_->view.showPins = wanted.showPins || now_ < pinsShownUntil_ || window_.holdsShift();
  attempt([&] { open_->update(); });
  open_->view = wanted;
  const auto width = static_cast<int>(area.width), height = static_cast<int>(area.height);
  timings_.time(FrameTimings::picture, [&] { attempt([&] { drawPicture(width, height); }); });
  const bool areControlsNew = !mayKeepControls();
  if (areControlsNew)
    timings_.time(FrameTimings::controls, [&] {
      laidOut_ = {now_, size};
      ui_.begin(textScale());
      attempt([&] { drawControls(); });
      ui_.end();
    });
  timings_.time(FrameTimings::drawControls, [&] { ui_.draw(area.width, areControlsNew); });
  timings_.time(FrameTimings::swap, [&] { window_.swap(); });
  timings_.time(FrameTimings::after, [&] {
    if (areControlsNew) applyRequests();
    if (!isStepping()) attempt([&] { measure(); });
  });
  if (const std::string now = viewerTitle(*open_, meter_, paused_); now != title_)
    window_.setTitle(title_ = now);
}

// On a software renderer controls take a tenth of every picture's time. Without input they are laid out ten
// times a second there, which is as often as numbers and plots can be read.
bool Viewer::mayKeepControls() {
  constexpr double longestLag = 0.1;  // [s]
  const bool isUsed = paused_ || mayChange() || draftHeld_ || ui_.isHeld() || dialog_.isOpen() ||
                      laidOut_.size != window_.size();
  const bool followCloth =
      mouse_.isBusy() || compare_.isOpen() || mouse_.chosen().gizmo(mouseContext()).has_value();
  return gl::currentContextInfo().software && !isUsed && !followCloth && now_ - laidOut_.time < longestLag;
}

// What rests is drawn in all pixels, and so is what is being recorded.
void Viewer::drawPicture(int width, int height) {
  open_->frameFor(width, height, coveredEdges());
  const bool rests = paused_ && drawsLeft_ <= 0;
  const bool software = gl::currentContextInfo().software;
  const bool whole = rests || taker_.recordedSeconds() || !software;
  if (rests && quality_ == Quality::final) {
    kept_.forget();
    open_->renderer().renderer().setScale(1);
    open_->refine(refined_.exposuresOf(pictureKey(width, height)), width, height);
    refined_.exposed(FINAL_EXPOSURES);
    return;
  }
  refined_.forget();
  if (!software) return open_->draw(0, width, height);
  const PictureKey key = pictureKey(width, height);
  // What the input has changed over the picture is shown first, where a new one takes its time; never twice
  // in a row.
  answersFirst_ = std::exchange(hasInput_, false) && !answersFirst_ && !paused_ &&
                  pictureSeconds_ > quickPicture && kept_.looksLike(key, whole ? 1 : drawScale_.scale());
  if (!answersFirst_) drawInto(key, whole);
  kept_.show();
  gl::bindFramebuffer(0);  // for what is drawn over it
}

void Viewer::drawInto(const PictureKey& key, bool whole) {
  const double scale = whole ? 1 : drawScale_.scale();
  if (kept_.isOf(key, scale)) return;
  open_->renderer().renderer().setScale(scale);
  LapClock clock;
  open_->drawOver(kept_.drawInto(key.width, key.height));
  kept_.drawn(key, scale);
  if (whole) return;
  gl::finish();
  pictureSeconds_ = clock.lap();
  drawScale_.drawn(pictureSeconds_);
}

PictureKey Viewer::pictureKey(int width, int height) {
  if (!steps_.isBusy()) shownVersion_ = session().simulation().version();  // as it stays while a thread steps
  const Camera& camera = open_->camera();
  return {camera.view(), camera.projection(double(width) / height),
          width,         height,
          open_->view,   &open_->scene(),
          open_->time(), shownVersion_};
}

// To be called between two pictures, since picking draws into another framebuffer.
void Viewer::measure() {
  column_.measures().update(session(), now_, [&]() -> std::optional<std::uint32_t> {
    const ViewerWindow::Cursor cursor = window_.cursor();
    if (!isOverPicture(cursor)) return std::nullopt;
    const MouseContext r = mouseContext();
    const Pick pick = r.renderer.pick(r.camera, r.width, r.height, cursor.x, cursor.y);
    return pick.kind == Pick::Kind::cloth ? std::optional(pick.particle) : std::nullopt;
  });
}

PaceFigures Viewer::paceFigures() const {
  return {meter_.realTimeFactor() / tempo_, meter_.steppingShare(), meter_.drawingShare(), tempo_};
}

std::optional<PaceAdvice> Viewer::advice() const {
  if (paused_ || compare_.isRunning() || !meter_.isMeasured()) return std::nullopt;
  if (trials_.isRunning()) return PaceAdvice{"Trying what would help ..."};
  if (!isSlow(paceFigures()) || remedies_.empty() ||
      triedFor_ != std::pair(&open_->scene(), open_->backend()))
    return std::nullopt;
  return PaceAdvice{causeOf(paceFigures()), bestOf(remedies_, paceFigures())};
}

void Viewer::watchPace(double elapsed) {
  const bool waits = paused_ || compare_.isRunning() || mouse_.isBusy() || !meter_.isMeasured();
  slowFor_ = !waits && isSlow(paceFigures()) ? slowFor_ + elapsed : 0;
}

// Once the scene has been slow for a while, and while nothing is stepped. Returns whether trials go on.
bool Viewer::tryRemedies() {
  if (trials_.isDone()) {
    remedies_ = trials_.take();
    meter_ = {};
    slowFor_ = 0;
    pace_ = Pace(open_->frameSeconds());
  }
  if (trials_.isRunning()) return true;
  const std::pair now(&open_->scene(), open_->backend());
  if (slowFor_ < slowSeconds || triedFor_ == now) return false;
  triedFor_ = now;
  remedies_.clear();
  attempt([&] {
    std::vector<PaceRemedy> remedies = remediesFor(paceFigures(), open_->scene(), quality_,
                                                   gl::currentContextInfo().software, open_->backend());
    Simulation& simulation = session().simulation();
    trials_.start(std::move(remedies), open_->sharedScene(), simulation.sharedCloth(), simulation.state(),
                  tempo_);
  });
  return trials_.isRunning();
}

void Viewer::apply(const PaceRemedy& remedy) {
  attempt([&] {
    if (remedy.quality) setQuality(*remedy.quality);
    if (remedy.backend) switchBackend(*remedy.backend);
    if (remedy.scene) edit(*remedy.scene, false);
    if (remedy.tempo) tempo_ = *remedy.tempo;
    meter_ = {};
  });
}

void Viewer::keepConfig() {
  if (config_ == savedConfig_) return;
  const std::string fault = saveViewerConfig(config_, viewerConfigPath());
  savedConfig_ = config_;  // tried once for each change
  if (!fault.empty()) complain("The state of the panels cannot be saved: " + fault);
}

void runViewer(const Shared<Scene>& scene, const ViewerOptions& options) {
  std::optional<LostSession> lost;
  do {
    try {
      lost = Viewer(scene, options, lost).run();
    } catch (const Error& error) {
      if (!lost || lost->past.recording.events.empty()) throw;
      // There is no second window, so the recording is saved.
      const auto path = freeName(outputFolder(),
                                 std::filesystem::path(lost->source).stem().string() + "-recording", ".json");
      lost->past.recording.save(path);
      throw OpenGlError(lost->reason + "\n" + error.what() +
                        "\nYour actions are saved; to repeat them: clothsim run --replay " + path.string());
    }
  } while (lost);
}

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

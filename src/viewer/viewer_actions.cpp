// The actions of keys, mouse and panels.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <future>

#include "cloth/material.h"
#include "core/formatted.h"
#include "export/export.h"
#include "export/sequence.h"
#include "output/numbered_files.h"
#include "render/shading_models.h"
#include "scene_io/mesh_scene.h"
#include "scene_io/scene_io.h"
#include "scene_io/solver_defaults.h"
#include "session/carry_over.h"
#include "viewer/viewer_facts.h"
#include "viewer/viewer_program.h"

namespace clothsim {
namespace {

constexpr double textSizeStep = 0.125;
constexpr double pinsShownSeconds = 2;  // after a pin was set

// Whether a cloth of springs is a fabric in the other scene.
bool areOfOtherKinds(const Scene& a, const Scene& b) {
  return !std::ranges::equal(a.cloths, b.cloths, [](const ClothSettings& one, const ClothSettings& other) {
    return one.material.has_value() == other.material.has_value();
  });
}

}  // namespace

void Viewer::listen() {
  window_.setInput(
      {.key = [this](const KeyStroke& stroke, bool repeated) { onKey(stroke, repeated); },
       .press = [this](ViewerWindow::Button button, ViewerWindow::Cursor cursor, bool control,
                       bool shift) { atOnce([=, this] { onPress(button, cursor, control, shift); }); },
       .move =
           [this](ViewerWindow::Cursor cursor) {
             atOnce([=, this] { mouse_.move(mouseContext(), cursor, window_.holdsControl()); });
           },
       .release =
           [this](ViewerWindow::Button button) {
             atOnce([=, this] { mouse_.release(mouseContext(), button); });
             whenIdle([this] { mouse_.moveChosen(mouseContext()); });
           },
       .scroll =
           [this](double steps, ViewerWindow::Cursor cursor) {
             atOnce([=, this] {
               if (isOverPicture(cursor)) mouse_.scroll(mouseContext(), steps, cursor);
             });
           },
       .drop =
           [this](const std::vector<std::string>& paths) {
             if (!paths.empty()) drop(paths.front());
           }});
}

// Input that comes within a frame is handled at the end of the frame.
void Viewer::whenIdle(std::function<void()> task) {
  drawsLeft_ = drawsAfterInput;
  hasInput_ = true;
  if (isStepping())
    waiting_.push_back(std::move(task));
  else
    attempt(task);
}

// What asks the session for nothing, or through MouseContext::act alone. It waits for a frame that this
// thread is in, which may be within a call of the session.
void Viewer::atOnce(std::function<void()> task) { stepping_ ? whenIdle(std::move(task)) : doNow(task); }

void Viewer::doNow(const std::function<void()>& task) {
  drawsLeft_ = drawsAfterInput;
  hasInput_ = true;
  attempt(task);
}

void Viewer::onKey(const KeyStroke& stroke, bool repeated) {
  const bool isTyping = ui_.wantsKeys() || (dialog_.isOpen() && actionOf(stroke) != ViewerAction::quit);
  const ViewerAction action = isTyping ? ViewerAction::none : actionOf(stroke);
  if (action == ViewerAction::quit) return escape();  // never waits for a frame
  // A key that is held repeats only actions for which that makes sense.
  const bool repeats = action == ViewerAction::stepBack || action == ViewerAction::stepForward ||
                       action == ViewerAction::stepFrame || action == ViewerAction::undo ||
                       action == ViewerAction::redo;
  const auto task = [=, this] {
    if (!repeated || repeats) act(action);
  };
  if (action == ViewerAction::openFile) return doNow(task);  // does not wait: Esc finds it open
  isImmediate(action) ? atOnce(task) : whenIdle(task);
}

// Closes what is open over the picture, else the window.
void Viewer::escape() {
  drawsLeft_ = drawsAfterInput;
  if (isLoading_) return window_.requestClose();
  if (dialog_.isOpen() || ui_.hasPopup()) {
    dialog_.close();
    return ui_.closePopups();
  }
  if (compare_.isOpen()) return compare_.close();
  if (showKeys_) {
    showKeys_ = false;
    return;
  }
  if (mouse_.chosen().gizmo(mouseContext())) return mouse_.chosen().chooseNothing();
  window_.requestClose();
}

void Viewer::onPress(ViewerWindow::Button button, ViewerWindow::Cursor cursor, bool control, bool shift) {
  if (!isOverPicture(cursor)) return;
  if (!compare_.isRunning()) compare_.close();
  if (const auto end = axisEndUnder(cursor)) return open_->camera().lookFrom(end->axis, end->positive);
  if (const auto mode = gizmoButtonUnder(cursor)) return showGizmo(*mode);
  const std::string said =
      mouse_.press(mouseContext(), button, cursor, {control, shift, window_.holds(cutKey)});
  if (said.empty()) return;
  pinsShownUntil_ = now_ + pinsShownSeconds;
  say(said);
}

void Viewer::act(ViewerAction action) {
  if (!compare_.isRunning()) compare_.close();  // a result that has been seen
  switch (action) {
    case ViewerAction::none:
      return;
    case ViewerAction::pause:
      paused_ = !paused_;
      pausedByError_ = false;
      if (notice_.isError) notice_ = {};
      return;
    case ViewerAction::stepFrame:
      stepAsked_ = paused_;
      return;
    case ViewerAction::slowMotion:
      tempo_ = nextTempo(tempo_);
      return say(tempo_ < 1 ? formatted("Slow motion: %g\u00d7", tempo_) : "Real time");
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
    case ViewerAction::nextQuality:
      setQuality(
          static_cast<Quality>((static_cast<int>(quality_) + 1) % static_cast<int>(qualityNames.size())));
      return say("Quality of the picture: " + std::string(nameOf(quality_)));
    case ViewerAction::nextGizmo: {
      const bool isShown = mouse_.chosen().gizmo(mouseContext()).has_value();
      const bool isMove = mouse_.chosen().mode == GizmoMode::move;
      return showGizmo(isShown == isMove ? GizmoMode::rotate : GizmoMode::move);
    }
    case ViewerAction::resetCamera:
      return open_->camera().reset();
    case ViewerAction::viewFromRight:
      return open_->camera().lookFrom(0);
    case ViewerAction::viewFromTop:
      return open_->camera().lookFrom(1);
    case ViewerAction::viewFromFront:
      return open_->camera().lookFrom(2);
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
    case ViewerAction::largerText:
      return changeTextSize(textSizeStep);
    case ViewerAction::smallerText:
      return changeTextSize(-textSizeStep);
    case ViewerAction::reloadShaders:
      return reloadShaders();
    case ViewerAction::quit:
      return escape();
    default:
      return actOnFile(action);
  }
}

void Viewer::actOnFile(ViewerAction action) {
  if (action == ViewerAction::openFile) return dialog_.open(config_.folder);
  if (action == ViewerAction::reloadScene) {
    sceneToOpen_ = open_->source();
    return;
  }
  const PictureArea area = pictureArea();
  const int width = static_cast<int>(area.width), height = static_cast<int>(area.height);
  if (action == ViewerAction::screenshot)
    say(taker_.screenshot(*open_, width, height, quality_ == Quality::final ? FINAL_EXPOSURES : 1),
        longNoticeSeconds);
  if (action == ViewerAction::recordClip) say(taker_.toggleClip(*open_, width, height), longNoticeSeconds);
  if (action == ViewerAction::saveScene) saveSceneAs(freeName(outputFolder(), open_->name(), ".json"));
  if (action == ViewerAction::saveRecording) {
    const auto path = freeName(outputFolder(), open_->name() + "-recording", ".json");
    session().recording().save(path);
    say("Saved " + path.string() + "; clothsim run --replay " + path.string() + " repeats your actions",
        longNoticeSeconds);
  }
}

// Keeps the window responsive while a frame is simulated, and lets it be closed.
void Viewer::watchSteps() {
  session().setPoll([this] {
    if (std::this_thread::get_id() != ownThread_) return !steps_.isStopped();
    window_.pollEvents();
    return !window_.shouldClose();
  });
}

void Viewer::switchBackend(const std::string& backend) {
  session().act(SwitchBackend{backend});
  say(std::string("Now on the ") + (backend == "gpu" ? "GPU" : "CPU") + ", from the bit-identical state");
}

void Viewer::switchIntegrator() {
  Scene scene = open_->scene();
  const auto integrator =
      static_cast<Integrator>((static_cast<int>(scene.solver.integrator) + 1) % INTEGRATOR_COUNT);
  setIntegrator(scene, integrator);
  if (integrator == Integrator::implicit) {  // one long step costs as much as dozens of short ones
    explicitSteps_.reset();
    if (!scene.solver.simulationSteps.automatic) explicitSteps_ = scene.solver.simulationSteps.count;
    scene.solver.simulationSteps.automatic = true;
    chooseCounts(scene);
  } else if (!isImplicit(integrator) && scene.solver.simulationSteps.automatic && explicitSteps_) {
    scene.solver.simulationSteps = *explicitSteps_;
  }
  edit(scene, false);
  say(std::string("Integrator: ") + integratorName(integrator));
}

void Viewer::nextShader() {
  const std::vector<std::string> names = shadingModelNames();
  Scene scene = open_->scene();
  const auto at = std::find(names.begin(), names.end(), scene.render.shader);
  scene.render.shader = at == names.end() || at + 1 == names.end() ? names.front() : *(at + 1);
  edit(scene, false);
  say("Shading model: " + scene.render.shader);
}

void Viewer::showGizmo(GizmoMode mode) {
  Chosen& chosen = mouse_.chosen();
  if (chosen.isDragged()) return;
  chosen.mode = mode;
  if (!chosen.gizmo(mouseContext()) && !chosen.chooseFirst(mouseContext()))
    say("This scene has neither colliders nor pins that can be moved");
}

void Viewer::setQuality(Quality quality) {
  quality_ = quality;
  drawScale_ = DrawScale(pictureBudget(quality));
  kept_.forget();
  if (open_) open_->renderer().setOptions(renderOptions());
}

void Viewer::edit(const Scene& scene, bool continues) {
  const double before = open_->frameSeconds();
  open_->edit(scene, continues);
  column_.measures().sampleSoon();
  if (open_->frameSeconds() != before) pace_ = Pace(open_->frameSeconds());
}

void Viewer::undo(bool again) {
  if (again ? !session().canRedo() : !session().canUndo())
    return say(again ? "Nothing to redo" : "Nothing to undo; the timeline takes back cuts and pins");
  const Shared<Scene> before = open_->sharedScene();
  again ? session().redo() : session().undo();
  column_.measures().sampleSoon();
  pace_ = Pace(open_->frameSeconds());
  if (areOfOtherKinds(*before, open_->scene())) return startAnew();
  say(again ? "Redone" : "Undone");
}

void Viewer::seek(int frame) {
  if (frame < session().oldestFrame() || frame > session().newestFrame())
    return say(frame > session().newestFrame() ? "This is the newest frame; N simulates the next one"
                                               : "No earlier frame is kept in memory");
  if (frame == session().frame()) return;
  mouse_.letGo(session());
  const Shared<Scene> before = open_->sharedScene();
  column_.measures().keepCounts(session());
  session().seek(frame);
  if (*before != open_->scene()) say("Parameters are as they were in this frame");
  paused_ = true;
  pace_ = Pace(open_->frameSeconds());
}

void Viewer::restart() {
  mouse_.letGo(session());
  session().act(Restart{});
  column_.measures().forget(session());
  if (std::exchange(pausedByError_, false)) paused_ = false;
  notice_ = {};
}

void Viewer::startAnew() {
  restart();
  say("The cloth restarts: springs and fabric cannot be exchanged while it moves.", longNoticeSeconds);
}

bool Viewer::startsAgain() {
  const auto isOwn = [](const Recording::Event& event) {  // not something that the user has done to the cloth
    return std::holds_alternative<Restart>(event.action) ||
           std::holds_alternative<SwitchBackend>(event.action);
  };
  return options_.restartAfter > 0 && !paused_ &&
         session().frameSinceStart() * open_->frameSeconds() >= options_.restartAfter &&
         std::ranges::all_of(session().recording().events, isOwn);
}

std::unique_ptr<OpenScene> Viewer::load(const std::string& source,
                                        const std::function<std::unique_ptr<OpenScene>()>& make) {
  const std::string name = std::filesystem::path(source).stem().string();
  window_.setTitle(title_ = name + " - loading - clothsim");
  stepping_ = isLoading_ = true;  // delays input
  for (int i = 0; i < 2; ++i) {   // a window that was just opened may lose its first picture
    ui_.begin(textScale());
    drawLoading(name);
    ui_.end();
    ui_.draw(static_cast<float>(window_.size().width), true);
    window_.swap();
    window_.pollEvents();
  }
  // Loading runs on another thread, which has the context meanwhile.
  window_.lendContext();
  std::future<std::unique_ptr<OpenScene>> making = std::async(std::launch::async, [&] {
    window_.takeContext();
    const std::shared_ptr<void> handBack(nullptr, [this](void*) {
      window_.lendContext();
      window_.wakeUp();
    });
    return make();
  });
  while (making.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    window_.waitEvents(0.05);
    if (!window_.shouldClose()) continue;
    endClip();
    std::fflush(nullptr);
    std::_Exit(0);  // without waiting for the thread
  }
  window_.takeContext();
  stepping_ = isLoading_ = false;
  waiting_.clear();  // input while the scene was loading
  clock_.lap();
  return making.get();
}

void Viewer::openScene(const std::string& source) {
  const std::string backend = open_->backend();
  std::unique_ptr<OpenScene> next = load(source, [&] {
    return std::make_unique<OpenScene>(loadSceneByName(source), source, backend, renderOptions());
  });
  dialog_.close();
  next->view = open_->view;
  if (source == open_->source())
    next->camera() = open_->camera();  // whoever edits a scene looks at the same place
  std::string clipSaved;
  const bool clipEnded = attempt([&] { clipSaved = taker_.endClip(); });
  compare_.close();
  mouse_ = {};
  trials_.abandon();
  triedFor_.first = nullptr;
  open_ = std::move(next);
  kept_.forget();
  watchSteps();
  column_.measures().forget(session());
  pace_ = Pace(open_->frameSeconds());
  draftHeld_ = paused_ = pausedByError_ = false;
  if (clipEnded) notice_ = {};
  if (!clipSaved.empty()) say(clipSaved, longNoticeSeconds);
  warnOfPaths();
}

// When the program ends: what was recorded is kept.
void Viewer::endClip() {
  attempt([&] {
    if (const std::string saved = taker_.endClip(); !saved.empty())
      std::fprintf(stderr, "clothsim: %s\n", saved.c_str());
  });
}

// Of a mesh the dialog asks what it is to be.
void Viewer::drop(const std::string& path) {
  drawsLeft_ = drawsAfterInput;
  if (kindOfFile(path) == FileKind::mesh)
    dialog_.openAt(path);
  else
    sceneToOpen_ = path;
}

// While a frame is simulated another scene waits for its end, and so does a solid.
void Viewer::openChosen(const OpenChoice& choice) {
  if (choice.use != OpenChoice::Use::solid) {
    sceneToOpen_ = choice.path;
    return;
  }
  whenIdle([=, this] {
    const bool went = attempt([&] {
      edit(withMeshSolid(open_->scene(), choice.path, toVec3d(open_->camera().target())), false);
      say("The mesh is a collider of this scene now (Ctrl+Z takes it out)", longNoticeSeconds);
      mouse_.chosen().chooseSolid(open_->scene().colliders.size() - 1);
    });
    went ? dialog_.close() : tellDialog();
  });
}

// What was wrong, where the user chose it.
void Viewer::tellDialog() {
  if (!dialog_.isOpen()) return;
  dialog_.complain(notice_.text);
  notice_ = {};
}

void Viewer::warnOfPaths() {
  Simulation& simulation = session().simulation();
  const std::vector<Warning> warnings =
      pathWarnings(simulation.cloth(), simulation.scene(), simulation.solver().state());
  if (!warnings.empty()) say(warnings.front().text, longNoticeSeconds);
}

// The scene with the pins that were set by hand and the camera where it is.
Scene Viewer::sceneAsSeen(const State& state) {
  Scene scene = withPinsByHand(open_->scene(), session().simulation().cloth(), state);
  scene.camera = open_->camera().settings(scene.camera);
  return scene;
}

// Saves the scene, or the state of the cloth, depending on the extension. An existing file is overwritten
// only when the user saves twice.
void Viewer::saveSceneAs(const std::filesystem::path& path) {
  if (isSequence(path))
    return complain(
        path.string() +
        " would hold many frames. Save your actions (Ctrl+Shift+S) and run: clothsim run --replay FILE "
        "--save " +
        path.filename().string());
  if (!canSaveStateAs(path) && path.extension() != ".json")
    return complain(path.string() + ": expected a name that ends in .json for the scene, or in " +
                    std::string(STATE_EXTENSIONS) + " for the cloth as it is now");
  std::error_code ignored;  // the writer complains
  if (std::filesystem::exists(path, ignored) && confirmed_ != path.string()) {
    confirmed_ = path.string();
    return complain(path.string() + " already exists; press Save again to overwrite it");
  }
  Simulation& simulation = session().simulation();
  const State state = simulation.solver().state();
  const bool isScene = !canSaveStateAs(path);
  isScene ? saveScene(sceneAsSeen(state), path)
          : saveState(state, simulation.cloth(), path, &simulation.scene());
  confirmed_ = path.string();
  column_.scenes().remember(path.string());
  say("Saved " + std::filesystem::absolute(path).lexically_normal().string() +
          (isScene && std::ranges::any_of(state.cuts, [](std::uint8_t cut) { return cut != 0; })
               ? "\nA scene has no cuts; Ctrl+Shift+S saves what you did"
               : ""),
      longNoticeSeconds);
}

void Viewer::saveCurves() {
  const std::filesystem::path path = freeName(outputFolder(), open_->name() + "-curves", ".csv");
  column_.measures().saveCurves(path);
  say("Saved " + path.string(), longNoticeSeconds);
}

void Viewer::reloadShaders() {
  kept_.forget();
  if (const std::optional<std::string> fault = open_->renderer().renderer().reloadShaders())
    notice_ = {*fault + "\nThe previous shaders are still in use.", 1e9, true};
  else
    say("Shaders reloaded");
}

void Viewer::changeTextSize(double by) {
  config_.textSize = std::clamp(config_.textSize + by, LEAST_TEXT_SIZE, LARGEST_TEXT_SIZE);
  say(formatted("Text size: %.3g %%", 100 * config_.textSize));
}

void Viewer::togglePanels() { config_.showPanels = !showsPanels(); }

}  // namespace clothsim

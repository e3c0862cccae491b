// The viewer: its state, its actions and its main loop. viewer.cpp has the loop, viewer_controls.cpp what is
// drawn over the picture, viewer_actions.cpp the actions of keys, mouse and panels.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "render/draw_scale.h"
#include "session/step_thread.h"
#include "viewer/axis_gizmo.h"
#include "viewer/compare_card.h"
#include "viewer/frame_timings.h"
#include "viewer/kept_picture.h"
#include "viewer/mouse_tools.h"
#include "viewer/open_dialog.h"
#include "viewer/open_scene.h"
#include "viewer/pace.h"
#include "viewer/pace_advice.h"
#include "viewer/pace_trials.h"
#include "viewer/panels/panels.h"
#include "viewer/picture_taker.h"
#include "viewer/timeline_bar.h"
#include "viewer/ui_frame.h"
#include "viewer/viewer.h"
#include "viewer/viewer_config.h"
#include "viewer/viewer_keys.h"
#include "viewer/viewer_overlay.h"
#include "viewer/viewer_window.h"

namespace clothsim {

// "auto" is draft on a software renderer and final on others. Needs a current context.
[[nodiscard]] Quality chosenQuality(const std::string& wish);

class LapClock {
 public:
  // Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }
  [[nodiscard]] double sinceLap() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// What is left of a session whose OpenGL context was lost.
struct LostSession {
  std::string source;            // the argument of -f
  Shared<Scene> loaded, edited;  // the scene of the file, and the scene at the end
  Session::Past past;
  std::string reason;
};

class Viewer {
 public:
  // Shows the scene; or restarts the scene of a lost session on the CPU, with its edits and its recording.
  Viewer(const Shared<Scene>& scene, const ViewerOptions& options, const std::optional<LostSession>& lost);

  // Runs until the window is closed, or until the context is lost.
  [[nodiscard]] std::optional<LostSession> run();

 private:
  struct Notice {
    std::string text;
    double secondsLeft = 0;
    bool isError = false;
  };

  // What the controls of a picture ask for. It is done after the picture, since much of it draws elsewhere.
  struct ControlRequests {
    FieldEdits edits;
    PanelRequests panels;
    TimelineRequests timeline;
    std::optional<PaceRemedy> remedy;  // that is to be applied
    std::optional<OpenChoice> file;    // that is to be opened
  };

  // --- input from the window
  void listen();
  void whenIdle(std::function<void()> task);
  void atOnce(std::function<void()> task);
  void doNow(const std::function<void()>& task);
  void onKey(const KeyStroke& stroke, bool repeated);
  void escape();
  void onPress(ViewerWindow::Button button, ViewerWindow::Cursor cursor, bool control, bool shift);
  void act(ViewerAction action);
  void actOnFile(ViewerAction action);

  void watchSteps();
  void warnOfPaths();

  // --- actions of keys and panels
  void switchBackend(const std::string& backend);
  void switchIntegrator();
  void nextShader();
  void setQuality(Quality quality);
  // Of what is chosen, or of the first solid or pins.
  void showGizmo(GizmoMode mode);
  [[nodiscard]] RenderOptions renderOptions() const;
  void edit(const Scene& scene, bool continues);
  void undo(bool again);
  void seek(int frame);
  void restart();
  void startAnew();  // the same where springs have become fabric, or fabric springs
  // Whether ViewerOptions::restartAfter is over.
  [[nodiscard]] bool startsAgain();
  void openScene(const std::string& source);
  void endClip();
  void drop(const std::string& path);
  void openChosen(const OpenChoice& choice);
  void tellDialog();
  // Loads a scene while the window says so. When the window is closed meanwhile, the program ends.
  [[nodiscard]] std::unique_ptr<OpenScene> load(const std::string& source,
                                                const std::function<std::unique_ptr<OpenScene>()>& make);
  [[nodiscard]] Scene sceneAsSeen(const State& state);
  void saveSceneAs(const std::filesystem::path& path);
  void saveCurves();
  void reloadShaders();
  void togglePanels();
  void changeTextSize(double by);

  // --- an iteration of the main loop
  void iterate();
  int simulate(double elapsed);
  [[nodiscard]] int stepFrames(int frames);
  void startFrames(int frames);
  [[nodiscard]] int takeFrames();
  [[nodiscard]] int finishedFrames(int frames, double seconds, bool went,
                                   const std::optional<Divergence>& divergence);
  void endFrames();
  [[noreturn]] void leaveAtOnce();
  void doWaiting();
  void hurrySteps();
  [[nodiscard]] bool isStepping() const { return stepping_ || steps_.isBusy(); }
  void waitForInput();
  void draw();
  void drawPicture(int width, int height);
  void drawInto(const PictureKey& key, bool whole);
  [[nodiscard]] PictureKey pictureKey(int width, int height);
  void measure();
  void drawControls();
  void drawGizmos();
  void drawPanels();
  void applyRequests();
  void apply(const FieldEdits& edits);
  void apply(const PanelRequests& requests);
  void apply(const TimelineRequests& requests);
  void apply(const PaceRemedy& remedy);
  [[nodiscard]] PaceFigures paceFigures() const;
  [[nodiscard]] std::optional<PaceAdvice> advice() const;
  void watchPace(double elapsed);
  bool tryRemedies();
  void keepConfig();

  [[nodiscard]] Session& session() { return open_->session(); }
  // Of text, and of all controls with it.
  [[nodiscard]] double textScale() const { return config_.textSize * window_.textScale(); }
  [[nodiscard]] float textHeight() const { return static_cast<float>(16 * textScale()); }  // [pixels]
  [[nodiscard]] bool showsPanels() const;
  [[nodiscard]] PictureArea pictureArea() const;
  [[nodiscard]] CoveredEdges coveredEdges() const;
  [[nodiscard]] bool isOverPicture(ViewerWindow::Cursor cursor) const;
  [[nodiscard]] std::optional<AxisEnd> axisEndUnder(ViewerWindow::Cursor cursor) const;
  [[nodiscard]] std::optional<GizmoMode> gizmoButtonUnder(ViewerWindow::Cursor cursor) const;
  [[nodiscard]] MouseContext mouseContext();
  [[nodiscard]] bool isIdle();
  [[nodiscard]] bool mayChange();
  [[nodiscard]] bool mayKeepControls();
  [[nodiscard]] bool isRefining() const;
  [[nodiscard]] std::optional<int> refinedExposures() const;

  static constexpr int drawsAfterInput = 3;
  static constexpr double noticeSeconds = 2.5, longNoticeSeconds = 8;
  void say(const std::string& text, double seconds = noticeSeconds) { notice_ = {text, seconds, false}; }
  void complain(const std::string& text) { notice_ = {text, longNoticeSeconds, true}; }
  // Runs a task that may fail. Then its error is shown and the viewer continues, so that nothing unsaved is
  // lost. Returns whether it succeeded.
  template <class Task>
  bool attempt(Task&& task) {
    try {
      task();
      return true;
    } catch (const gl::ContextLost& error) {
      lost_ = error.what();  // run() handles it
    } catch (const std::bad_alloc&) {
      complain("There is not enough memory for this.");
    } catch (const std::exception& error) {
      complain(error.what());
    }
    return false;
  }

  ViewerOptions options_;
  ViewerWindow window_;
  UiFrame ui_{window_.handle(), window_.inputQueue()};
  std::unique_ptr<OpenScene> open_;
  MouseTools mouse_;
  PanelColumn column_;
  FieldWidgets widgets_;
  CompareCard compare_;
  OpenDialog dialog_;
  PictureTaker taker_;
  Pace pace_{1.0 / 90};
  SpeedMeter meter_;
  PaceTrials trials_;
  std::vector<PaceRemedy> remedies_;  // that have been tried, for the scene and the backend
  std::pair<const Scene*, std::string> triedFor_{nullptr, ""};
  double slowFor_ = 0;  // [s]
  Quality quality_ = Quality::final;
  DrawScale drawScale_{0};
  KeptPicture kept_;
  RefinedPicture refined_;          // in final quality
  std::uint64_t shownVersion_ = 0;  // of the state that is shown
  double pictureSeconds_ = 0;       // that the last one took
  bool hasInput_ = false;           // since the last picture was drawn or shown again
  bool answersFirst_ = false;       // the last picture was shown again for that
  LapClock clock_;
  FrameTimings timings_{options_.timings};
  StepThread steps_{[this] { window_.wakeUp(); }};  // simulates on the CPU backend
  const std::thread::id ownThread_ = std::this_thread::get_id();
  Notice notice_;
  ViewerConfig config_, savedConfig_;
  ControlRequests requests_;
  Scene draft_;                       // a copy of the scene, which the panels edit
  bool draftHeld_ = false;            // a control is being dragged: the draft differs from the scene
  bool editContinues_ = false;        // the next edit is undone together with the last one
  std::optional<int> explicitSteps_;  // a frame, as they were before the implicit integrator
  std::string confirmed_;             // a file that the next Save may overwrite
  std::optional<std::string> sceneToOpen_;
  std::optional<std::string> lost_;  // why the context was lost
  std::string title_;
  double now_ = 0, pinsShownUntil_ = 0;  // [s] since the start
  int drawsLeft_ = drawsAfterInput;      // pictures that a paused window still draws after input
  double tempo_ = 1;                     // simulated seconds per second that are wanted
  double unpaced_ = 0;                   // time that pace_ does not know of yet [s]
  double lastDrawn_ = 0;                 // [s] since the start
  struct {
    double time = 0;  // [s] since the start
    ViewerWindow::Size size;
  } laidOut_;                // when controls were laid out last, and for which window
  double waitingSince_ = 0;  // [s] since the start
  bool stepping_ = false;    // the session is within a frame on this thread. Then, and while
  std::vector<std::function<void()>>
      waiting_;                       // steps_ is busy, what asks the session for something waits here
  std::optional<Scene> waitingEdit_;  // the newest of the panels, which waits likewise
  bool paused_ = false, stepAsked_ = false, showKeys_ = false;
  bool pausedByError_ = false;  // until the user pauses or goes on
  bool isLoading_ = false;      // there may be no scene yet
  bool dialogShown_ = false;    // in the last picture
};

}  // namespace clothsim

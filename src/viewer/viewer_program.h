// The program behind the window: what it holds, what can be asked of it, and a turn of its loop. viewer.cpp
// has the loop, viewer_actions.cpp what keys, mouse and panels ask for.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "viewer/compare_card.h"
#include "viewer/frame_timings.h"
#include "viewer/hands.h"
#include "viewer/open_scene.h"
#include "viewer/pace.h"
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

// Antialiasing as fine as the device draws at a fluent rate.
[[nodiscard]] RenderOptions renderOptions(const ViewerOptions& options);

class LapClock {
 public:
  // Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// What is left of a viewer whose device was lost.
struct Salvage {
  std::string source;            // of the scene, as -f was given
  Shared<Scene> loaded, edited;  // as the file had it, and as it was in the end
  Session::Past past;
  std::string reason;
};

class Viewer {
 public:
  // Shows the scene; or goes on with what was salvaged, on the CPU, from the start of its scene.
  Viewer(const Shared<Scene>& scene, const ViewerOptions& options, const std::optional<Salvage>& salvage);

  // Until the window is closed, or the device is lost.
  [[nodiscard]] std::optional<Salvage> run();

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
  void whenIdle(std::function<void()> deed);
  void onKey(const KeyStroke& stroke, bool repeated);
  void escape();
  void onPress(ViewerWindow::Button button, ViewerWindow::Cursor cursor, bool control, bool shift);
  void act(ViewerAction action);
  void actOnFile(ViewerAction action);

  void watchSteps();
  void warnOfPaths();

  // --- what can be asked for, by key or panel
  void switchBackend(const std::string& backend);
  void switchIntegrator();
  void nextShader();
  void edit(const Scene& scene, bool continues);
  void undo(bool again);
  void seek(int frame);
  void restart();
  void openScene(const std::string& source);
  // While the window says what is being loaded; closed meanwhile, the program ends at once.
  [[nodiscard]] std::unique_ptr<OpenScene> load(const std::string& source,
                                                const std::function<std::unique_ptr<OpenScene>()>& make);
  void saveSceneAs(const std::filesystem::path& path);
  void reloadShaders();
  void togglePanels();

  // --- a turn of the loop
  void turn();
  int simulate(double elapsed);
  [[nodiscard]] int stepFrames(int frames);
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
  [[nodiscard]] CoveredEdges coveredEdges() const;
  [[nodiscard]] bool isOverPicture(ViewerWindow::Cursor cursor) const;
  [[nodiscard]] Reach reach();
  [[nodiscard]] bool isIdle();

  static constexpr int drawsAfterInput = 3;
  static constexpr double noticeSeconds = 2.5, longNoticeSeconds = 8;
  void say(const std::string& text, double seconds = noticeSeconds) { notice_ = {text, seconds, false}; }
  void complain(const std::string& text) { notice_ = {text, longNoticeSeconds, true}; }
  // Something that may be impossible: then it says so, and the window goes on with whatever is unsaved in it.
  // Returns whether it was done.
  template <class Deed>
  bool attempt(Deed&& deed) {
    try {
      deed();
      return true;
    } catch (const gl::ContextLost& error) {
      lost_ = error.what();  // run() sees to it
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
  Hands hands_;
  PanelColumn column_;
  FieldWidgets widgets_;
  CompareCard compare_;
  PictureTaker taker_;
  Pace pace_{1.0 / 90};
  SpeedMeter meter_;
  LapClock clock_;
  FrameTimings timings_{options_.timings};
  Notice notice_;
  ViewerConfig config_, savedConfig_;
  Asked asked_;
  Scene draft_;                       // what the panels edit, a copy
  bool draftHeld_ = false;            // some control of theirs is held: the draft is ahead of the scene
  bool editContinues_ = false;        // the next edit belongs to the one before
  std::optional<int> explicitSteps_;  // a frame, before the implicit integrator chose its own
  std::string confirmed_;             // a file that the next Save may write over
  std::optional<std::string> sceneToOpen_;
  std::optional<std::string> lost_;  // why the device is
  std::string title_;
  double now_ = 0, pinsShownUntil_ = 0;         // [s] since the start
  int drawsLeft_ = drawsAfterInput;             // of a paused window, until controls have settled
  bool stepping_ = false;                       // the session is within a frame:
  std::vector<std::function<void()>> waiting_;  // input waits
  bool paused_ = false, stepAsked_ = false, showKeys_ = false;
};

}  // namespace clothsim

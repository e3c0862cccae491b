// The panels beside the picture: what each is given, what it may ask for, and the column they stand in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene_io/scene_io.h"
#include "session/session.h"
#include "viewer/panels/field_widgets.h"
#include "viewer/panels/measure_panel.h"
#include "viewer/viewer_config.h"
#include "viewer/viewer_keys.h"

namespace clothsim {

// What the panels of one frame ask the viewer to do.
struct PanelRequests {
  std::vector<ViewerAction> actions;       // as by their keys
  std::optional<std::string> openScene;    // by -f's rule
  std::optional<std::string> saveSceneAs;  // a path
  std::optional<std::string> backend;      // "cpu" or "gpu"
  bool resetScene = false;                 // to what was loaded
};

// What the panels show. `draft` is the scene with the edits of this frame.
struct PanelContext {
  Scene& draft;
  FieldWidgets& widgets;
  Session& session;
  ViewOptions& view;
  Vec3d lookedAt;  // where the camera looks: new colliders begin there [m]
  const std::string& sceneName;
  PanelRequests requests{};
};

void drawSimulationPanel(PanelContext& context);
void drawCollidersPanel(PanelContext& context);
void drawLookPanel(PanelContext& context);

// Opens, saves and resets scenes.
class ScenePanel {
 public:
  void draw(PanelContext& context);
  // The path that was opened or saved last, for the lines to begin with.
  void remember(const std::string& path);

 private:
  std::vector<BundledScene> bundled_;  // read when the panel is first open
  bool read_ = false;
  char open_[512] = "", save_[512] = "";
};

class PanelColumn {
 public:
  // The part of the window's width that the column takes [pixels].
  [[nodiscard]] static float width(float windowWidth, float em);

  void draw(PanelContext& context, ViewerConfig& config);

  [[nodiscard]] MeasurePanel& measures() { return measures_; }
  [[nodiscard]] ScenePanel& scenes() { return scenes_; }

 private:
  void drawPanel(PanelName panel, PanelContext& context);

  MeasurePanel measures_;
  ScenePanel scenes_;
};

}  // namespace clothsim

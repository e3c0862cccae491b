// The panels beside the picture: their input, what they ask the viewer to do, and the column that holds them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gl/texture.h"
#include "render/renderer.h"
#include "scene_io/scene_io.h"
#include "viewer/open_scene.h"
#include "viewer/panels/field_widgets.h"
#include "viewer/panels/measure_panel.h"
#include "viewer/viewer_config.h"
#include "viewer/viewer_keys.h"

namespace clothsim {

// What the panels ask the viewer to do in a frame.
struct PanelRequests {
  std::vector<ViewerAction> actions;       // the same as those of keys
  std::optional<std::string> openScene;    // a name or path as for -f
  std::optional<std::string> saveSceneAs;  // a path
  std::optional<std::string> backend;      // "cpu" or "gpu"
  std::optional<Quality> quality;          // of the picture
  bool resetScene = false;                 // back to the loaded scene
  bool startsAnew = false;                 // the scene, since springs and fabrics differ too much
  std::optional<std::size_t> chooseSolid;  // in the picture, by its index in scene.colliders
  bool saveCurves = false;                 // of the panel Measure, as CSV
  friend bool operator==(const PanelRequests&, const PanelRequests&) = default;
};

// What the panels show. `draft` is the scene with the edits of this frame.
struct PanelContext {
  Scene& draft;
  FieldWidgets& widgets;
  const SessionFacts& facts;
  std::string backend;
  ViewOptions& view;
  Vec3d lookedAt;  // target of the camera, where new colliders are placed [m]
  const std::string& sceneName;
  Quality quality;  // of the picture
  std::optional<std::size_t> chosenSolid{};
  PanelRequests requests{};
};

void drawClothPanel(PanelContext& context);
void drawSolverPanel(PanelContext& context);
void drawCollidersPanel(PanelContext& context);
void drawLookPanel(PanelContext& context);

// Opens, saves and resets scenes.
class ScenePanel {
 public:
  void draw(PanelContext& context);
  // Shows the path that was last saved in the line for it.
  void remember(const std::string& path);

 private:
  struct Card {
    BundledScene scene;
    gl::Texture picture;
  };

  void readScenes();
  void drawCards(PanelContext& context);

  std::vector<Card> cards_;         // of the bundled scenes
  std::vector<std::string> files_;  // scenes in the current folder
  bool read_ = false;               // both, when the panel is first opened
  char save_[512] = "";
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

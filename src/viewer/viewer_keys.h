// The table of all keys and mouse actions of the viewer. The F1 list, `--help` and the table in README.md are
// made from it, and the viewer looks up here what a key does.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace clothsim {

enum class ViewerAction {
  none,  // for mouse actions, and for keys that act while they are held
  pause,
  stepFrame,
  restart,
  stepBack,
  stepForward,
  toggleBackend,
  compareBackends,
  toggleIntegrator,
  slowMotion,
  nextShader,
  nextQuality,
  nextGizmo,
  resetCamera,
  viewFromFront,
  viewFromRight,
  viewFromTop,
  undo,
  redo,
  screenshot,
  recordClip,
  openFile,
  reloadScene,
  saveScene,
  saveRecording,
  toggleKeyList,
  toggleOverlay,
  togglePanels,
  largerText,
  smallerText,
  reloadShaders,
  quit
};

struct ViewerKey {
  std::string_view input;  // the label of the key, after Ctrl+ and Shift+
  std::string_view effect;
  ViewerAction action = ViewerAction::none;
};

// Keys that act while they are held.
inline constexpr std::string_view blowKey = "W", cutKey = "X";

inline constexpr std::array viewerKeys{
    ViewerKey{"Left drag", "on cloth: grab it; on a collider or a pin: move it; elsewhere: orbit"},
    ViewerKey{"Right drag", "pan (also Ctrl + left drag)"},
    ViewerKey{"Wheel", "zoom towards the cursor"},
    ViewerKey{"Shift+click", "pin the cloth here, or unpin it"},
    ViewerKey{blowKey, "hold: blow at what is under the cursor"},
    ViewerKey{cutKey, "hold and drag: cut the cloth"},
    ViewerKey{"G", "handles of the chosen collider or pins: move / turn (Ctrl: in steps)",
              ViewerAction::nextGizmo},
    ViewerKey{"Space", "reset the camera", ViewerAction::resetCamera},
    ViewerKey{"1", "look from the front; again: from behind", ViewerAction::viewFromFront},
    ViewerKey{"2", "look from the right; again: from the left", ViewerAction::viewFromRight},
    ViewerKey{"3", "look from above; again: from below", ViewerAction::viewFromTop},
    ViewerKey{"P", "pause / resume", ViewerAction::pause},
    ViewerKey{"N", "advance one frame while paused", ViewerAction::stepFrame},
    ViewerKey{"S", "slow motion: 1, 0.5, 0.25, 0.1 times real time", ViewerAction::slowMotion},
    ViewerKey{"R", "restart from frame 0", ViewerAction::restart},
    ViewerKey{"Left", "go back one frame", ViewerAction::stepBack},
    ViewerKey{"Right", "go forward one frame, after going back", ViewerAction::stepForward},
    ViewerKey{"B", "switch the backend: GPU / CPU", ViewerAction::toggleBackend},
    ViewerKey{"C", "compare the backends from here", ViewerAction::compareBackends},
    ViewerKey{"I", "next integrator: verlet, euler, implicit, bdf2", ViewerAction::toggleIntegrator},
    ViewerKey{"Tab", "next shading model", ViewerAction::nextShader},
    ViewerKey{"Q", "next quality of the picture: draft, normal, final", ViewerAction::nextQuality},
    ViewerKey{"Ctrl+Z", "undo the last change of a parameter, or move of a collider", ViewerAction::undo},
    ViewerKey{"Ctrl+Shift+Z", "redo it", ViewerAction::redo},
    ViewerKey{"Ctrl+P", "screenshot", ViewerAction::screenshot},
    ViewerKey{"Ctrl+R", "start / stop recording a clip", ViewerAction::recordClip},
    ViewerKey{"Ctrl+O", "open a scene or a mesh", ViewerAction::openFile},
    ViewerKey{"Ctrl+L", "load the scene's file anew", ViewerAction::reloadScene},
    ViewerKey{"Ctrl+S", "save the scene", ViewerAction::saveScene},
    ViewerKey{"Ctrl+Shift+S", "save your actions, for run --replay", ViewerAction::saveRecording},
    ViewerKey{"F1", "show / hide this list", ViewerAction::toggleKeyList},
    ViewerKey{"F2", "show / hide the overlay", ViewerAction::toggleOverlay},
    ViewerKey{"F3", "show / hide the panels", ViewerAction::togglePanels},
    ViewerKey{"Ctrl+=", "larger text", ViewerAction::largerText},
    ViewerKey{"Ctrl+-", "smaller text", ViewerAction::smallerText},
    ViewerKey{"F5", "reload the shaders", ViewerAction::reloadShaders},
    ViewerKey{"Esc", "close what is open over the picture, or quit", ViewerAction::quit},
};

// A key and the modifiers that are held with it.
struct KeyStroke {
  std::string key;  // as in the table: "P", "F1", "Left", "Space"
  bool control = false, shift = false;
  friend bool operator==(const KeyStroke&, const KeyStroke&) = default;
};

// Splits "Ctrl+Shift+Z" into key and modifiers.
[[nodiscard]] inline KeyStroke keyStroke(std::string_view input) {
  KeyStroke stroke;
  stroke.control = input.starts_with("Ctrl+");
  if (stroke.control) input.remove_prefix(5);
  stroke.shift = input.starts_with("Shift+");
  if (stroke.shift) input.remove_prefix(6);
  stroke.key = input;
  return stroke;
}

// Whether the action asks nothing of the simulation, and is done also while a frame is being simulated.
[[nodiscard]] inline bool isImmediate(ViewerAction action) {
  switch (action) {
    case ViewerAction::pause:
    case ViewerAction::resetCamera:
    case ViewerAction::viewFromFront:
    case ViewerAction::viewFromRight:
    case ViewerAction::viewFromTop:
    case ViewerAction::nextQuality:
    case ViewerAction::nextGizmo:
    case ViewerAction::openFile:
    case ViewerAction::slowMotion:
    case ViewerAction::toggleKeyList:
    case ViewerAction::toggleOverlay:
    case ViewerAction::togglePanels:
    case ViewerAction::largerText:
    case ViewerAction::smallerText:
    case ViewerAction::quit:
      return true;
    default:
      return false;
  }
}

[[nodiscard]] inline ViewerAction actionOf(const KeyStroke& stroke) {
  for (const ViewerKey& key : viewerKeys)
    if (key.action != ViewerAction::none && keyStroke(key.input) == stroke) return key.action;
  return ViewerAction::none;
}

}  // namespace clothsim

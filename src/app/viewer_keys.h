// The one table of what keys and mouse do in the viewer: the F1 list, `--help` and the README's table are
// made from it, and the viewer looks up here what a key means.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace clothsim {

enum class ViewerAction {
  none,  // what the mouse does, and keys that act for as long as they are held
  pause,
  stepFrame,
  restart,
  stepBack,
  stepForward,
  toggleBackend,
  compareBackends,
  toggleIntegrator,
  nextShader,
  resetCamera,
  undo,
  redo,
  screenshot,
  recordClip,
  saveScene,
  saveRecording,
  toggleKeyList,
  toggleOverlay,
  togglePanels,
  reloadShaders,
  quit
};

struct ViewerKey {
  std::string_view input;  // as printed on the key, with Ctrl+ and Shift+ before it
  std::string_view effect;
  ViewerAction action = ViewerAction::none;
};

// Keys that act for as long as they are held.
inline constexpr std::string_view blowKey = "W", cutKey = "X";

inline constexpr std::array viewerKeys{
    ViewerKey{"Left drag", "on cloth: grab it; on a solid: move it; beside them: orbit"},
    ViewerKey{"Right drag", "pan (or Ctrl and left drag)"},
    ViewerKey{"Wheel", "zoom towards the cursor"},
    ViewerKey{"Shift+click", "pin the cloth there, or let it go"},
    ViewerKey{blowKey, "hold: blow at what is under the cursor"},
    ViewerKey{cutKey, "hold and drag: cut the cloth"},
    ViewerKey{"Space", "camera back to where it was", ViewerAction::resetCamera},
    ViewerKey{"P", "pause, and go on", ViewerAction::pause},
    ViewerKey{"N", "one frame, while paused", ViewerAction::stepFrame},
    ViewerKey{"R", "restart from the beginning", ViewerAction::restart},
    ViewerKey{"Left", "look back: one frame earlier", ViewerAction::stepBack},
    ViewerKey{"Right", "one frame later, while looking back", ViewerAction::stepForward},
    ViewerKey{"B", "continue on the other backend: GPU or CPU", ViewerAction::toggleBackend},
    ViewerKey{"C", "compare the backends from here", ViewerAction::compareBackends},
    ViewerKey{"I", "continue with the next integrator: verlet, euler, implicit",
              ViewerAction::toggleIntegrator},
    ViewerKey{"Tab", "next shading model", ViewerAction::nextShader},
    ViewerKey{"Ctrl+Z", "undo the last change of a parameter", ViewerAction::undo},
    ViewerKey{"Ctrl+Shift+Z", "redo it", ViewerAction::redo},
    ViewerKey{"Ctrl+P", "screenshot", ViewerAction::screenshot},
    ViewerKey{"Ctrl+R", "record a clip, and end it", ViewerAction::recordClip},
    ViewerKey{"Ctrl+S", "save the scene", ViewerAction::saveScene},
    ViewerKey{"Ctrl+Shift+S", "save what was done by hand, for run --replay", ViewerAction::saveRecording},
    ViewerKey{"F1", "show or hide this list", ViewerAction::toggleKeyList},
    ViewerKey{"F2", "show or hide the overlay", ViewerAction::toggleOverlay},
    ViewerKey{"F3", "show or hide the panels", ViewerAction::togglePanels},
    ViewerKey{"F5", "load the shaders again", ViewerAction::reloadShaders},
    ViewerKey{"Esc", "quit", ViewerAction::quit},
};

// A key with what is held down beside it.
struct KeyStroke {
  std::string key;  // as in the table: "P", "F1", "Left", "Space"
  bool control = false, shift = false;
  friend bool operator==(const KeyStroke&, const KeyStroke&) = default;
};

// "Ctrl+Shift+Z" taken apart.
[[nodiscard]] inline KeyStroke keyStroke(std::string_view input) {
  KeyStroke stroke;
  stroke.control = input.starts_with("Ctrl+");
  if (stroke.control) input.remove_prefix(5);
  stroke.shift = input.starts_with("Shift+");
  if (stroke.shift) input.remove_prefix(6);
  stroke.key = input;
  return stroke;
}

[[nodiscard]] inline ViewerAction actionOf(const KeyStroke& stroke) {
  for (const ViewerKey& key : viewerKeys)
    if (key.action != ViewerAction::none && keyStroke(key.input) == stroke) return key.action;
  return ViewerAction::none;
}

}  // namespace clothsim

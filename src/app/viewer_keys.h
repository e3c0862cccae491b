// The one table of what keys and mouse do in the viewer: the F1 list, `--help` and the README's table are
// made from it, and the viewer looks up here what a key means.
#pragma once

#include <array>
#include <string_view>

namespace clothsim {

enum class ViewerAction {
  none,  // mouse movements, which are no single events
  pause,
  stepFrame,
  restart,
  toggleBackend,
  toggleIntegrator,
  resetCamera,
  toggleKeyList,
  toggleOverlay,
  quit
};

struct ViewerKey {
  std::string_view input;  // as printed on the key
  std::string_view effect;
  ViewerAction action = ViewerAction::none;
};

inline constexpr std::array viewerKeys{
    ViewerKey{"P", "pause, and go on", ViewerAction::pause},
    ViewerKey{"N", "one frame, while paused", ViewerAction::stepFrame},
    ViewerKey{"R", "restart from the beginning", ViewerAction::restart},
    ViewerKey{"B", "continue on the other backend: GPU or CPU", ViewerAction::toggleBackend},
    ViewerKey{"I", "continue with the other integrator: verlet or euler", ViewerAction::toggleIntegrator},
    ViewerKey{"Left drag", "orbit"},
    ViewerKey{"Right drag", "pan (or Ctrl and left drag)"},
    ViewerKey{"Wheel", "zoom towards the cursor"},
    ViewerKey{"Space", "camera back to where it was", ViewerAction::resetCamera},
    ViewerKey{"F1", "show or hide the list of keys", ViewerAction::toggleKeyList},
    ViewerKey{"F2", "show or hide the overlay", ViewerAction::toggleOverlay},
    ViewerKey{"Esc", "quit", ViewerAction::quit},
};

}  // namespace clothsim

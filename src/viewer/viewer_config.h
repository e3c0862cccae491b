// What the viewer stores between runs: which panel is open, and how large its text is. It is a small JSON
// file in the user's folder for configurations, written whole or not at all.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace clothsim {

enum class PanelName { scene, cloth, solver, colliders, look, measure };
inline constexpr std::array<std::string_view, 6> panelNames{"scene",     "cloth", "solver",
                                                            "colliders", "look",  "measure"};

[[nodiscard]] inline std::string_view nameOf(PanelName panel) {
  return panelNames[static_cast<std::size_t>(panel)];
}

inline constexpr double LEAST_TEXT_SIZE = 0.5, LARGEST_TEXT_SIZE = 2;

struct ViewerConfig {
  // None: chosen by the width of the window.
  std::optional<bool> showPanels;
  bool showOverlay = true;
  PanelName panel = PanelName::scene;  // that is open
  std::string folder;                  // that the open dialog showed last; empty: none
  double textSize = 1;                 // times the size that fits the window and the desktop, LEAST_TEXT_SIZE
                                       // to LARGEST_TEXT_SIZE
  friend bool operator==(const ViewerConfig&, const ViewerConfig&) = default;
};

// $XDG_CONFIG_HOME/clothsim/viewer.json or ~/.config/clothsim/viewer.json; empty where neither is set.
[[nodiscard]] std::filesystem::path viewerConfigPath();

struct LoadedConfig {
  ViewerConfig config;
  std::string notice;  // why the file was not used; "" when it was, or there is none
};
// Never throws: a file that cannot be read is ignored, with a notice.
[[nodiscard]] LoadedConfig loadViewerConfig(const std::filesystem::path& path);

// Creates the folders. Returns why the file could not be written, "" when it was.
[[nodiscard]] std::string saveViewerConfig(const ViewerConfig& config, const std::filesystem::path& path);

}  // namespace clothsim

// What the viewer stores between runs: which panels are open. It is a small JSON file in the user's folder
// for configurations, written whole or not at all.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace clothsim {

enum class PanelName { simulation, colliders, look, measure, scene };
inline constexpr std::array<std::string_view, 5> panelNames{"simulation", "colliders", "look", "measure",
                                                            "scene"};

struct ViewerConfig {
  // None: chosen by the width of the window.
  std::optional<bool> showPanels;
  bool showOverlay = true;
  std::array<bool, panelNames.size()> open{true, false, false, false, false};  // by the number of PanelName
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

#include "viewer/viewer_config.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largestFile = 64 * 1024;

// Reads a value if the key is there: a file of another version may lack keys.
void read(const nlohmann::json& object, const std::string& key, bool& value) {
  if (const auto found = object.find(key); found != object.end()) value = found->get<bool>();
}

ViewerConfig parse(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  (void)json.get_ref<const nlohmann::json::object_t&>();  // throws for anything but an object
  ViewerConfig config;
  if (json.contains("show_panels")) config.showPanels = json.at("show_panels").get<bool>();
  read(json, "show_overlay", config.showOverlay);
  if (const auto panel = json.find("panel"); panel != json.end()) {
    const auto& name = panel->get_ref<const std::string&>();
    for (std::size_t i = 0; i < panelNames.size(); ++i)  // a name of another version is passed over
      if (panelNames[i] == name) config.panel = static_cast<PanelName>(i);
  }
  if (const auto folder = json.find("folder"); folder != json.end())
    config.folder = folder->get<std::string>();
  if (const auto size = json.find("text_size"); size != json.end())
    config.textSize = std::clamp(size->get<double>(), LEAST_TEXT_SIZE, LARGEST_TEXT_SIZE);
  return config;
}

}  // namespace

fs::path viewerConfigPath() {
  const fs::path folder = userConfigFolder();
  return folder.empty() ? folder : folder / "viewer.json";
}

LoadedConfig loadViewerConfig(const fs::path& path) {
  std::error_code ignored;
  if (path.empty() || fs::status(path, ignored).type() == fs::file_type::not_found) return {};
  try {
    return {parse(readFile(path, largestFile)), ""};
  } catch (const nlohmann::json::exception&) {
    return {{}, path.string() + " is not a settings file of the viewer and is ignored"};
  } catch (const Error& error) {
    return {{}, std::string("The settings are ignored: ") + error.what()};
  }
}

std::string saveViewerConfig(const ViewerConfig& config, const fs::path& path) {
  nlohmann::ordered_json json;
  if (config.showPanels) json["show_panels"] = *config.showPanels;
  json["show_overlay"] = config.showOverlay;
  json["panel"] = std::string(nameOf(config.panel));
  json["text_size"] = config.textSize;
  if (!config.folder.empty()) json["folder"] = config.folder;
  const auto replaced = nlohmann::json::error_handler_t::replace;  // what is no UTF-8 in the name of a folder
  return saveInConfigFolder(path, json.dump(2, ' ', false, replaced) + "\n");
}

}  // namespace clothsim

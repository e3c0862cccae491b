#include "viewer/open_dialog.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "core/formatted.h"
#include "scene_io/scene_io.h"
#include "viewer/ui_frame.h"

namespace clothsim {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largestLook = 4 << 20;  // bytes of a scene that is read to tell what it is
constexpr int pageRows = 10;
// Between the clicks of a double one; a machine that draws slowly sees them some pictures apart.
constexpr double doubleClickSeconds = 0.5;
constexpr int doubleClickPictures = 8;

bool isPressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

std::string sizeText(std::uintmax_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " B";
  const double kilobytes = static_cast<double>(bytes) / 1000;
  return kilobytes < 1000 ? formatted("%.0f kB", kilobytes) : formatted("%.1f MB", kilobytes / 1000);
}

// A folder, a sheet with lines, or a mesh of triangles, before a name.
void drawFileSymbol(FileKind kind) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float s = em(), line = std::max(1.0f, 0.08f * s);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 accent = ImGui::GetColorU32(theme::accent), quiet = ImGui::GetColorU32(theme::quiet);
  const auto p = [&](float x, float y) { return ImVec2{at.x + x * s, at.y + y * s}; };
  if (kind == FileKind::folder) {
    list.AddRectFilled(p(0.08f, 0.18f), p(0.5f, 0.4f), accent, 0.1f * s);
    list.AddRectFilled(p(0.08f, 0.28f), p(0.98f, 0.9f), accent, 0.1f * s);
  } else if (kind == FileKind::scene) {
    list.AddRect(p(0.2f, 0.12f), p(0.86f, 0.94f), quiet, 0.1f * s, 0, line);
    for (const float y : {0.36f, 0.54f, 0.72f}) list.AddLine(p(0.36f, y), p(0.7f, y), quiet, line);
  } else {
    list.AddTriangle(p(0.1f, 0.88f), p(0.53f, 0.14f), p(0.96f, 0.88f), quiet, line);
    list.AddTriangle(p(0.315f, 0.51f), p(0.745f, 0.51f), p(0.53f, 0.88f), quiet, line);
  }
  ImGui::Dummy({1.25f * s, s});
  ImGui::SameLine(0, 0);
}

}  // namespace

void OpenDialog::open(const fs::path& folder) {
  std::error_code ignored;
  fs::path place = fs::absolute(folder.empty() ? fs::path(".") : folder, ignored).lexically_normal();
  while (!fs::is_directory(place, ignored) && place.has_relative_path()) place = place.parent_path();
  goTo(place);
  open_ = true;
}

void OpenDialog::openAt(const fs::path& file) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(file, ignored).lexically_normal();
  open(whole.parent_path());
  goTo(whole.parent_path(), whole.filename().string());
}

void OpenDialog::close() {
  open_ = false;
  list_ = {};
  shown_.clear();
  chosen_ = -1;
  decided_.reset();
}

// Beginning with a choice, of the name or else the first entry.
void OpenDialog::goTo(const fs::path& folder, const std::string& chosen) {
  folder_ = folder;
  if (folder_.has_relative_path() && !folder_.has_filename()) folder_ = folder_.parent_path();  // "/a/"
  list_ = listFolder(folder_);
  words_[0] = '\0';
  lastClick_ = {};
  ++lineNumber_;  // a line that has the keyboard keeps its words otherwise
  filter();
  fault_ = list_.fault;
  for (int i = 0; i < static_cast<int>(shown_.size()); ++i)
    if (list_.entries[static_cast<std::size_t>(shown_[static_cast<std::size_t>(i)])].name == chosen)
      choose(i);
}

const FolderEntry* OpenDialog::chosen() const {
  if (chosen_ < 0 || chosen_ >= static_cast<int>(shown_.size())) return nullptr;
  return &list_.entries[static_cast<std::size_t>(shown_[static_cast<std::size_t>(chosen_)])];
}

// Says at once what a scene is, or what is wrong with it.
void OpenDialog::choose(int entry) {
  chosen_ = std::clamp(entry, shown_.empty() ? -1 : 0, static_cast<int>(shown_.size()) - 1);
  followsChoice_ = true;
  about_.clear();
  fault_ = list_.fault;
  const FolderEntry* file = chosen();
  if (file == nullptr || file->kind != FileKind::scene || file->bytes > largestLook) return;
  try {
    about_ = loadScene(folder_ / file->name).description;
  } catch (const Error& error) {
    fault_ = error.what();
  }
}

void OpenDialog::filter() {
  shown_.clear();
  const std::string words = words_.data();
  for (std::size_t i = 0; i < list_.entries.size(); ++i)
    if (contains(list_.entries[i].name, words)) shown_.push_back(static_cast<int>(i));
  choose(0);
}

std::optional<OpenChoice> OpenDialog::draw() {
  if (!open_) return std::nullopt;
  if (!ImGui::IsPopupOpen("open")) ImGui::OpenPopup("open");  // also after the window has said what it loads
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(46 * em(), 0.94f * window.x), std::min(32 * em(), 0.94f * window.y)});
  if (!ImGui::BeginPopupModal("open", nullptr,
                              ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav))
    return std::nullopt;
  takeKeys();
  if (!open_) {
    ImGui::EndPopup();
    return std::nullopt;
  }
  titleText("Open a scene or a mesh");
  drawPlaces();
  drawLine();
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float foot = ImGui::GetFrameHeightWithSpacing() + 2 * line + ImGui::GetStyle().ItemSpacing.y;
  drawList(ImGui::GetContentRegionAvail().y - foot);
  ImGui::BeginChild("about", {0, 2 * line}, false, ImGuiWindowFlags_NoNav);
  if (!fault_.empty())
    wrappedText(fault_, theme::alert);
  else
    wrappedText(about_, theme::quiet);
  ImGui::EndChild();
  drawButtons();
  ImGui::EndPopup();
  return std::exchange(decided_, std::nullopt);
}

// The folder, part by part, and ways to others.
void OpenDialog::drawPlaces() {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.2f * em(), 0.35f * em()});
  std::optional<fs::path> wanted;
  const auto button = [&](const char* label, const fs::path& to, const char* tip) {
    if (ImGui::SmallButton(label)) wanted = to;
    helpTip(tip);
    ImGui::SameLine();
  };
  if (const char* home = std::getenv("HOME")) button("Home", home, home);
  std::error_code ignored;
  button("Here", fs::current_path(ignored), "The folder that the program was started in");
  button("Bundled", resourceRoot() / "assets" / "scenes", "The scenes that came with the program");
  ImGui::NewLine();
  // Of a long path the last parts.
  std::vector<fs::path> parts;
  for (fs::path part = folder_; parts.size() < 12; part = part.parent_path()) {
    parts.push_back(part);
    if (!part.has_relative_path()) break;
  }
  float room = ImGui::GetContentRegionAvail().x - 2 * em();
  std::size_t count = 0;
  while (count < parts.size()) {
    const std::string name = parts[count].filename().string();
    room -= ImGui::CalcTextSize(name.c_str()).x + 1.4f * em();
    if (room < 0 && count > 0) break;
    ++count;
  }
  for (std::size_t i = count; i-- > 0;) {
    const bool isRoot = !parts[i].has_relative_path();
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton(isRoot ? "/" : parts[i].filename().c_str())) wanted = parts[i];
    ImGui::PopID();
    ImGui::SameLine();
    if (i > 0 && !isRoot) {
      quietText("/");
      ImGui::SameLine();
    }
  }
  ImGui::NewLine();
  ImGui::PopStyleVar();
  if (wanted) goTo(*wanted);
}

// For words to look for, or a path. It has the keyboard, so that one may type at once.
void OpenDialog::drawLine() {
  if (!ImGui::IsAnyItemActive() && !ImGui::IsMouseDown(0)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::PushID(lineNumber_);
  const bool entered = ImGui::InputTextWithHint("##words", "type part of a name, or a path", words_.data(),
                                                words_.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  const bool edited = ImGui::IsItemEdited();
  ImGui::PopID();
  if (entered) return enter();
  if (edited) filter();
}

void OpenDialog::drawList(float height) {
  ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::column);
  ImGui::BeginChild("files", {0, height}, true, ImGuiWindowFlags_NoNav);
  std::optional<int> clicked;
  if (shown_.empty() && list_.fault.empty())
    quietText(words_[0] == '\0' ? "No folders, scenes (.json) or meshes (.obj) here"
                                : "Nothing has such a name here");
  const bool hasRoom = ImGui::GetContentRegionAvail().x > 26 * em();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown_.size()), ImGui::GetTextLineHeightWithSpacing());
  if (followsChoice_ && chosen_ >= 0) {
    const float row = ImGui::GetTextLineHeightWithSpacing(), top = static_cast<float>(chosen_) * row;
    const float seen = ImGui::GetScrollY(), page = ImGui::GetWindowHeight() - 2 * row;
    if (top < seen) ImGui::SetScrollY(top);
    if (top > seen + page) ImGui::SetScrollY(top - page);
  }
  followsChoice_ = false;
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const FolderEntry& entry = list_.entries[static_cast<std::size_t>(shown_[static_cast<std::size_t>(i)])];
      ImGui::PushID(i);
      const float left = ImGui::GetCursorPosX();
      const bool isChosen = i == chosen_;
      ImGui::PushStyleColor(ImGuiCol_Header, theme::fill);
      ImGui::PushStyleColor(ImGuiCol_HeaderHovered,
                            isChosen ? theme::fill : ImGui::GetStyle().Colors[ImGuiCol_Header]);
      if (ImGui::Selectable("##entry", isChosen)) {
        clicked = i;
      }
      ImGui::PopStyleColor(2);
      ImGui::SameLine();
      ImGui::SetCursorPosX(left);
      drawFileSymbol(entry.kind);
      coloredText(entry.name, theme::plain);
      if (hasRoom) {
        const float right = ImGui::GetContentRegionMax().x;
        const std::string size = entry.kind == FileKind::folder ? "" : sizeText(entry.bytes);
        ImGui::SameLine(right - 9.5f * em() - ImGui::CalcTextSize(size.c_str()).x);
        quietText(size);
        ImGui::SameLine(right - ImGui::CalcTextSize(entry.changed.c_str()).x);
        quietText(entry.changed);
      }
      ImGui::PopID();
    }
  ImGui::EndChild();
  ImGui::PopStyleColor();
  if (!clicked) return;
  const Click now{*clicked, ImGui::GetTime(), ImGui::GetFrameCount()},
      before = std::exchange(lastClick_, now);
  const bool isDouble = now.entry == before.entry && (now.time - before.time < doubleClickSeconds ||
                                                      now.picture - before.picture < doubleClickPictures);
  choose(*clicked);
  if (isDouble) enter();
}

void OpenDialog::drawButtons() {
  const FolderEntry* file = chosen();
  const float width = 8 * em(), gap = ImGui::GetStyle().ItemSpacing.x;
  const bool isMesh = file != nullptr && file->kind == FileKind::mesh;
  const float all = (isMesh ? 3 : 2) * width + (isMesh ? 2 : 1) * gap;
  quietText("Enter opens, Esc closes");
  ImGui::SameLine(std::max(0.0f, ImGui::GetContentRegionMax().x - all));
  if (isMesh) {
    if (ImGui::Button("As cloth", {width, 0})) decide(OpenChoice::Use::cloth);
    helpTip("Cotton with the shape of the mesh falls over a ball (Enter).");
    ImGui::SameLine();
    if (ImGui::Button("As a collider", {width, 0})) decide(OpenChoice::Use::solid);
    helpTip("Puts the mesh, which must be closed, into the scene that is open.");
  } else if (ImGui::Button("Open", {width, 0})) {
    enter();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {width, 0})) close();
}

void OpenDialog::takeKeys() {
  if (isPressed(ImGuiKey_Escape)) return close();
  if (isPressed(ImGuiKey_DownArrow)) choose(chosen_ + 1);
  if (isPressed(ImGuiKey_UpArrow)) choose(chosen_ - 1);
  if (isPressed(ImGuiKey_PageDown)) choose(chosen_ + pageRows);
  if (isPressed(ImGuiKey_PageUp)) choose(chosen_ - pageRows);
  if (isPressed(ImGuiKey_Backspace) && words_[0] == '\0' && folder_.has_relative_path())
    goTo(folder_.parent_path(), folder_.filename().string());
}

// Opens what is typed as a path, else the chosen entry.
void OpenDialog::enter() {
  const std::string typed = words_.data();
  if (typed.find('/') != std::string::npos || typed == "~" || typed == "..") {
    const char* home = std::getenv("HOME");
    const fs::path path =
        typed.starts_with('~') && home != nullptr ? fs::path(home + typed.substr(1)) : folder_ / typed;
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return goTo(path.lexically_normal());
    if (!fs::exists(path, ignored)) {
      fault_ = path.string() + " is not there";
      return;
    }
    goTo(path.parent_path().lexically_normal(), path.filename().string());
    if (chosen() == nullptr || chosen()->name != path.filename().string()) {
      fault_ = path.string() + " is neither a scene (.json) nor a mesh (.obj)";
      return;
    }
  }
  const FolderEntry* file = chosen();
  if (file == nullptr) return;
  if (file->kind == FileKind::folder) return goTo(folder_ / file->name);
  decide(file->kind == FileKind::mesh ? OpenChoice::Use::cloth : OpenChoice::Use::scene);
}

void OpenDialog::decide(OpenChoice::Use use) {
  if (const FolderEntry* file = chosen()) decided_ = OpenChoice{(folder_ / file->name).string(), use};
}

}  // namespace clothsim

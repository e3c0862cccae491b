// The window in which a file is chosen: folders, scenes and meshes. Keys: the arrows choose, Enter opens,
// Backspace goes up, letters look for names, Esc closes. What is typed may also be a path.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/folder_list.h"

namespace clothsim {

struct OpenChoice {
  enum class Use {
    scene,
    cloth,
    solid
  };  // of a mesh: as cloth in a scene of its own, or in the one that is open
  std::string path;
  Use use = Use::scene;
  friend bool operator==(const OpenChoice&, const OpenChoice&) = default;
};

class OpenDialog {
 public:
  // Shows the folder, or the nearest one above it that is there.
  void open(const std::filesystem::path& folder);
  // Shows the folder of a file, which is chosen.
  void openAt(const std::filesystem::path& file);
  void close();
  [[nodiscard]] bool isOpen() const { return open_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // What was wrong with the file that was to be opened.
  void complain(const std::string& fault) { fault_ = fault; }

  // To be called between UiFrame::begin() and end(). Returns the file that the user has decided on; the
  // dialog stays open until it is loaded.
  [[nodiscard]] std::optional<OpenChoice> draw();

 private:
  void goTo(const std::filesystem::path& folder, const std::string& chosen = "");
  void choose(int entry);
  void filter();
  void drawPlaces();
  void drawLine();
  void drawList(float height);
  void drawButtons();
  void takeKeys();
  void enter();
  void decide(OpenChoice::Use use);
  [[nodiscard]] const FolderEntry* chosen() const;

  bool open_ = false, followsChoice_ = false;
  std::filesystem::path folder_;
  FolderList list_;
  std::vector<int> shown_;  // of the list's entries, those that the words leave
  int chosen_ = -1;         // in shown_
  std::string about_;       // the chosen scene: what it says of itself
  std::string fault_;       // of the folder, of the chosen file, or of loading it
  std::array<char, 1024> words_{};
  int lineNumber_ = 0;
  struct Click {
    int entry = -1;
    double time = 0;  // [s]
    int picture = 0;
  } lastClick_;
  std::optional<OpenChoice> decided_;
};

}  // namespace clothsim

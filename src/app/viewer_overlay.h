// What the viewer writes over the picture: a panel of facts, the list of keys, and a line on what has just
// happened.
#pragma once

#include <string>
#include <vector>

struct GLFWwindow;

namespace clothsim {

struct OverlayFacts {
  std::string title;  // of the scene
  struct Row {
    std::string label, value;
    bool alert = false;  // drawn in the colour that asks for attention
  };
  std::vector<Row> rows;
  std::string notice;  // shown at the bottom; "" for none
  bool noticeIsError = false;
};

class ViewerOverlay {
 public:
  // After the window's own input callbacks, which it lets through.
  explicit ViewerOverlay(GLFWwindow* window);
  ~ViewerOverlay();
  ViewerOverlay(const ViewerOverlay&) = delete;
  ViewerOverlay& operator=(const ViewerOverlay&) = delete;

  [[nodiscard]] bool wantsMouse() const;
  // Draws over what is in the window's framebuffer.
  void draw(const OverlayFacts& facts, double textScale, bool showPanel, bool showKeys);

 private:
  void loadFonts(double textScale);

  double textScale_ = 0;
};

}  // namespace clothsim

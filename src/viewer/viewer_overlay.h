// What the viewer writes over the picture: a panel of facts, the list of keys, and a line on what has just
// happened. Between UiFrame::begin() and draw().
#pragma once

#include <string>
#include <vector>

namespace clothsim {

struct OverlayFacts {
  std::string title;  // of the scene
  struct Row {
    std::string label, value;
    bool alert = false;      // drawn in the colour that asks for attention
    bool important = false;  // shown in a small picture, too
  };
  std::vector<Row> rows;
};

// The part of the window that shows the picture; the rest belongs to the panels.
struct PictureArea {
  float width = 0, height = 0;  // from the top left [pixels]
};

// In a narrow picture only the rows that are `important`.
void drawFacts(const OverlayFacts& facts, PictureArea area);
void drawKeyList(PictureArea area);
// All of the window, while nothing else can be shown.
void drawLoading(const std::string& name);
// At the bottom of the picture, `lift` pixels up.
void drawNotice(const std::string& words, bool isError, PictureArea area, float lift);

}  // namespace clothsim

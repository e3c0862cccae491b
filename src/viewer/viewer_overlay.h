// What the viewer writes over the picture: facts about the simulation, the list of keys, and notices. To be
// called between UiFrame::begin() and end().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/pace_advice.h"

namespace clothsim {

struct OverlayFacts {
  std::string title;  // of the scene
  struct Row {
    std::string label, value;
    bool alert = false;      // drawn in the colour of warnings
    bool important = false;  // also shown in a small picture
  };
  std::vector<Row> rows;
};

// The part of the window that shows the picture; the panels take the rest.
struct PictureArea {
  float width = 0, height = 0;  // from the top left [pixels]
};

// A narrow picture shows only the rows that are `important`.
void drawFacts(const OverlayFacts& facts, PictureArea area);
void drawKeyList(PictureArea area);
// Fills the window while a scene is loaded.
void drawLoading(const std::string& name);
struct DrawnAdvice {
  std::optional<PaceRemedy> pressed;
  float height = 0;  // [pixels]
};
// What costs most, with a button for each remedy and the pace that it was seen to bring, of `tempo` that are
// wanted; `lift` pixels above the bottom of the picture.
[[nodiscard]] DrawnAdvice drawAdvice(const PaceAdvice& advice, double tempo, PictureArea area, float lift);
// Stands `lift` pixels above the bottom of the picture.
void drawNotice(const std::string& words, bool isError, PictureArea area, float lift);

}  // namespace clothsim

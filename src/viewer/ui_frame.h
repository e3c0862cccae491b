// Dear ImGui in the viewer's window: its context, font and theme, and a frame of controls at a time. All
// layout is in units of em(), so that one number scales it.
#pragma once

#include <imgui.h>

#include <array>
#include <optional>
#include <string_view>

#include "viewer/input_queue.h"
#include "viewer/kept_panels.h"

struct GLFWwindow;

namespace clothsim {

namespace theme {
inline const ImVec4 plain{0.93f, 0.94f, 0.95f, 1}, quiet{0.62f, 0.66f, 0.71f, 1},
    alert{1.00f, 0.76f, 0.36f, 1}, good{0.55f, 0.83f, 0.62f, 1}, accent{0.42f, 0.67f, 0.86f, 1},
    fill{0.205f, 0.335f, 0.445f, 1}, fillHovered{0.235f, 0.375f, 0.495f, 1};
inline const ImVec4 glass{0.07f, 0.08f, 0.10f, 0.72f},  // over the picture
    sheet{0.085f, 0.095f, 0.115f, 0.96f},               // for text
    column{0.105f, 0.115f, 0.137f, 1}, keyCap{0.22f, 0.245f, 0.29f, 1};
inline const std::array<ImVec4, 3> axes{
    // x, y, z
    {{0.86f, 0.37f, 0.40f, 1}, {0.50f, 0.74f, 0.36f, 1}, {0.36f, 0.58f, 0.90f, 1}}};
}  // namespace theme

class UiFrame {
 public:
  // To be made after the callbacks of the window are set, which it keeps. Keys and clicks come from `input`,
  // which these callbacks fill.
  UiFrame(GLFWwindow* window, InputQueue& input);
  ~UiFrame();
  UiFrame(const UiFrame&) = delete;
  UiFrame& operator=(const UiFrame&) = delete;

  void begin(double textScale);
  void end();
  // Draws the controls made between begin() and end(), of the last picture or (`isNew`) of this one: on a
  // software renderer those right of the picture as they were kept, where nothing has changed
  // (kept_panels.h).
  void draw(float pictureWidth, bool isNew);
  [[nodiscard]] bool isHeld() const;  // a mouse button, or a control

  [[nodiscard]] bool wantsMouse() const;  // as of the last frame
  [[nodiscard]] bool hasPopup() const;    // whether a list or a colour picker is open
  [[nodiscard]] bool wantsKeys() const;   // whether the user is typing
  void closePopups();

 private:
  void loadFonts(double textScale);
  std::optional<ImVec2> passInputOn();

  GLFWwindow* window_;
  InputQueue& input_;
  double textScale_ = 0;
  KeptPanels kept_;
};

// The height of a line of text [pixels].
[[nodiscard]] inline float em() { return ImGui::GetFontSize(); }

void coloredText(std::string_view words, const ImVec4& color);
void quietText(std::string_view words);
[[nodiscard]] float widthOf(std::string_view words);
// How large text may be that needs so much of a line, compared with what it is: .7 at least.
[[nodiscard]] float fittingScale(float needed);
void titleText(std::string_view words);  // in the larger typeface
// Text that is wrapped at the edge of the window.
void wrappedText(std::string_view words, const ImVec4& color);
// A tip that is shown while the mouse rests on the last control.
void helpTip(std::string_view words);
// A button that is highlighted while it is on. True when it was changed.
bool toggleButton(const char* label, bool& on, float width);
// A button as wide as its column. True when it was clicked.
[[nodiscard]] bool wideButton(const char* label);
// A row of buttons of which one is on. Returns its index.
[[nodiscard]] int segmentedButtons(const char* id, const char* const* labels, int count, int chosen);

}  // namespace clothsim

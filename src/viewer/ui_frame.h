// Dear ImGui in the viewer's window: its context, typeface and theme, and one frame of controls at a time.
// Layout everywhere is in units of em(), so that one number scales all of it.
#pragma once

#include <imgui.h>

#include <optional>
#include <string_view>

#include "viewer/input_queue.h"

struct GLFWwindow;

namespace clothsim {

namespace theme {
inline const ImVec4 plain{0.93f, 0.94f, 0.95f, 1}, quiet{0.62f, 0.66f, 0.71f, 1},
    alert{1.00f, 0.76f, 0.36f, 1}, good{0.55f, 0.83f, 0.62f, 1}, accent{0.42f, 0.67f, 0.86f, 1},
    fill{0.205f, 0.335f, 0.445f, 1}, fillHovered{0.235f, 0.375f, 0.495f, 1};
inline const ImVec4 glass{0.07f, 0.08f, 0.10f, 0.72f},  // over the picture
    sheet{0.085f, 0.095f, 0.115f, 0.96f},               // what is to be read
    column{0.105f, 0.115f, 0.137f, 1}, keyCap{0.22f, 0.245f, 0.29f, 1};
}  // namespace theme

class UiFrame {
 public:
  // After the window's own input callbacks, which it lets through. Keys and clicks come from `input`, which
  // they fill.
  UiFrame(GLFWwindow* window, InputQueue& input);
  ~UiFrame();
  UiFrame(const UiFrame&) = delete;
  UiFrame& operator=(const UiFrame&) = delete;

  void begin(double textScale);
  void end();
  void draw();  // what lies between begin() and end(), over what is in the window's framebuffer

  [[nodiscard]] bool wantsMouse() const;  // as of the last frame
  [[nodiscard]] bool hasPopup() const;    // a list or a colour picker
  [[nodiscard]] bool wantsKeys() const;   // somebody is typing

 private:
  void loadFonts(double textScale);
  std::optional<ImVec2> passInputOn();

  GLFWwindow* window_;
  InputQueue& input_;
  double textScale_ = 0;
};

// The height of a line of text [pixels].
[[nodiscard]] inline float em() { return ImGui::GetFontSize(); }

void coloredText(std::string_view words, const ImVec4& color);
void quietText(std::string_view words);
void titleText(std::string_view words);  // in the larger typeface
// Wrapped at the edge of the window.
void wrappedText(std::string_view words, const ImVec4& color);
// Shown while the mouse rests on the last control.
void helpTip(std::string_view words);
// A number as a bar that is filled up to it, with the text upon it; typed into after Ctrl+click. As wide as
// the next item. `format` as ImGui::SliderScalar has it. True when the number was changed.
bool barSlider(ImGuiDataType type, void* value, double low, double high, const char* format,
               bool logarithmic);
// A button that is lit while it is on. True when it was changed.
bool toggleButton(const char* label, bool& on, float width);
// As wide as its column allows. True when it is clicked.
[[nodiscard]] bool wideButton(const char* label);
// A row of buttons of which one is chosen; returns the chosen one.
[[nodiscard]] int segmentedButtons(const char* id, const char* const* labels, int count, int chosen);

}  // namespace clothsim

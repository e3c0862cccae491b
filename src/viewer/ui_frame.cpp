#include "viewer/ui_frame.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "gl/context.h"
#include "output/picture_font.h"

namespace clothsim {
namespace {

constexpr float textSize = 16, titleSize = 22;  // on an ordinary screen [pixels]

// Adds the program's font in a size [pixels], or Dear ImGui's own bitmap font where the system has none.
void addTypeface(ImFontAtlas& atlas, float size) {
  // Latin letters, and punctuation: dashes, ellipsis, minus.
  static constexpr ImWchar characters[] = {0x20, 0xff, 0x2010, 0x2026, 0x2212, 0x2212, 0};
  ImFontConfig config;
  config.SizePixels = size;
  const std::filesystem::path file = typefaceFile();
  if (file.empty())
    atlas.AddFontDefault(&config);
  else
    atlas.AddFontFromFileTTF(file.c_str(), size, nullptr, characters);
}

// A dark theme: surfaces differ little, and the accent colour marks what is on and what is being dragged.
void colorize(ImVec4* colors) {
  const auto surface = [](float light, float alpha = 1) {
    return ImVec4(light, light * 1.09f, light * 1.28f, alpha);
  };
  const auto accent = [](float light, float alpha = 1) {
    return ImVec4(0.42f * light, 0.67f * light, 0.86f * light, alpha);
  };
  colors[ImGuiCol_Text] = theme::plain;
  colors[ImGuiCol_TextDisabled] = theme::quiet;
  colors[ImGuiCol_WindowBg] = theme::column;
  colors[ImGuiCol_PopupBg] = theme::sheet;
  colors[ImGuiCol_Border] = surface(0.25f, 0.6f);
  colors[ImGuiCol_FrameBg] = surface(0.165f);
  colors[ImGuiCol_FrameBgHovered] = surface(0.205f);
  colors[ImGuiCol_FrameBgActive] = surface(0.225f);
  colors[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  colors[ImGuiCol_ScrollbarGrab] = surface(0.24f);
  colors[ImGuiCol_ScrollbarGrabHovered] = surface(0.30f);
  colors[ImGuiCol_ScrollbarGrabActive] = surface(0.36f);
  colors[ImGuiCol_CheckMark] = theme::accent;
  colors[ImGuiCol_SliderGrab] = accent(0.82f);
  colors[ImGuiCol_SliderGrabActive] = theme::accent;
  colors[ImGuiCol_Button] = surface(0.20f);
  colors[ImGuiCol_ButtonHovered] = surface(0.26f);
  colors[ImGuiCol_ButtonActive] = accent(0.60f);
  colors[ImGuiCol_Header] = surface(0.155f);
  colors[ImGuiCol_HeaderHovered] = surface(0.20f);
  colors[ImGuiCol_HeaderActive] = surface(0.24f);
  colors[ImGuiCol_Separator] = surface(0.20f);
  colors[ImGuiCol_PlotLines] = theme::accent;
  colors[ImGuiCol_TextSelectedBg] = accent(0.55f, 0.6f);
  colors[ImGuiCol_NavHighlight] = accent(0.8f);
  colors[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.45f};
}

ImGuiStyle styleFor(float scale) {
  ImGuiStyle style;
  colorize(style.Colors);
  style.WindowRounding = 10;
  style.FrameRounding = 5;
  style.GrabRounding = 4;
  style.PopupRounding = 8;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.WindowPadding = {14, 12};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {4, 3};
  style.ScrollbarSize = 11;
  style.GrabMinSize = 12;
  style.IndentSpacing = 14;
  style.WindowMinSize = {8, 8};
  style.ScaleAllSizes(scale);
  return style;
}

ImFont* titleFont() { return ImGui::GetIO().Fonts->Fonts.back(); }

void textUnformatted(std::string_view words) {
  ImGui::TextUnformatted(words.data(), words.data() + words.size());
}

// Whether a number is being typed, of which Dear ImGui would leave out a comma: 1,5 would be 15.
bool isTypingNumber() {
  const ImGuiID active = ImGui::GetActiveID();
  return active != 0 && ImGui::TempInputIsActive(active);
}

}  // namespace

UiFrame::UiFrame(GLFWwindow* window, InputQueue& input) : window_(window), input_(input) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // no file imgui.ini in the current folder
  io.LogFilename = nullptr;
  // Dear ImGui must get keys and clicks only through the queue, since it reads them once a frame.
  const GLFWkeyfun onKey = glfwSetKeyCallback(window, nullptr);
  const GLFWcharfun onCharacter = glfwSetCharCallback(window, nullptr);
  const GLFWmousebuttonfun onButton = glfwSetMouseButtonCallback(window, nullptr);
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  glfwSetKeyCallback(window, onKey);
  glfwSetCharCallback(window, onCharacter);
  glfwSetMouseButtonCallback(window, onButton);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

// Returns where a button was pressed or released.
std::optional<ImVec2> UiFrame::passInputOn() {
  std::optional<ImVec2> clickedAt;
  for (const InputEvent& event : input_.takeFrame()) {
    switch (event.kind) {
      case InputEvent::Kind::key:
        ImGui_ImplGlfw_KeyCallback(window_, event.code, event.scancode, event.action, event.mods);
        break;
      case InputEvent::Kind::character:
        ImGui_ImplGlfw_CharCallback(
            window_, event.code == ',' && isTypingNumber() ? '.' : static_cast<unsigned int>(event.code));
        break;
      case InputEvent::Kind::button:
        ImGui_ImplGlfw_MouseButtonCallback(window_, event.code, event.action, event.mods);
        clickedAt = {static_cast<float>(event.x), static_cast<float>(event.y)};
        break;
    }
  }
  return clickedAt;
}

UiFrame::~UiFrame() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

bool UiFrame::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool UiFrame::hasPopup() const {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}
bool UiFrame::wantsKeys() const { return ImGui::GetIO().WantTextInput; }
bool UiFrame::isHeld() const { return ImGui::IsAnyMouseDown() || ImGui::IsAnyItemActive(); }

void UiFrame::closePopups() {
  if (hasPopup()) ImGui::ClosePopupToLevel(0, false);
  ImGui::GetIO().WantTextInput = false;  // a key may follow before the next frame
}

void UiFrame::loadFonts(double textScale) {
  textScale_ = textScale;
  const auto scale = static_cast<float>(textScale);
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  for (const float size : {textSize, titleSize}) addTypeface(*io.Fonts, std::round(size * scale));
  kept_.forget();
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  ImGui::GetStyle() = styleFor(scale);
}

void UiFrame::begin(double textScale) {
  if (textScale != textScale_) loadFonts(textScale);
  ImGui_ImplOpenGL3_NewFrame();
  const std::optional<ImVec2> clickedAt = passInputOn();
  ImGui_ImplGlfw_NewFrame();
  if (clickedAt) ImGui::GetIO().MousePos = *clickedAt;  // the cursor may have moved since
  ImGui::NewFrame();
}

void UiFrame::end() {
  ImGui::ErrorCheckEndFrameRecover(nullptr);  // closes windows that an exception has left open
  ImGui::Render();
}

void UiFrame::draw(float pictureWidth, bool isNew) {
  ImDrawData& data = *ImGui::GetDrawData();
  gl::currentContextInfo().software ? kept_.draw(data, pictureWidth, isNew)
                                    : ImGui_ImplOpenGL3_RenderDrawData(&data);
}

void coloredText(std::string_view words, const ImVec4& color) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  textUnformatted(words);
  ImGui::PopStyleColor();
}

void quietText(std::string_view words) { coloredText(words, theme::quiet); }

float widthOf(std::string_view words) {
  return ImGui::CalcTextSize(words.data(), words.data() + words.size()).x;
}

float fittingScale(float needed) {
  return std::clamp(ImGui::GetContentRegionAvail().x / std::max(needed, 1.0f), 0.7f, 1.0f);
}

void titleText(std::string_view words) {
  ImGui::PushFont(titleFont());
  coloredText(words, theme::plain);
  ImGui::PopFont();
}

void wrappedText(std::string_view words, const ImVec4& color) {
  ImGui::PushTextWrapPos(0);
  coloredText(words, color);
  ImGui::PopTextWrapPos();
}

void helpTip(std::string_view words) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsAnyItemActive()) return;
  // Beside a panel at the right edge, whose rows it would cover.
  const ImVec2 whole = ImGui::GetIO().DisplaySize, window = ImGui::GetWindowPos();
  if (window.y > 0.8f * whole.y) {  // above a bar at the lower edge
    const float x =
        std::clamp(ImGui::GetIO().MousePos.x, 10 * em(), std::max(10 * em(), whole.x - 10 * em()));
    ImGui::SetNextWindowPos({x, window.y - 0.3f * em()}, ImGuiCond_Always, {0.5f, 1});
  } else if (window.x > 0.4f * whole.x) {
    const bool isLow = ImGui::GetItemRectMin().y > 0.6f * whole.y;
    ImGui::SetNextWindowPos(
        {window.x - 0.4f * em(), isLow ? ImGui::GetItemRectMax().y : ImGui::GetItemRectMin().y},
        ImGuiCond_Always, {1, isLow ? 1.0f : 0.0f});
  }
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(20 * em());
  textUnformatted(words);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool toggleButton(const char* label, bool& on, float width) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, theme::fill);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, theme::fillHovered);
  } else {
    ImGui::PushStyleColor(ImGuiCol_Text, theme::quiet);
  }
  const bool changed = ImGui::Button(label, {width, 0});
  ImGui::PopStyleColor(on ? 2 : 1);
  if (changed) on = !on;
  return changed;
}

bool wideButton(const char* label) { return ImGui::Button(label, {-FLT_MIN, 0}); }

int segmentedButtons(const char* id, const char* const* labels, int count, int chosen) {
  ImGui::PushID(id);
  const float gap = 0.12f * em();
  const float width =
      (ImGui::GetContentRegionAvail().x - gap * static_cast<float>(count - 1)) / static_cast<float>(count);
  for (int i = 0; i < count; ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    bool on = i == chosen;
    if (toggleButton(labels[i], on, width)) chosen = i;
  }
  ImGui::PopID();
  return chosen;
}

}  // namespace clothsim

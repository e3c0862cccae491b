#include "app/viewer_overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>
#include <filesystem>
#include <string_view>

#include "app/viewer_keys.h"

namespace clothsim {
namespace {

constexpr float textSize = 16, titleSize = 23;  // on an ordinary screen [pixels]

const ImVec4 plainColor{0.95f, 0.95f, 0.96f, 1};
const ImVec4 quietColor{0.66f, 0.68f, 0.73f, 1};
const ImVec4 alertColor{1.0f, 0.76f, 0.36f, 1};
const ImVec4 panelColor{0.07f, 0.08f, 0.10f, 0.70f};
const ImVec4 keyListColor{0.07f, 0.08f, 0.10f, 0.90f};
const ImVec4 keyCapColor{0.24f, 0.26f, 0.31f, 1};

// The first of these that is there; without any, Dear ImGui's own bitmap font does.
const char* typeface() {
  for (const char* path :
       {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf",
        "/usr/share/fonts/truetype/roboto/Roboto-Medium.ttf",
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path;
  }
  return nullptr;
}

constexpr ImGuiWindowFlags panelFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                        ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoFocusOnAppearing;

void text(std::string_view words, const ImVec4& color) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(words.data(), words.data() + words.size());
  ImGui::PopStyleColor();
}

void title(const std::string& words) {
  ImGui::PushFont(ImGui::GetIO().Fonts->Fonts.back());
  text(words, plainColor);
  ImGui::PopFont();
}

void drawPanel(const OverlayFacts& facts, float scale) {
  ImGui::SetNextWindowPos({14 * scale, 14 * scale});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, panelColor);
  ImGui::Begin("facts", nullptr, panelFlags);
  title(facts.title);
  if (ImGui::BeginTable("rows", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const OverlayFacts::Row& row : facts.rows) {
      ImGui::TableNextColumn();
      text(row.label, quietColor);
      ImGui::TableNextColumn();
      text(row.value, row.alert ? alertColor : plainColor);
    }
    ImGui::EndTable();
  }
  ImGui::End();
  ImGui::PopStyleColor();
}

// The name of a key on a small rounded rectangle, as on a keyboard.
void drawKeyCap(std::string_view name, float scale) {
  const ImVec2 size = ImGui::CalcTextSize(name.data(), name.data() + name.size());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float margin = 7 * scale;
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x + 2 * margin, at.y + size.y + 4 * scale},
                                            ImGui::GetColorU32(keyCapColor), 4 * scale);
  ImGui::SetCursorScreenPos({at.x + margin, at.y + 2 * scale});
  text(name, plainColor);
}

void drawKeyList(float scale) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, keyListColor);
  ImGui::Begin("keys", nullptr, panelFlags);
  title("Keys and mouse");
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const ViewerKey& key : viewerKeys) {
      ImGui::TableNextRow(ImGuiTableRowFlags_None, textSize * 1.55f * scale);
      ImGui::TableNextColumn();
      drawKeyCap(key.input, scale);
      ImGui::TableNextColumn();
      ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 2 * scale);
      text(key.effect, plainColor);
    }
    ImGui::EndTable();
  }
  ImGui::End();
  ImGui::PopStyleColor();
}

void drawNotice(const OverlayFacts& facts, float scale) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y - 18 * scale}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, facts.noticeIsError ? keyListColor : panelColor);
  ImGui::Begin("notice", nullptr, panelFlags);
  ImGui::PushTextWrapPos(0.8f * screen.x);
  text(facts.notice, facts.noticeIsError ? alertColor : plainColor);
  ImGui::PopTextWrapPos();
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace

ViewerOverlay::ViewerOverlay(GLFWwindow* window) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // no imgui.ini in the folder where the program happens to be started
  io.LogFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

ViewerOverlay::~ViewerOverlay() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

bool ViewerOverlay::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }

void ViewerOverlay::loadFonts(double textScale) {
  textScale_ = textScale;
  const auto scale = static_cast<float>(textScale);
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  for (const float size : {textSize, titleSize}) {
    if (const char* path = typeface()) {
      io.Fonts->AddFontFromFileTTF(path, std::round(size * scale));
    } else {
      ImFontConfig config;
      config.SizePixels = std::round(size * scale);
      io.Fonts->AddFontDefault(&config);
    }
  }
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();

  ImGuiStyle style;
  style.WindowRounding = 10;
  style.WindowBorderSize = 0;
  style.WindowPadding = {16, 12};
  style.WindowMinSize = {8, 8};
  style.CellPadding = {0, 2};
  style.ItemSpacing = {12, 5};
  style.ScaleAllSizes(scale);
  style.CellPadding.x = 9 * scale;
  ImGui::GetStyle() = style;
}

void ViewerOverlay::draw(const OverlayFacts& facts, double textScale, bool showPanel, bool showKeys) {
  if (textScale != textScale_) loadFonts(textScale);
  const auto scale = static_cast<float>(textScale);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  // In a small window the list of keys would lie over the panel.
  const bool roomForBoth = ImGui::GetIO().DisplaySize.x > 1000 * scale;
  if (showPanel && (roomForBoth || !showKeys)) drawPanel(facts, scale);
  if (!facts.notice.empty()) drawNotice(facts, scale);
  if (showKeys) drawKeyList(scale);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace clothsim

#include "viewer/timeline_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

enum class Symbol { back, forward, play, pause, camera, record, stop };

// A button with a drawn symbol, since fonts may lack such symbols.
bool symbolButton(const char* id, Symbol symbol, bool on, const char* help) {
  const float side = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::Button(id, {1.25f * side, side});
  helpTip(help);
  const ImVec4 red{0.92f, 0.33f, 0.33f, 1};
  const bool isRecording = symbol == Symbol::record || symbol == Symbol::stop;
  const ImU32 color = ImGui::GetColorU32(isRecording ? red : on ? theme::accent : theme::plain);
  const ImVec2 c{at.x + 0.625f * side, at.y + 0.5f * side};
  const float r = 0.24f * side;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto bar = [&](float x, float half) {
    list.AddRectFilled({c.x + x - half, c.y - r}, {c.x + x + half, c.y + r}, color, 0.2f * half);
  };
  switch (symbol) {
    case Symbol::back:
      bar(-r, 0.18f * r);
      list.AddTriangleFilled({c.x + 0.9f * r, c.y - r}, {c.x + 0.9f * r, c.y + r}, {c.x - 0.7f * r, c.y},
                             color);
      break;
    case Symbol::forward:
      bar(r, 0.18f * r);
      list.AddTriangleFilled({c.x - 0.9f * r, c.y - r}, {c.x + 0.7f * r, c.y}, {c.x - 0.9f * r, c.y + r},
                             color);
      break;
    case Symbol::play:
      list.AddTriangleFilled({c.x - 0.7f * r, c.y - r}, {c.x + r, c.y}, {c.x - 0.7f * r, c.y + r}, color);
      break;
    case Symbol::pause:
      bar(-0.5f * r, 0.28f * r);
      bar(0.5f * r, 0.28f * r);
      break;
    case Symbol::camera:
      list.AddRectFilled({c.x - 1.2f * r, c.y - 0.75f * r}, {c.x + 1.2f * r, c.y + 0.9f * r}, color,
                         0.3f * r);
      list.AddRectFilled({c.x - 0.5f * r, c.y - 1.05f * r}, {c.x + 0.5f * r, c.y}, color, 0.2f * r);
      list.AddCircleFilled({c.x, c.y + 0.1f * r}, 0.5f * r, ImGui::GetColorU32(ImGuiCol_Button));
      break;
    case Symbol::record:
      list.AddCircleFilled(c, 0.85f * r, color);
      break;
    case Symbol::stop:
      list.AddRectFilled({c.x - 0.75f * r, c.y - 0.75f * r}, {c.x + 0.75f * r, c.y + 0.75f * r}, color,
                         0.15f * r);
      break;
  }
  return pressed;
}

// Shows the stored frames as a line on which the mouse chooses one.
std::optional<int> drawTrack(const TimelineState& state, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight(), middle = at.y + 0.5f * height;
  const float left = at.x + 0.4f * em(), length = std::max(1.0f, width - 0.8f * em());
  ImGui::InvisibleButton("track", {width, height});
  const int span = std::max(1, state.newest - state.oldest);
  std::optional<int> chosen;
  if (ImGui::IsItemActive() && state.newest > state.oldest) {
    const float share = std::clamp((ImGui::GetIO().MousePos.x - left) / length, 0.0f, 1.0f);
    const int frame = state.oldest + static_cast<int>(std::lround(share * static_cast<float>(span)));
    if (frame != state.now) chosen = frame;
  }
  const float share = state.newest > state.oldest
                          ? static_cast<float>(state.now - state.oldest) / static_cast<float>(span)
                          : 1.0f;
  const float x = left + share * length, half = 0.14f * em();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({left, middle - half}, {left + length, middle + half},
                     ImGui::GetColorU32(ImGuiCol_FrameBgActive), half);
  list.AddRectFilled({left, middle - half}, {x, middle + half},
                     ImGui::GetColorU32(ImVec4(0.29f, 0.47f, 0.61f, 1)), half);
  const bool held = ImGui::IsItemActive() || ImGui::IsItemHovered();
  list.AddCircleFilled({x, middle}, (held ? 0.46f : 0.38f) * em(), ImGui::GetColorU32(theme::accent));
  helpTip("The frames kept in memory. Drag to go back; P resumes from the one shown.");
  return chosen;
}

std::string timeText(const TimelineState& state) {
  char text[64];
  if (state.now < state.newest)
    std::snprintf(text, sizeof text, "frame %d  (%.2f s back)", state.shownNumber,
                  (state.newest - state.now) * state.frameSeconds);
  else
    std::snprintf(text, sizeof text, "frame %d", state.shownNumber);
  return text;
}

}  // namespace

float timelineHeight() { return ImGui::GetFrameHeight() + 0.8f * em(); }

TimelineRequests drawTimeline(const TimelineState& state, PictureArea area) {
  TimelineRequests requests;
  const float height = timelineHeight();
  ImGui::SetNextWindowPos({0, area.height - height});
  ImGui::SetNextWindowSize({area.width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.6f * em(), 0.4f * em()});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.25f * em(), 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::glass);
  ImGui::Begin("timeline", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  requests.stepBack = symbolButton("##back", Symbol::back, false, "Back one frame (Left)");
  ImGui::SameLine();
  requests.togglePause = symbolButton("##pause", state.paused ? Symbol::play : Symbol::pause, state.paused,
                                      state.paused ? "Resume from here (P)" : "Pause (P)");
  ImGui::SameLine();
  requests.stepForward =
      symbolButton("##forward", Symbol::forward, false, "Forward one frame (Right; N simulates a new one)");
  ImGui::SameLine();
  char tempo[32];
  std::snprintf(tempo, sizeof tempo, "%g\u00d7###tempo", state.tempo);
  ImGui::PushStyleColor(ImGuiCol_Text, state.tempo < 1 ? theme::alert : theme::quiet);
  requests.slowMotion = ImGui::Button(tempo, {3.4f * em(), 0});
  ImGui::PopStyleColor();
  helpTip("Slow motion (S)");
  ImGui::SameLine();
  const std::string time = timeText(state);
  char clip[32] = "";
  if (state.recordedSeconds) std::snprintf(clip, sizeof clip, "%.1f s", *state.recordedSeconds);
  // The width of the text is rounded up, so that the track rarely moves.
  const float words = std::max(ImGui::CalcTextSize(time.c_str()).x, 5.5f * em());
  const float buttons =
      2 * 1.25f * ImGui::GetFrameHeight() + (clip[0] != '\0' ? 3.2f * em() : 0) + 1.2f * em();
  const float room = ImGui::GetContentRegionAvail().x - buttons, track = room - words - 0.6f * em();
  const bool hasTrack = track > 3 * em();
  if (hasTrack) {
    requests.seek = drawTrack(state, track);
    ImGui::SameLine(0, 0.5f * em());
  }
  const std::string shown = hasTrack ? time : std::to_string(state.shownNumber);
  const float shownWidth = hasTrack ? words : ImGui::CalcTextSize(shown.c_str()).x;
  if (hasTrack || room > shownWidth + 0.5f * em()) {
    ImGui::AlignTextToFramePadding();
    const ImVec2 at = ImGui::GetCursorPos();
    coloredText(shown, state.now < state.newest ? theme::alert : theme::quiet);
    ImGui::SetCursorPos({at.x + shownWidth + 0.5f * em(), at.y});
  }
  requests.screenshot = symbolButton("##screenshot", Symbol::camera, false, "Screenshot (Ctrl+P)");
  ImGui::SameLine();
  const bool recording = state.recordedSeconds.has_value();
  requests.toggleRecording = symbolButton("##record", recording ? Symbol::stop : Symbol::record, recording,
                                          recording ? "Stop recording (Ctrl+R)" : "Record a clip (Ctrl+R)");
  if (recording) {
    ImGui::SameLine();
    coloredText(clip, {0.95f, 0.5f, 0.5f, 1});
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  return requests;
}

}  // namespace clothsim

#include "viewer/panels/field_widgets.h"

#include <imgui.h>

#include <array>
#include <cstdio>
#include <utility>

#include "cloth/material.h"
#include "scene_io/codec.h"
#include "viewer/panels/number_controls.h"
#include "viewer/ui_frame.h"

namespace clothsim {
namespace {

constexpr float labelShare = 0.42f;  // of a row's width

// The words in "one of verlet, euler", "false, true, averaged, robust" or "0 (horizontal), 1 (vertical)".
// `false` becomes "off".
std::vector<std::string> wordsIn(std::string text) {
  if (text.starts_with("one of ")) text.erase(0, 7);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(", ", at), text.size());
    const std::string word = text.substr(at, end - at);
    if (word == "false")
      words.emplace_back("off");
    else if (word != "true")
      words.push_back(word);
    at = end + 2;
  }
  return words;
}

// A list to choose a word from. True when another one was chosen.
bool combo(std::string& chosen, const std::vector<std::string>& words) {
  bool changed = false;
  if (ImGui::BeginCombo("##value", chosen.c_str())) {
    for (const std::string& word : words) {
      if (ImGui::Selectable(word.c_str(), word == chosen)) {
        changed = word != chosen;
        chosen = word;
      }
    }
    ImGui::EndCombo();
  }
  return changed;
}

bool textLine(std::string& text) {
  std::array<char, 512> typed{};
  std::snprintf(typed.data(), typed.size(), "%s", text.c_str());
  if (!ImGui::InputText("##value", typed.data(), typed.size(), ImGuiInputTextFlags_EnterReturnsTrue))
    return false;
  text = typed.data();
  return true;
}

// Like combo(), with a line below the words in which another text can be typed.
bool openCombo(std::string& chosen, const std::vector<std::string>& words) {
  const auto shown = [](const std::string& word) { return word.empty() ? "none" : word.c_str(); };
  bool changed = false;
  if (!ImGui::BeginCombo("##value", shown(chosen))) return false;
  for (const std::string& word : words) {
    if (!ImGui::Selectable(shown(word), word == chosen)) continue;
    changed = word != chosen;
    chosen = word;
  }
  ImGui::SetNextItemWidth(12 * em());
  if (textLine(chosen)) {
    changed = true;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndCombo();
  return changed;
}

// Takes `value` back to what it was before where it is beyond its limits.
template <class Number>
void keepWithin(const FieldTraits& field, Number& value, Number before) {
  if (within(field.limits, value)) return;
  value = before;
  tellBriefly(labelOf(field.key) + " has to be " + limitsText(field.limits) + ": it stays");
}

}  // namespace

FieldEdits FieldWidgets::takeEdits() {
  edits_.holding = edits_.holding || rebuildHeld_;
  return std::exchange(edits_, {});
}

void FieldWidgets::note(bool changedNow, Change when, bool finishedNow) {
  edits_.holding = edits_.holding || ImGui::IsAnyItemActive();
  if (when == Change::live) {
    edits_.live = edits_.live || changedNow;
  } else {
    rebuildHeld_ = rebuildHeld_ || changedNow;
    if (finishedNow && rebuildHeld_) {
      edits_.rebuild = true;
      rebuildHeld_ = false;
    }
  }
}

bool FieldWidgets::beginRows(std::string_view path) {
  const std::string id = "rows of " + std::string(path);
  if (!ImGui::BeginTable(id.c_str(), 2, ImGuiTableFlags_SizingStretchProp)) return false;
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, labelShare);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1 - labelShare);
  return true;
}

void FieldWidgets::endRows() { ImGui::EndTable(); }

void FieldWidgets::beginRow(const FieldTraits& field, std::string_view path, std::string_view unit) {
  ImGui::PushID(field.key.data());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  const std::string label = labelOf(field.key), unitWords = unit.empty() ? "" : unitText(unit);
  const float gap = 0.35f * em();
  const float scale = fittingScale(widthOf(label) + (unit.empty() ? 0 : gap + widthOf(unitWords)));
  ImGui::SetWindowFontScale(scale);
  ImGui::TextUnformatted(label.c_str());
  helpTip(helpOf(field, path));
  if (!unit.empty()) {
    ImGui::SameLine(0, scale * gap);
    quietText(unitWords);
  }
  ImGui::SetWindowFontScale(1);
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void FieldWidgets::endRow(const FieldTraits& field, std::string_view path, bool changedNow, bool finishedNow,
                          bool isBar) {
  helpTip(helpOf(field, path) + (isBar ? "\nDrag, or double-click to type a number, such as 20 cm." : ""));
  note(changedNow, field.change, finishedNow);
  ImGui::PopID();
}

void FieldWidgets::control(const FieldTraits& field, std::string_view path, bool& value) {
  beginRow(field, path, "");
  const bool changed = ImGui::Checkbox("##value", &value);
  endRow(field, path, changed, changed);
}

void FieldWidgets::control(const FieldTraits& field, std::string_view path, int& value) {
  beginRow(field, path, "");
  const int before = value;
  const bool changed = barSlider(value, sliderRange(field, value), field.unit);
  if (changed) keepWithin(field, value, before);
  endRow(field, path, changed, ImGui::IsItemDeactivatedAfterEdit(), true);
}

bool FieldWidgets::number(const FieldTraits& field, double& value) {
  const double before = value;
  const bool changed = barSlider(value, sliderRange(field, value), field.unit);
  if (changed) keepWithin(field, value, before);
  return changed;
}

void FieldWidgets::control(const FieldTraits& field, std::string_view path, double& value) {
  beginRow(field, path, "");
  const bool changed = number(field, value);
  endRow(field, path, changed, ImGui::IsItemDeactivatedAfterEdit(), true);
}

void FieldWidgets::control(const FieldTraits& field, std::string_view path, std::string& value) {
  const std::string place = std::string(path) + "." + std::string(field.key);
  const auto found = std::find_if(choices_.begin(), choices_.end(),
                                  [&](const Choices& choices) { return place.ends_with(choices.path); });
  beginRow(field, path, "");
  bool changed = false;
  if (!field.choices.empty())
    changed = combo(value, {field.choices.begin(), field.choices.end()});
  else if (found != choices_.end())
    changed = openCombo(value, found->words);
  else
    changed = textLine(value);
  endRow(field, path, changed, changed);
}

bool FieldWidgets::vector(const FieldTraits& field, Vec3d& value) {
  if (field.format == Format::color) {
    float color[3] = {static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)};
    if (!ImGui::ColorEdit3("##value", color,
                           ImGuiColorEditFlags_DisplayHex | ImGuiColorEditFlags_PickerHueWheel))
      return false;
    value = {color[0], color[1], color[2]};
    return true;
  }
  const Usual range = sliderRange(field, std::max({value.x, value.y, value.z}));
  const float speed = static_cast<float>((range.high - range.low) / 400);
  const Vec3d before = value;
  if (!dragVector(value, speed, field.unit)) return false;
  keepWithin(field, value.x, before.x);
  keepWithin(field, value.y, before.y);
  keepWithin(field, value.z, before.z);
  if (field.limits.nonZero && value == Vec3d{}) value = before;
  return true;
}

void FieldWidgets::control(const FieldTraits& field, std::string_view path, Vec3d& value) {
  beginRow(field, path, field.format == Format::color ? "" : field.unit);
  const bool changed = vector(field, value);
  endRow(field, path, changed, ImGui::IsItemDeactivatedAfterEdit());
}

// A direction or place that the program chooses where it is absent.
void FieldWidgets::control(const FieldTraits& field, std::string_view path, std::optional<Vec3d>& value) {
  beginRow(field, path, field.unit);
  bool on = value.has_value(), finished = false;
  bool changed = ImGui::Checkbox("##on", &on);
  if (changed) {
    const Vec3d first = field.format == Format::color ? Vec3d{0.7, 0.7, 0.7} : Vec3d{0, 1, 0};
    value = on ? std::optional(first) : std::nullopt;
    finished = true;
  }
  helpTip(helpOf(field, path));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (value) {
    changed = vector(field, *value) || changed;
    finished = ImGui::IsItemDeactivatedAfterEdit() || finished;
  } else {
    quietText("automatic");
  }
  endRow(field, path, changed, finished);
}

template <class Enum>
void FieldWidgets::wordControl(const FieldTraits& field, std::string_view path, Enum& value) {
  beginRow(field, path, "");
  const JsonPointer now = writeValue(field, value);
  std::string word = now->kind == JsonKind::boolean ? "off" : now->text;
  const bool changed = combo(word, wordsIn(typeName(field, value)));
  if (changed) readValue(word == "off" ? *makeBoolean(false) : *makeString(word), field, value);
  endRow(field, path, changed, changed);
}

void FieldWidgets::control(const FieldTraits& field, std::string_view path, Integrator& value) {
  wordControl(field, path, value);
}
void FieldWidgets::control(const FieldTraits& field, std::string_view path, SelfCollision& value) {
  wordControl(field, path, value);
}
void FieldWidgets::control(const FieldTraits& field, std::string_view path, FrictionLaw& value) {
  wordControl(field, path, value);
}

// A number that may be absent. Where `false` means absent a switch stands before it; other numbers are shown
// only where the scene has them.
void FieldWidgets::control(const FieldTraits& field, std::string_view path, std::optional<double>& value) {
  if (!value && field.format != Format::orFalse) return;
  beginRow(field, path, "");
  bool changed = false, finished = false;
  if (field.format == Format::orFalse) {
    bool on = value.has_value();
    if (ImGui::Checkbox("##on", &on)) {
      const Usual range = sliderRange(field, 1);
      value = on ? std::optional(range.low + 0.2 * (range.high - range.low)) : std::nullopt;
      changed = finished = true;
    }
    helpTip(helpOf(field, path));
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
  }
  if (value) {
    changed = number(field, *value) || changed;
    finished = ImGui::IsItemDeactivatedAfterEdit() || finished;
  } else {
    quietText("off");
  }
  endRow(field, path, changed, finished);
}

// A switch for "auto" before the number that it stands for now.
void FieldWidgets::control(const FieldTraits& field, std::string_view path, AutoCount& value) {
  beginRow(field, path, "");
  bool changed = ImGui::Checkbox("auto", &value.automatic);
  helpTip(helpOf(field, path));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  int count = value.count;
  if (barSlider(count, sliderRange(field, count), field.unit)) {
    keepWithin(field, count, value.count);
    value = count;
    changed = true;
  }
  endRow(field, path, changed, changed || ImGui::IsItemDeactivatedAfterEdit());
}

// Chooses the preset; its values have rows of their own.
void FieldWidgets::control(const FieldTraits& field, std::string_view path, std::optional<Material>& value) {
  const std::string springs = "none: springs", own = "custom";
  beginRow(field, path, "");
  std::vector<std::string> words = materialPresetNames();
  std::string word = value ? own : springs;
  for (const std::string& name : words)
    if (value && *value == materialPreset(name)) word = name;
  words.insert(words.begin(), springs);
  const bool changed = combo(word, words);
  if (changed) value = materialPreset(word);
  endRow(field, path, changed, changed);
}

}  // namespace clothsim

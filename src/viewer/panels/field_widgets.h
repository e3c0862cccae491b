// Makes controls from the table of scene keys. Each field gets a label, a widget for its type with unit and
// range, and the help text of the table.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene_io/field_table.h"

namespace clothsim {

// How the controls of a frame have changed the values.
struct FieldEdits {
  bool live = false;     // a live field was changed
  bool rebuild = false;  // a field that rebuilds the cloth was changed, and its control released
  bool holding = false;  // a control is being dragged or typed into
};

class FieldWidgets {
 public:
  // Draws the controls of all fields of the struct but `without`, in the order of the table.
  template <class Owner>
  void all(Owner& owner, std::string_view path, std::initializer_list<std::string_view> without = {}) {
    if (!beginRows(path)) return;
    for (const Field<Owner>& field : fieldsOf<Owner>())
      if (std::find(without.begin(), without.end(), field.key) == without.end()) row(field, owner, path);
    endRows();
  }
  // Draws the controls of these keys, in this order. Unknown keys are ignored.
  template <class Owner>
  void some(Owner& owner, std::string_view path, std::initializer_list<std::string_view> keys) {
    if (!beginRows(path)) return;
    for (const std::string_view key : keys)
      for (const Field<Owner>& field : fieldsOf<Owner>())
        if (field.key == key) row(field, owner, path);
    endRows();
  }
  // Offers texts for string fields whose path ends so, which may also have others. "" is shown as "none".
  void offer(std::string path, std::vector<std::string> words) {
    choices_.push_back({std::move(path), std::move(words)});
  }

  // Returns the changes since the last call.
  [[nodiscard]] FieldEdits takeEdits();
  // To be called when a control outside this class has changed a field.
  void changed(Change when) { note(true, when, true); }

 private:
  struct Choices {
    std::string path;
    std::vector<std::string> words;
  };

  template <class Owner>
  void row(const Field<Owner>& field, Owner& owner, std::string_view path) {
    std::visit([&](auto member) { control(field, path, owner.*member); }, field.member);
  }
  // Types without an overload have no control: lists and objects have panels.
  template <class T>
  void control(const FieldTraits&, std::string_view, T&) {}
  void control(const FieldTraits& field, std::string_view path, bool& value);
  void control(const FieldTraits& field, std::string_view path, int& value);
  void control(const FieldTraits& field, std::string_view path, AutoCount& value);
  void control(const FieldTraits& field, std::string_view path, double& value);
  void control(const FieldTraits& field, std::string_view path, std::string& value);
  void control(const FieldTraits& field, std::string_view path, Vec3d& value);
  void control(const FieldTraits& field, std::string_view path, Integrator& value);
  void control(const FieldTraits& field, std::string_view path, SelfCollision& value);
  void control(const FieldTraits& field, std::string_view path, FrictionLaw& value);
  void control(const FieldTraits& field, std::string_view path, std::optional<double>& value);
  void control(const FieldTraits& field, std::string_view path, std::optional<Material>& value);
  void control(const FieldTraits& field, std::string_view path, std::optional<Vec3d>& value);
  bool vector(const FieldTraits& field, Vec3d& value);
  template <class Enum>
  void wordControl(const FieldTraits& field, std::string_view path, Enum& value);

  [[nodiscard]] bool beginRows(std::string_view path);
  void endRows();
  void beginRow(const FieldTraits& field, std::string_view path, std::string_view unit);
  void endRow(const FieldTraits& field, std::string_view path, bool changedNow, bool finishedNow,
              bool isBar = false);
  bool number(const FieldTraits& field, double& value);
  void note(bool changedNow, Change when, bool finishedNow);

  std::vector<Choices> choices_;
  FieldEdits edits_;
  bool rebuildHeld_ = false;  // a field that rebuilds was changed, and its control is not released yet
};

// "num_width_points" -> "num width points"; "m/s^2" -> "m/s²".
[[nodiscard]] std::string labelOf(std::string_view key);
[[nodiscard]] std::string unitText(std::string_view unit);
// A format of printf for a number with its unit, such as "%.4g N/m". A '%' in the unit is doubled.
[[nodiscard]] std::string numberFormat(std::string_view unit);
// Whether a slider over that range needs a logarithmic scale.
[[nodiscard]] bool isLogarithmic(const Usual& range);
// The entry of the field in the table as the text of a tip.
[[nodiscard]] std::string helpOf(const FieldTraits& field, std::string_view path);

}  // namespace clothsim

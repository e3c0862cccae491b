// Controls made from the table of scene keys: for each field a label, a widget for its type with unit, range
// and a slider scale, and the table's own sentence of help.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene_io/field_table.h"

namespace clothsim {

// What the controls of one frame did to the values they show.
struct FieldEdits {
  bool live = false;     // a field that acts at once was changed
  bool rebuild = false;  // one that rebuilds the cloth was changed, and its control let go
  bool holding = false;  // some control is being dragged or typed into
};

class FieldWidgets {
 public:
  // Controls for all fields of the struct that have one, in the order of the table, apart from `without`.
  template <class Owner>
  void all(Owner& owner, std::string_view path, std::initializer_list<std::string_view> without = {}) {
    if (!beginRows(path)) return;
    for (const Field<Owner>& field : fieldsOf<Owner>())
      if (std::find(without.begin(), without.end(), field.key) == without.end()) row(field, owner, path);
    endRows();
  }
  // Those of some keys, in that order. Keys that the table does not have are passed over.
  template <class Owner>
  void some(Owner& owner, std::string_view path, std::initializer_list<std::string_view> keys) {
    if (!beginRows(path)) return;
    for (const std::string_view key : keys)
      for (const Field<Owner>& field : fieldsOf<Owner>())
        if (field.key == key) row(field, owner, path);
    endRows();
  }
  // Texts to choose from in the string field of that path, which may also have others: "" is shown as "none".
  void offer(std::string path, std::vector<std::string> words) {
    choices_.push_back({std::move(path), std::move(words)});
  }

  // What has happened since the last call.
  [[nodiscard]] FieldEdits takeEdits();
  // A control that is made by hand has changed something.
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
  // Types without an overload have no control of their own: lists and objects get panels.
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
  void endRow(const FieldTraits& field, std::string_view path, bool changedNow, bool finishedNow);
  bool number(const FieldTraits& field, double& value);
  void note(bool changedNow, Change when, bool finishedNow);

  std::vector<Choices> choices_;
  FieldEdits edits_;
  bool rebuildHeld_ = false;  // a field that rebuilds was changed, and its control is still held
};

// "num_width_points" -> "num width points"; "m/s^2" -> "m/s²".
[[nodiscard]] std::string labelOf(std::string_view key);
[[nodiscard]] std::string unitText(std::string_view unit);
// printf's format for a number with its unit, in which '%' is doubled: "%.4g N/m".
[[nodiscard]] std::string numberFormat(std::string_view unit);
// Whether a slider over that range spans decades.
[[nodiscard]] bool isLogarithmic(const Usual& range);
// Everything that the table knows about the field, for a tip.
[[nodiscard]] std::string helpOf(const FieldTraits& field, std::string_view path);

}  // namespace clothsim

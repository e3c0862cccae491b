// Controls of numbers that can be dragged or typed. What is typed counts when Enter ends it or the field is
// left, and may have a unit of its own: "20 cm" is 0.2 in a field of metres. What is no such number changes
// nothing, and a tip below the control says so.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/vec.h"
#include "scene_io/field_table.h"

namespace clothsim {

// The number in a text, in the unit; the text may end in that unit, in it with a prefix of SI, or in "in" or
// "ft" for "m", "km/h" for "m/s". None where it is no finite number or the unit is another one.
[[nodiscard]] std::optional<double> numberIn(std::string_view text, std::string_view unit);

// A slider drawn as a bar that is filled up to the number, with the number and its unit written on it. It is
// dragged; a double click or Ctrl+click types a number. It has the width of the next item. True when the
// number was changed.
bool barSlider(double& value, const Usual& range, std::string_view unit);
bool barSlider(int& value, const Usual& range, std::string_view unit);

// Three numbers beside each other, with the width of the next item; dragging one by a pixel changes it by
// `speed`.
bool dragVector(Vec3d& value, float speed, std::string_view unit);

// Says something below the last of these controls for a moment.
void tellBriefly(std::string text);

}  // namespace clothsim

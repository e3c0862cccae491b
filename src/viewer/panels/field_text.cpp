// The texts of the controls. They stand in a file of their own so that tests need no window.
#include "viewer/panels/field_widgets.h"

namespace clothsim {

std::string labelOf(std::string_view key) {
  std::string label(key);
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

std::string unitText(std::string_view unit) {
  std::string text;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool power = unit[i] == '^' && i + 1 < unit.size() && (unit[i + 1] == '2' || unit[i + 1] == '3');
    if (power)
      text += unit[++i] == '2' ? "\u00b2" : "\u00b3";
    else
      text += unit[i];
  }
  return text;
}

std::string numberFormat(std::string_view unit) {
  std::string format = "%.4g";
  if (!unit.empty()) format += " ";
  for (const char c : unitText(unit)) format += c == '%' ? "%%" : std::string(1, c);
  return format;
}

bool isLogarithmic(const Usual& range) { return range.low > 0 && range.high >= 50 * range.low; }

std::string helpOf(const FieldTraits& field, std::string_view path) {
  std::string text(field.help);
  text += "\n\n" + std::string(path) + (path.empty() ? "" : ".") + std::string(field.key);
  if (!field.unit.empty()) text += " [" + unitText(field.unit) + "]";
  if (const std::string limits = limitsText(field.limits); !limits.empty()) text += ", " + limits;
  if (!field.defaultText.empty()) text += "\ndefault: " + std::string(field.defaultText);
  text +=
      field.change == Change::live ? "\nTakes effect immediately." : "\nRebuilds the cloth; pins are kept.";
  return text;
}

}  // namespace clothsim

// The texts of the controls. They stand in a file of their own so that tests need no window.
#include <charconv>
#include <cmath>
#include <utility>

#include "viewer/panels/field_widgets.h"
#include "viewer/panels/number_controls.h"

namespace clothsim {
namespace {

// How many of the unit one of another is; none where they do not measure the same.
std::optional<double> factorOf(std::string_view other, std::string_view unit) {
  constexpr std::pair<std::string_view, double> prefixes[]{{"k", 1e3}, {"", 1}, {"c", 1e-2}, {"m", 1e-3}};
  struct Known {
    std::string_view other, unit;
    double factor;
  };
  constexpr Known others[]{{"in", "m", 0.0254}, {"ft", "m", 0.3048}, {"km/h", "m/s", 1 / 3.6}};
  for (const Known& known : others)
    if (known.other == other && known.unit == unit) return known.factor;
  // Mass has a prefix in the unit itself.
  const bool hasPrefix = unit.starts_with("kg");
  const std::string_view base = hasPrefix ? unit.substr(1) : unit;
  for (const auto& [prefix, factor] : prefixes) {
    const std::string prefixed = std::string(prefix).append(base);
    if (!base.empty() && (other == prefixed || other == unitText(prefixed)))
      return hasPrefix ? 1e-3 * factor : factor;
  }
  return std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<double> numberIn(std::string_view text, std::string_view unit) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
  const std::string_view typedUnit = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  const std::optional<double> factor = typedUnit.empty() ? 1 : factorOf(typedUnit, unit);
  return factor ? std::optional(*factor * number) : std::nullopt;
}

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

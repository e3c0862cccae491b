#include "scene_io/variations.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"

namespace clothsim {
namespace {

constexpr double pictureAspect = 16.0 / 9.0;
constexpr std::size_t longestRow = 4;  // of a single variation that is not wrapped

std::vector<std::string> splitValues(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  bool isQuoted = false, isEscaped = false;
  for (const char c : text) {
    if (isQuoted) {
      isQuoted = isEscaped || c != '"';
      isEscaped = !isEscaped && c == '\\';
    } else if (c == '"') {
      isQuoted = true;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
  }
  return values;
}

// The number of cells in a row with which the whole comes near to 16 : 9 and few places stay empty.
std::size_t wrappedColumns(std::size_t count, double aspect) {
  if (count <= longestRow) return count;
  std::size_t best = count;
  double least = INFINITY;
  for (std::size_t columns = 1; columns <= count; ++columns) {
    const std::size_t rows = (count + columns - 1) / columns;
    const double shape = static_cast<double>(columns) * aspect / static_cast<double>(rows);
    const double empty = static_cast<double>(columns * rows - count) / static_cast<double>(count);
    const double cost = std::abs(std::log(shape / pictureAspect)) + 4 * empty;
    if (cost < least) {
      least = cost;
      best = columns;
    }
  }
  return best;
}

}  // namespace

Variation parseVariation(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--vary " + text + ": expected key=value,value,..., such as cloth.ks=500,5000");
  Variation variation{text.substr(0, equals), splitValues(text.substr(equals + 1))};
  std::set<std::string> seen;
  for (const std::string& value : variation.values) {
    if (value.empty())
      throw UsageError("--vary " + text + ": a value is empty; expected values with single commas between");
    if (!seen.insert(value).second) throw UsageError("--vary " + text + ": " + value + " stands there twice");
  }
  return variation;
}

SweepTable::SweepTable(std::vector<Variation> variations, double aspect)
    : variations_(std::move(variations)) {
  if (variations_.empty()) throw UsageError("a sweep needs something to vary: --vary cloth.ks=500,5000");
  std::set<std::string> keys;
  for (const Variation& variation : variations_) {
    if (!keys.insert(variation.key).second)
      throw UsageError("--vary " + variation.key + " stands there twice; give all its values to one");
    cells_ *= variation.values.size();
    if (cells_ > mostCells)
      throw UsageError("--vary: more than " + std::to_string(mostCells) +
                       " combinations; a sheet of so many pictures could not be read");
  }
  columns_ = isWrapped() ? wrappedColumns(cells_, aspect) : variations_.front().values.size();
}

const std::string& SweepTable::value(std::size_t cell, std::size_t variation) const {
  const std::vector<std::string>& values = variations_[variation].values;
  if (isWrapped()) return values[cell];
  if (variation == 0) return values[cell % columns_];
  std::size_t row = cell / columns_;
  for (std::size_t i = variations_.size() - 1; i > variation; --i) row /= variations_[i].values.size();
  return values[row % values.size()];
}

}  // namespace clothsim

// The axes of a sweep: keys, the values that each of them takes, and all their combinations in a table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace clothsim {

struct Variation {
  std::string key;                  // as typed
  std::vector<std::string> values;  // as `--set key=value` takes them; at least one
  friend bool operator==(const Variation&, const Variation&) = default;
};

// "cloth.ks=500,5000": a comma within brackets, braces or quotes belongs to the value.
// @throws UsageError without a key, without values, with an empty value, or with one twice
[[nodiscard]] Variation parseVariation(const std::string& text);

// Every combination of the values, one a cell, row by row. The first variation goes along the columns and the
// others down the rows, the last of them fastest. A single variation fills rows of `columns`, and the last of
// them may be short.
class SweepTable {
 public:
  // @param aspect  width / height of a cell; a single variation is wrapped to fit a 16 : 9 picture
  // @throws UsageError without variations, with a key twice, or with more than mostCells
  SweepTable(std::vector<Variation> variations, double aspect);
  static constexpr std::size_t mostCells = 1024;

  [[nodiscard]] const std::vector<Variation>& variations() const { return variations_; }
  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return (cells_ + columns_ - 1) / columns_; }
  // Of a single variation each cell has a heading of its own; of more, each column and each row.
  [[nodiscard]] bool isWrapped() const { return variations_.size() == 1; }

  [[nodiscard]] const std::string& value(std::size_t cell, std::size_t variation) const;

 private:
  std::vector<Variation> variations_;
  std::size_t cells_ = 1, columns_ = 1;
};

}  // namespace clothsim

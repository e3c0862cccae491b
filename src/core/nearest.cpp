// Optimal string alignment distance: Wagner and Fischer's table with a fourth move for two swapped letters.
#include "core/nearest.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace clothsim {

namespace {

char fold(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<char>(c - 'A' + 'a');
  return c == '-' ? '_' : c;
}

// A word longer than any key cannot be near one; the bound keeps garbage from costing time.
constexpr std::size_t longestWord = 100;

bool begins(std::string_view word, std::string_view candidate) {
  return word.size() >= 3 && word.size() < candidate.size() &&
         editDistance(word, candidate.substr(0, word.size())) == 0;
}

}  // namespace

int editDistance(std::string_view a, std::string_view b) {
  std::vector<int> twoAbove(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    twoAbove = std::exchange(above, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool equal = fold(a[i - 1]) == fold(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (equal ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && fold(a[i - 1]) == fold(b[j - 2]) && fold(a[i - 2]) == fold(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], twoAbove[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates) {
  if (word.empty() || word.size() > longestWord) return std::nullopt;
  const std::string* best = nullptr;
  int bestDistance = 0;
  for (const std::string& candidate : candidates) {
    const int distance = begins(word, candidate) ? 1 : editDistance(word, candidate);
    const auto letters = static_cast<int>(std::max(word.size(), candidate.size()));
    if (distance > (letters + 2) / 3) continue;
    if (best == nullptr || distance < bestDistance) {
      best = &candidate;
      bestDistance = distance;
    }
  }
  return best == nullptr ? std::nullopt : std::optional(*best);
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
  const std::optional<std::string> nearest = nearestWord(word, candidates);
  return nearest ? "; did you mean \"" + *nearest + "\"?" : "";
}

}  // namespace clothsim

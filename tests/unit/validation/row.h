// Rows of the validation table, the cases with known answers (report/data/validation.csv): a test suite
// `Row...` is a row, and what it measures is compared with the demand, printed and left in gtest's report,
// from which `tools/validate table` makes the table. Tests whose names begin with `Long` take seconds or
// more; tools/test leaves them out.
#pragma once

#include <string>
#include <type_traits>

namespace clothsim::validation {

// CpuSolver<double> or CpuSolver<float>; the latter is the GPU's bitwise twin, so its rows stand for both.
template <class Real>
inline constexpr const char* precisionOf = std::is_same_v<Real, float> ? "binary32" : "double";

inline constexpr double GRAVITY = 9.81;  // [m/s^2]

struct Figure {
  std::string row;        // of the table
  std::string what;       // was measured, where a row has several numbers
  std::string precision;  // precisionOf<Real>
  std::string unit;       // "": a ratio or a count
  std::string note = {};
};

[[nodiscard]] inline Figure because(Figure figure, const std::string& note) {
  figure.note = note;
  return figure;
}

// |measured - expected| <= tolerance
void expectNear(const Figure& figure, double measured, double expected, double tolerance);
// measured <= bound, which a NaN is not
void expectAtMost(const Figure& figure, double measured, double bound);
// A demand that cannot be met: `figure.note` says why. Fails when it is met after all (then say so), and when
// the measured value is not even within `reached` of the expected one.
void reportUnmet(const Figure& figure, double measured, double expected, double tolerance, double reached);

}  // namespace clothsim::validation

#include "unit/validation/row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace clothsim::validation {
namespace {

std::string text(double x) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.10g", x);
  return buffer;
}

// In the order of the table's columns, with a separator that no field holds.
void record(const Figure& figure, const std::string& expected, double measured, const std::string& demand,
            bool met) {
  const std::string fields = figure.row + " | " + figure.what + " | " + figure.precision + " | " +
                             figure.unit + " | " + expected + " | " + text(measured) + " | " + demand +
                             " | " + (met ? "yes" : "no") + " | " + figure.note;
  static int count = 0;
  testing::Test::RecordProperty("figure" + std::to_string(++count), fields);
  std::printf("%s | %s | %s: expected %s, measured %s %s, demanded %s: %s\n", figure.row.c_str(),
              figure.what.c_str(), figure.precision.c_str(), expected.c_str(), text(measured).c_str(),
              figure.unit.c_str(), demand.c_str(), met ? "met" : "NOT MET");
}

}  // namespace

void expectNear(const Figure& figure, double measured, double expected, double tolerance) {
  const bool met = std::abs(measured - expected) <= tolerance;
  record(figure, text(expected), measured, "+-" + text(tolerance), met);
  EXPECT_TRUE(met) << figure.row << ", " << figure.what << ", " << figure.precision << ": " << text(measured)
                   << " is not within " << text(tolerance) << " of " << text(expected);
}

void expectAtMost(const Figure& figure, double measured, double bound) {
  const bool met = measured <= bound;
  record(figure, "0", measured, "<=" + text(bound), met);
  EXPECT_TRUE(met) << figure.row << ", " << figure.what << ", " << figure.precision << ": " << text(measured)
                   << " is more than " << text(bound);
}

void reportUnmet(const Figure& figure, double measured, double expected, double tolerance, double reached) {
  const double error = std::abs(measured - expected);
  record(figure, text(expected), measured, "+-" + text(tolerance), error <= tolerance);
  EXPECT_GT(error, tolerance) << figure.row << ", " << figure.what << ": met; use expectNear()";
  EXPECT_LE(error, reached) << figure.row << ", " << figure.what << ", " << figure.precision;
}

}  // namespace clothsim::validation

// The functions beyond + - * that a step may use, built from them and integer operations so that GLSL and C++
// come to the same bits (docs/numeric-contract.md). The binary32 versions are the twins of
// shaders/sim/exact_math.glsl; the double versions serve the tests of the physics and use the library.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>

static_assert(FLT_EVAL_METHOD == 0, "binary32 arithmetic must be done in binary32");

namespace clothsim {

[[gnu::always_inline]] inline float floatFromBits(std::uint32_t bits) { return std::bit_cast<float>(bits); }

// 1 / sqrt(x) for 0 < x < 2^126 within 1.2 ulp, finite at 0: a guess of 12 bits, whose square is exact, then
// the quartic in the residual r = 1 - x y^2 that is 1/sqrt(1 - r) - 1.
[[gnu::always_inline]] inline float inverseSquareRoot(float x) {
  const float y = floatFromBits((0x5f330000u - (std::bit_cast<std::uint32_t>(x) >> 1)) & 0xfffff000u);
  const float r = 1.0f - x * (y * y);
  float p = floatFromBits(0x3ea74a11u);
  p = floatFromBits(0x3e9e9e34u) + r * p;
  p = floatFromBits(0x3ebffe5au) + r * p;
  p = floatFromBits(0x3f000021u) + r * p;
  return y + y * (r * p);
}
[[gnu::always_inline]] inline double inverseSquareRoot(double x) { return x == 0 ? 0 : 1 / std::sqrt(x); }

// 1 / x for 2^-120 < x < 2^124 within 1.5 ulp: a tuned Newton step from a guess by bits, then a quadratic
// one.
[[gnu::always_inline]] inline float reciprocal(float x) {
  float y = floatFromBits(0x7eb504f3u - std::bit_cast<std::uint32_t>(x));
  y = y * (floatFromBits(0x403255c8u) - floatFromBits(0x3ff86fb4u) * (x * y));
  const float r = 1.0f - x * y;
  return y + y * (r + r * r);
}
[[gnu::always_inline]] inline double reciprocal(double x) { return 1 / x; }

// The number as the state may hold it: without denormals and without -0. The difference of two such numbers
// is 0 or at least 2^-63, so that its square is normal.
[[gnu::always_inline]] inline float canonical(float x) {
  const float magnitude = x < 0.0f ? -x : x;
  return magnitude < 0x1p-40f ? 0.0f : x;
}
[[gnu::always_inline]] inline double canonical(double x) { return x; }

// The bits of a number as an unsigned integer of its size. Sums of squares are ordered as their bits are, and
// infinities and NaNs, of either sign, come behind all finite ones.
[[gnu::always_inline]] inline std::uint32_t bitsOf(float x) { return std::bit_cast<std::uint32_t>(x); }
[[gnu::always_inline]] inline std::uint64_t bitsOf(double x) { return std::bit_cast<std::uint64_t>(x); }

// Whether a sum of squares is larger than the limit, infinite or NaN; by bits, because comparisons hide NaN.
template <class Real>
[[nodiscard, gnu::always_inline]] inline bool isBeyond(Real square, Real limit) {
  return bitsOf(square) > bitsOf(limit);
}

}  // namespace clothsim

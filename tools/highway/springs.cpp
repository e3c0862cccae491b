// Rows of springs by the compiler's vectors of the scalar law, and by Highway: time and bits.
#include "springs.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <vector>

#include "solver/cpu/arrays.h"
#include "solver/cpu/force_laws.h"

namespace clothsim::cpu {
namespace {

template <class Real>
INLINE void forcesOf(const Arrays<const Real>& x, const Arrays<Real>& forces, std::ptrdiff_t springs,
                     Real stiffness, Real restLength) {
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < springs; ++i)
    put(forces, i, springForce(at(x, i), at(x, i + 1), stiffness, restLength));
}
VECTOR_CLONES(void, forces,
              (const Arrays<const float>& x, const Arrays<float>& to, std::ptrdiff_t springs, float stiffness,
               float restLength),
              (x, to, springs, stiffness, restLength), forcesOf(x, to, springs, stiffness, restLength))

}  // namespace

// The set that this machine has (src/core/vector_set.cpp reads CLOTHSIM_VECTORS, too).
VectorSet vectorSet() {
  static const VectorSet set = __builtin_cpu_supports("avx512f") != 0 ? VectorSet::avx512
                               : __builtin_cpu_supports("avx2") != 0  ? VectorSet::avx2
                                                                      : VectorSet::plain;
  return set;
}

}  // namespace clothsim::cpu

namespace {

using namespace clothsim;

constexpr std::size_t BEHIND = 64;  // numbers that vectors may reach beyond a row
using Numbers = std::array<std::vector<float>, 3>;

Numbers numbersFor(std::size_t springs) {
  Numbers result;
  for (std::vector<float>& c : result) c.resize(springs + BEHIND);
  return result;
}

// The least of several times, by turns, in nanoseconds a spring.
void compare(std::size_t springs) {
  constexpr int turns = 15;
  const std::size_t rounds = 20'000'000 / springs;
  Numbers places = numbersFor(springs), byCompiler = numbersFor(springs), byHighway = numbersFor(springs);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < springs + BEHIND; ++i)
      places[c][i] = (c == 0 ? 0.01f * static_cast<float>(i) : 0.0f) +
                     0.001f * static_cast<float>((7919 * i + 104729 * c) % 97);
  const cpu::Arrays<const float> x{places[0].data(), places[1].data(), places[2].data()};
  const cpu::Arrays<float> to{byCompiler[0].data(), byCompiler[1].data(), byCompiler[2].data()};
  const trial::Row row{x.x, x.y, x.z, byHighway[0].data(), byHighway[1].data(), byHighway[2].data()};
  const auto count = static_cast<std::ptrdiff_t>(springs);
  const auto timed = [&](auto work) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t round = 0; round < rounds; ++round) work();
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    return time.count() / static_cast<double>(rounds * springs);
  };
  double ofCompiler = std::numeric_limits<double>::max(), ofHighway = ofCompiler;
  for (int turn = 0; turn < turns; ++turn) {
    ofCompiler = std::min(ofCompiler, timed([&] { cpu::forces(x, to, count, 100.0f, 0.01f); }));
    ofHighway = std::min(ofHighway, timed([&] { trial::forcesByHighway(row, count, 100.0f, 0.01f); }));
  }
  bool areSame = true;
  for (std::size_t c = 0; c < 3; ++c)
    areSame &= std::equal(byCompiler[c].begin(), byCompiler[c].begin() + count, byHighway[c].begin());
  std::printf("%zu,%.3f,%.3f,%s\n", springs, ofCompiler, ofHighway, areSame ? "equal" : "different");
}

}  // namespace

int main() {
  std::printf("springs,compiler_ns,highway_ns,forces\n");
  for (const std::size_t springs : {96, 256, 1024, 65536}) compare(springs);
}

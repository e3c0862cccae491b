// The CPU backend's particle state: one array per component, so that loops along a row run in vector
// registers.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/cache_line.h"

namespace clothsim {

// One of the three arrays of Components, which owns the memory.
template <class Real>
class Component {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Real* data() { return values_; }
  [[nodiscard]] const Real* data() const { return values_; }
  [[nodiscard]] Real& operator[](std::size_t i) { return values_[i]; }
  [[nodiscard]] const Real& operator[](std::size_t i) const { return values_[i]; }

 private:
  template <class>
  friend class Components;
  Component() = default;
  Component(const Component&) = default;
  Component& operator=(const Component&) = default;

  Real* values_ = nullptr;
  std::size_t size_ = 0;
};

// Vectors, as three arrays, each from a cache line on. They lie in one allocation at equal distances, so that
// others can see them as a matrix without a copy (NumPy's strides). Copying into as many vectors keeps the
// place in memory.
template <class Real>
class Components {
 public:
  Component<Real> x, y, z;

  Components() = default;
  ~Components() = default;
  Components(const Components& other) { *this = other; }
  Components(Components&& other) noexcept : firstLine_(other.firstLine_), values_(std::move(other.values_)) {
    divide(other.x.size_);
    other.clear();
  }
  Components& operator=(const Components& other) {
    if (this == &other) return *this;
    resize(other.x.size_);
    for (auto c : {&Components::x, &Components::y, &Components::z})
      std::copy_n((other.*c).values_, other.x.size_, (this->*c).values_);
    return *this;
  }
  Components& operator=(Components&& other) noexcept {
    if (this == &other) return *this;
    values_ = std::move(other.values_);
    firstLine_ = other.firstLine_;
    divide(other.x.size_);
    other.clear();
    return *this;
  }

  // Another number of vectors, all of them 0; with the same number nothing changes.
  void resize(std::size_t size) {
    if (size == x.size_) return;
    values_.assign(size > 0 ? 3 * distanceFor(size) + (PAGE_LINES + 1) * LINE : 0, Real(0));
    divide(size);
  }
  // From x[i] to y[i] and from there to z[i], in numbers.
  [[nodiscard]] std::size_t distance() const { return distanceFor(x.size_); }

 private:
  static constexpr std::size_t LINE = LINE_NUMBERS<Real>, PAGE_LINES = 64;
  // Whole cache lines, and five more: at a distance of whole pages the three would share their places in the
  // cache, and loads of neighbours would wait for stores that only look as if they went there.
  static constexpr std::size_t distanceFor(std::size_t size) {
    return (size + LINE - 1) / LINE * LINE + 5 * LINE;
  }
  // For the same reason no two objects that are made one after the other begin at the same line of a page.
  static std::size_t nextFirstLine() {
    static std::atomic<std::size_t> made = 0;
    return made++ * 15 % PAGE_LINES;
  }
  void divide(std::size_t size) {
    Real* place = size > 0 ? lineAt(values_.data()) + firstLine_ * LINE : nullptr;
    for (Component<Real>* component : {&x, &y, &z}) {
      component->values_ = place;
      component->size_ = size;
      if (size > 0) place += distanceFor(size);
    }
  }
  void clear() {
    values_.clear();
    divide(0);
  }

  std::size_t firstLine_ = nextFirstLine();
  std::vector<Real> values_;
};

template <class Real>
struct CpuState {
  Components<Real> positions;   // [m]
  Components<Real> velocities;  // [m/s]
};

}  // namespace clothsim

// The CPU backend's particle state: one array per component, so that loops along a row run in vector
// registers.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

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

// Vectors, as three arrays. They lie in one allocation at equal distances, so that others can see them as a
// matrix without a copy (NumPy's strides). Copying into as many vectors keeps the place in memory.
template <class Real>
class Components {
 public:
  Component<Real> x, y, z;

  Components() = default;
  ~Components() = default;
  Components(const Components& other) : values_(other.values_) { divide(other.x.size_); }
  Components(Components&& other) noexcept : values_(std::move(other.values_)) {
    divide(other.x.size_);
    other.clear();
  }
  Components& operator=(const Components& other) {
    if (this == &other) return *this;
    values_ = other.values_;
    divide(other.x.size_);
    return *this;
  }
  Components& operator=(Components&& other) noexcept {
    if (this == &other) return *this;
    values_ = std::move(other.values_);
    divide(other.x.size_);
    other.clear();
    return *this;
  }

  // Another number of vectors, all of them 0; with the same number nothing changes.
  void resize(std::size_t size) {
    if (size == x.size_) return;
    values_.assign(size > 0 ? 3 * distanceFor(size) : 0, Real(0));
    divide(size);
  }
  // From x[i] to y[i] and from there to z[i], in numbers.
  [[nodiscard]] std::size_t distance() const { return distanceFor(x.size_); }

 private:
  // Whole cache lines, and five more: at a distance of whole pages the three would share their places in the
  // cache, and loads of neighbours would wait for stores that only look as if they went there.
  static constexpr std::size_t distanceFor(std::size_t size) {
    constexpr std::size_t line = 64 / sizeof(Real);
    return (size + line - 1) / line * line + 5 * line;
  }
  void divide(std::size_t size) {
    Real* place = values_.data();
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

  std::vector<Real> values_;
};

template <class Real>
struct CpuState {
  Components<Real> positions;   // [m]
  Components<Real> velocities;  // [m/s]
};

}  // namespace clothsim

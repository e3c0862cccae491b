// How a state comes to the CPU's arrays and back, and copies of them.
#include <algorithm>

#include "solver/cpu/arrays.h"
#include "solver/cpu/cpu_executor.h"

namespace clothsim {

template <class Real>
struct CpuExecutor<Real>::Copy final : ParticleCopy {
  Particles particles;
  Components<Real> elasticSlips;
  std::vector<Real> heldLimits;
  std::vector<cpu::RememberedSlip<Real>> pairSlips;
  Components<Real> movedBefore, acceleratedBefore;  // as cpu::ImplicitState's
  std::uint32_t usualSteps = 0;

  [[nodiscard]] std::size_t bytes() const override {
    return (7 * particles.inverseMasses.size() + 4 * heldLimits.size() + 6 * movedBefore.x.size()) *
               sizeof(Real) +
           pairSlips.size() * sizeof pairSlips[0];
  }
  void download(State& state) const override {
    const std::size_t count = particles.inverseMasses.size();
    state.positions.resize(count);
    state.velocities.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto place = static_cast<std::ptrdiff_t>(i);
      const Vec3f x = cpu::at(particles.state.positions, place).template cast<float>(),
                  v = cpu::at(particles.state.velocities, place).template cast<float>();
      state.positions[i] = {x.x, x.y, x.z, static_cast<float>(particles.inverseMasses[i])};
      state.velocities[i] = {v.x, v.y, v.z, 0};
    }
    state.elasticSlips.clear();
    for (std::size_t i = 0; i < elasticSlips.x.size(); ++i) {
      const Vec3f slip = cpu::at(elasticSlips, static_cast<std::ptrdiff_t>(i)).template cast<float>();
      state.elasticSlips.push_back({slip.x, slip.y, slip.z, static_cast<float>(heldLimits[i])});
    }
    state.pairSlips.clear();
    for (const cpu::RememberedSlip<Real>& known : pairSlips) {
      const Vec3f slip = known.slip.template cast<float>();
      state.pairSlips.push_back(
          {known.place, known.particles, slip.x, slip.y, slip.z, static_cast<float>(known.heldLimit)});
    }
    dropZeroSlips(state);
    clothsim::forgetHistory(state);
    if (usualSteps == 0) return;
    state.usualSteps = usualSteps;
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(movedBefore.x.size()); ++i)
      for (const Components<Real>* change : {&movedBefore, &acceleratedBefore}) {
        const Vec3f c = cpu::at(*change, i).template cast<float>();
        state.histories.push_back({c.x, c.y, c.z, 0});
      }
  }
};

template <class Real>
void CpuExecutor<Real>::upload(const State& state) {
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4 &x = state.positions[i], &v = state.velocities[i];
    const auto place = static_cast<std::ptrdiff_t>(i);
    cpu::put(particles_.state.positions, place, Vec3f{x.x, x.y, x.z}.cast<Real>());
    cpu::put(particles_.state.velocities, place, Vec3f{v.x, v.y, v.z}.cast<Real>());
    particles_.inverseMasses[i] = static_cast<Real>(x.w);
  }
  Components<Real>& slips = implicit_.planes.elasticSlips;
  if (!state.elasticSlips.empty()) slips.resize(state.elasticSlips.size());
  implicit_.planes.heldLimits.resize(slips.x.size());
  for (std::size_t i = 0; i < slips.x.size(); ++i) {
    const Particle4 slip = state.elasticSlips.empty() ? Particle4{} : state.elasticSlips[i];
    cpu::put(slips, static_cast<std::ptrdiff_t>(i), vectorOf(slip).template cast<Real>());
    implicit_.planes.heldLimits[i] = static_cast<Real>(slip.w);
  }
  implicit_.pairSlips.clear();
  for (const PairSlip& slip : hasSurface_ ? std::span(state.pairSlips) : std::span<const PairSlip>())
    implicit_.pairSlips.push_back({slip.place, slip.particles,
                                   Vec3f{slip.x, slip.y, slip.z}.template cast<Real>(),
                                   static_cast<Real>(slip.heldLimit)});
  setHistory(state);
  selfCollision_.restart();
}

template <class Real>
void CpuExecutor<Real>::setHistory(const State& state) {
  const std::size_t count = implicit_.movedBefore.x.size();
  implicit_.scalars.usualSteps = state.histories.size() == 2 * count ? state.usualSteps : 0;
  if (implicit_.scalars.usualSteps == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = static_cast<std::ptrdiff_t>(i);
    cpu::put(implicit_.movedBefore, place, vectorOf(state.histories[2 * i]).template cast<Real>());
    cpu::put(implicit_.acceleratedBefore, place, vectorOf(state.histories[2 * i + 1]).template cast<Real>());
  }
}

template <class Real>
void CpuExecutor<Real>::forgetHistory() {
  implicit_.scalars.usualSteps = 0;
}

template <class Real>
void CpuExecutor<Real>::download(State& state) {
  copy(nullptr)->download(state);
}

template <class Real>
std::vector<Particle4> CpuExecutor<Real>::positions(std::uint32_t first, std::uint32_t count) {
  std::vector<Particle4> result(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vec3f x = cpu::at(particles_.state.positions, first + k).template cast<float>();
    result[k] = {x.x, x.y, x.z, static_cast<float>(particles_.inverseMasses[first + k])};
  }
  return result;
}

template <class Real>
void CpuExecutor<Real>::setInverseMass(std::uint32_t particle, double inverseMass, bool rests) {
  particles_.inverseMasses[particle] = static_cast<Real>(inverseMass);
  if (rests) cpu::put(particles_.state.velocities, particle, Vec3<Real>{});
  forgetHistory();
}

template <class Real>
std::unique_ptr<ParticleCopy> CpuExecutor<Real>::copy(std::unique_ptr<ParticleCopy> reuse) {
  if (dynamic_cast<Copy*>(reuse.get()) == nullptr) reuse = std::make_unique<Copy>();
  auto& copy = static_cast<Copy&>(*reuse);
  copy.particles = particles_;
  copy.elasticSlips = implicit_.planes.elasticSlips;
  copy.heldLimits = implicit_.planes.heldLimits;
  copy.pairSlips = implicit_.pairSlips;
  copy.movedBefore = implicit_.movedBefore;
  copy.acceleratedBefore = implicit_.acceleratedBefore;
  copy.usualSteps =
      implicit_.movedBefore.x.size() == 0 ? 0 : std::min(implicit_.scalars.usualSteps, USUAL_STEPS);
  return reuse;
}

template <class Real>
bool CpuExecutor<Real>::restore(const ParticleCopy& copy) {
  const auto* own = dynamic_cast<const Copy*>(&copy);
  if (own == nullptr) return false;
  particles_ = own->particles;
  const std::size_t slips = implicit_.planes.elasticSlips.x.size();
  implicit_.planes.elasticSlips = own->elasticSlips;
  implicit_.planes.heldLimits = own->heldLimits;
  if (own->heldLimits.empty()) {  // nothing had been touched where now something may be
    implicit_.planes.elasticSlips.resize(slips);
    implicit_.planes.heldLimits.resize(slips);
  }
  implicit_.pairSlips.clear();
  if (hasSurface_) implicit_.pairSlips = own->pairSlips;
  implicit_.scalars.usualSteps = own->usualSteps;
  if (own->usualSteps > 0) {
    implicit_.movedBefore = own->movedBefore;
    implicit_.acceleratedBefore = own->acceleratedBefore;
  }
  return true;
}

template void CpuExecutor<float>::upload(const State&);
template void CpuExecutor<float>::setHistory(const State&);
template void CpuExecutor<float>::download(State&);
template void CpuExecutor<float>::forgetHistory();
template std::vector<Particle4> CpuExecutor<float>::positions(std::uint32_t, std::uint32_t);
template void CpuExecutor<float>::setInverseMass(std::uint32_t, double, bool);
template std::unique_ptr<ParticleCopy> CpuExecutor<float>::copy(std::unique_ptr<ParticleCopy>);
template bool CpuExecutor<float>::restore(const ParticleCopy&);
template void CpuExecutor<double>::upload(const State&);
template void CpuExecutor<double>::setHistory(const State&);
template void CpuExecutor<double>::download(State&);
template void CpuExecutor<double>::forgetHistory();
template std::vector<Particle4> CpuExecutor<double>::positions(std::uint32_t, std::uint32_t);
template void CpuExecutor<double>::setInverseMass(std::uint32_t, double, bool);
template std::unique_ptr<ParticleCopy> CpuExecutor<double>::copy(std::unique_ptr<ParticleCopy>);
template bool CpuExecutor<double>::restore(const ParticleCopy&);

}  // namespace clothsim

// How a state comes to the GPU and back: uploads, read-backs, snapshots on the device.
#include <cstddef>
#include <span>

#include "solver/gpu/gpu_executor.h"

namespace clothsim {

struct GpuExecutor::Copy final : ParticleCopy {
  gl::Buffer<Particle4> positions, velocities, elasticSlips;  // the last without a name where there are none
  GpuSurfaceContact::Slips pairSlips;
  GpuHistory history;

  [[nodiscard]] std::size_t bytes() const override {
    return positions.bytes() + velocities.bytes() + elasticSlips.bytes() + pairSlips.bytes() +
           history.bytes();
  }
  [[nodiscard]] bool needsContext() const override { return true; }
  void download(State& state) const override {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    state.positions = positions.download();
    state.velocities = velocities.download();
    state.elasticSlips = elasticSlips.download();
    state.pairSlips = pairSlips.download();
    dropZeroSlips(state);
    history.download(state);
  }
};

void GpuExecutor::upload(const State& state) {
  arrays_[Array::positions].buffer.upload(state.positions);
  arrays_[Array::velocities].buffer.upload(state.velocities);
  const std::span<const Particle4> slips = state.elasticSlips;
  arrays_.setElasticSlips(slips.empty() ? gl::Buffer<Particle4>()
                                        : gl::Buffer<Particle4>("elastic slips", slips));
  surfaceContact_.setSlips(state.pairSlips);
  arrays_.setHistory(state);
  selfCollision_.restart();
}

void GpuExecutor::download(State& state) {
  gl::checkContext();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  state.positions = arrays_[Array::positions].buffer.download();
  state.velocities = arrays_[Array::velocities].buffer.download();
  if (hasElasticSlips()) state.elasticSlips = arrays_[Array::elasticSlips].buffer.download();
  GpuSurfaceContact::Slips slips;
  surfaceContact_.copySlips(slips);
  state.pairSlips = slips.download();
  dropZeroSlips(state);
  GpuHistory history;
  arrays_.copyHistory(history);
  history.download(state);
}

void GpuExecutor::forgetHistory() { arrays_.forgetHistory(); }

// One a particle, in implicit steps with colliders.
bool GpuExecutor::hasElasticSlips() const {
  return arrays_[Array::elasticSlips].buffer.size() == cloth_->particleCount();
}

std::vector<Particle4> GpuExecutor::positions(std::uint32_t first, std::uint32_t count) {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return arrays_[Array::positions].buffer.download(first, count);
}

void GpuExecutor::setInverseMass(std::uint32_t particle, double inverseMass, bool rests) {
  const auto w = static_cast<float>(inverseMass);
  const Particle4 atRest;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  // The last component alone, so that nothing is read back.
  glNamedBufferSubData(arrays_[Array::positions].buffer.name(),
                       static_cast<GLintptr>(particle * sizeof(Particle4) + offsetof(Particle4, w)), sizeof w,
                       &w);
  if (rests) arrays_[Array::velocities].buffer.upload({&atRest, 1}, particle);
  arrays_.forgetHistory();
}

std::unique_ptr<ParticleCopy> GpuExecutor::copy(std::unique_ptr<ParticleCopy> reuse) {
  const std::size_t count = cloth_->particleCount();
  const auto* old = dynamic_cast<const Copy*>(reuse.get());
  if (old == nullptr || old->positions.size() != count) {
    auto fresh = std::make_unique<Copy>();
    fresh->positions = gl::Buffer<Particle4>("kept positions", count);
    fresh->velocities = gl::Buffer<Particle4>("kept velocities", count);
    reuse = std::move(fresh);
  }
  auto& copy = static_cast<Copy&>(*reuse);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  copy.positions.copyFrom(arrays_[Array::positions].buffer);
  copy.velocities.copyFrom(arrays_[Array::velocities].buffer);
  surfaceContact_.copySlips(copy.pairSlips);
  arrays_.copyHistory(copy.history);
  if (!hasElasticSlips())
    copy.elasticSlips = {};
  else if (copy.elasticSlips.name() == 0)
    copy.elasticSlips = gl::Buffer<Particle4>("kept elastic slips", count);
  if (hasElasticSlips()) copy.elasticSlips.copyFrom(arrays_[Array::elasticSlips].buffer);
  return reuse;
}

bool GpuExecutor::restore(const ParticleCopy& copy) {
  const auto* own = dynamic_cast<const Copy*>(&copy);
  if (own == nullptr) return false;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  arrays_[Array::positions].buffer.copyFrom(own->positions);
  arrays_[Array::velocities].buffer.copyFrom(own->velocities);
  arrays_.setElasticSlips(own->elasticSlips);
  surfaceContact_.restoreSlips(own->pairSlips);
  arrays_.restoreHistory(own->history);
  return true;
}

}  // namespace clothsim

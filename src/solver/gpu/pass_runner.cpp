#include "solver/gpu/pass_runner.h"

#include <algorithm>
#include <utility>

namespace clothsim {

template <class Dispatch>
void PassRunner::runTimed(const gl::Program& pass, const std::string& name, Dispatch dispatch) {
  pass.bind();
  if (timer_) timer_->begin();
  dispatch();
  if (sideBySide_)
    hasUnawaited_ = true;
  else
    awaitWrites();
  if (!timer_) return;
  timer_->end();
  timed_.push_back(name);
}

void PassRunner::awaitWrites() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  if (flushes_) glFlush();
}

void PassRunner::awaitAll() {
  sideBySide_ = false;
  if (std::exchange(hasUnawaited_, false)) awaitWrites();
}

void PassRunner::run(const gl::Program& pass, const std::string& name, std::uint32_t columns,
                     std::uint32_t rows) {
  runTimed(pass, name, [&] { gl::dispatch(columns, rows, pass.group().columns, pass.group().rows); });
}

void PassRunner::runGroups(const gl::Program& pass, const std::string& name, std::uint32_t groups) {
  runGroups(pass, name, groups, 1);
}

void PassRunner::runGroups(const gl::Program& pass, const std::string& name, std::uint32_t across,
                           std::uint32_t along) {
  runTimed(pass, name, [&] { gl::dispatch(across, along, 1, 1); });
}

void PassRunner::takeCounts(const gl::Buffer<Groups>& counts) {
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
  counts.bindDispatches();
}

void PassRunner::runIndirect(const gl::Program& pass, const std::string& name, std::size_t place) {
  runTimed(pass, name, [&] { gl::dispatchIndirect(place * sizeof(Groups)); });
}

void PassRunner::startTiming() {
  timer_.emplace();
  timed_.clear();
}

std::vector<PassTime> PassRunner::stopTiming() {
  std::vector<PassTime> times;
  const std::vector<double> seconds = timer_->takeSeconds();
  for (std::size_t i = 0; i < seconds.size(); ++i) addTime(times, timed_[i], seconds[i]);
  timer_.reset();
  return times;
}

}  // namespace clothsim

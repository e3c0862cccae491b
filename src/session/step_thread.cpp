#include "session/step_thread.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/error.h"
#include "core/thread_priority.h"
#include "core/thread_team.h"

namespace clothsim {

StepThread::StepThread(std::function<void()> whenDone)
    : whenDone_(std::move(whenDone)), thread_([this] { work(); }) {
  isReady_.wait(false);
}

StepThread::~StepThread() {
  stop();
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void StepThread::start(Session& session, int frames, double mostSeconds) {
  assert(!isBusy() && "one start() after the other");
  session_ = &session;
  frames_ = frames;
  mostSeconds_ = mostSeconds;
  done_ = stopped_ = false;
  {
    const std::lock_guard lock(mutex_);
    asked_ = true;
  }
  changed_.notify_all();
}

bool StepThread::waitFor(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, time, [this] { return done_.load(); });
}

StepThread::Result StepThread::take() {
  assert(isBusy() && "after start()");
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return done_.load(); });
  session_ = nullptr;
  return std::exchange(result_, {});
}

// Input and pictures come first, also before the threads that compute: these are as the one that starts them.
void StepThread::goBehind() {
  giveWay();
  try {
    ThreadTeam::shared();
  } catch (const Error&) {  // the first step says what is wrong
  }
  isReady_ = true;
  isReady_.notify_all();
}

void StepThread::work() {
  goBehind();
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return asked_ || ends_; });
    if (ends_) return;
    asked_ = false;
    lock.unlock();
    Result result = simulate();
    lock.lock();
    result_ = std::move(result);
    done_ = true;
    changed_.notify_all();
    if (whenDone_) whenDone_();
  }
}

StepThread::Result StepThread::simulate() {
  using Clock = std::chrono::steady_clock;
  Result result;
  const Clock::time_point start = Clock::now();
  const int before = session_->frame();
  try {
    for (int i = 0; i < frames_ && !result.divergence && result.seconds < mostSeconds_ && !stopped_; ++i) {
      result.divergence = session_->stepFrames(1);
      result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }
  } catch (...) {
    result.error = std::current_exception();
  }
  result.frames = std::max(0, session_->frame() - before);
  return result;
}

}  // namespace clothsim

// Simulates frames of a session on a thread of its own, while another thread shows the state before them. One
// thread has the session at a time: from start() to take() this one, else whoever called them.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "session/session.h"

namespace clothsim {

class StepThread {
 public:
  struct Result {
    int frames = 0;
    double seconds = 0;  // that they took
    std::optional<Divergence> divergence;
    std::exception_ptr error;
  };

  // The thread gives way to the others of the program, and so does ThreadTeam::shared() where it starts with
  // this. `whenDone` is called on the thread after each start(), for example to wake up who waits for events.
  explicit StepThread(std::function<void()> whenDone = {});
  ~StepThread();
  StepThread(const StepThread&) = delete;
  StepThread& operator=(const StepThread&) = delete;

  // Simulates frames of a session of the CPU backend, fewer once they have taken `mostSeconds`. The session's
  // poll is to ask isStopped().
  void start(Session& session, int frames, double mostSeconds);
  [[nodiscard]] bool isBusy() const { return session_ != nullptr; }  // between start() and take()
  [[nodiscard]] bool isDone() const { return done_; }                // take() will not wait
  [[nodiscard]] Result take();
  // Asks it to end after the current step; a frame that is not done is dropped.
  void stop() { stopped_ = true; }
  [[nodiscard]] bool isStopped() const { return stopped_; }
  // Whether it is done within that time.
  [[nodiscard]] bool waitFor(std::chrono::milliseconds time);

 private:
  void goBehind();
  void work();
  [[nodiscard]] Result simulate();

  std::function<void()> whenDone_;
  Session* session_ = nullptr;
  int frames_ = 0;
  double mostSeconds_ = 0;
  Result result_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool asked_ = false, ends_ = false;  // by mutex_
  std::atomic<bool> done_{false}, stopped_{false};
  std::atomic<bool> isReady_{false};
  std::thread thread_;
};

}  // namespace clothsim

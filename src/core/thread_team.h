// The threads that the CPU backend computes with. They wait for work in a short spin and then sleep, so that
// a core that is shared with others loses little; and whoever is awake takes over what the others have not
// begun, so that a thread which does not get its core holds up none but the few entries it works on.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace clothsim {

class ThreadTeam {
 public:
  static constexpr int MOST_THREADS = 256;
  // 1 to MOST_THREADS, the caller's among them.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  // The team of the program: as many threads as CLOTHSIM_THREADS says (1 to MOST_THREADS), otherwise as the
  // cores that the process may use. It starts with its first use. @throws UsageError for another value of the
  // variable
  static ThreadTeam& shared();
  // Another number of threads for it, while nobody computes. @throws UsageError as shared()
  static void setSharedThreads(int threads);

  [[nodiscard]] int threads() const { return static_cast<int>(workers_.size()) + 1; }

  [[nodiscard]] bool worksAlone() const {  // as WorkAlone asks for
    return worksAlone_.load(std::memory_order_relaxed);
  }

  // body(begin, end) for stretches of [first, end), in any order, on all threads; returns when all are done.
  // A thread takes `grain` entries at once, and less than 2 grains are not worth a second thread. The body
  // must not throw. Who calls while another thread does, or from a body, has its own done alone.
  template <class Body>
  void forEachRange(std::uint32_t first, std::uint32_t end, std::uint32_t grain, const Body& body) {
    const auto range = [](const void* context, std::uint32_t begin, std::uint32_t finish) noexcept {
      (*static_cast<const Body*>(context))(begin, finish);
    };
    if (workers_.empty() || end - first < 2 * grain || worksAlone() ||
        isBusy_.test_and_set(std::memory_order_acquire)) {
      range(&body, first, end);
      return;
    }
    run(first, end, grain, range, &body);
    isBusy_.clear(std::memory_order_release);
  }
  // body(i) for each i in them.
  template <class Body>
  void forEach(std::uint32_t first, std::uint32_t end, std::uint32_t grain, const Body& body) {
    forEachRange(first, end, grain, [&](std::uint32_t begin, std::uint32_t finish) {
      for (std::uint32_t i = begin; i < finish; ++i) body(i);
    });
  }

 private:
  friend class WorkAlone;
  using Range = void (*)(const void* context, std::uint32_t begin, std::uint32_t end) noexcept;
  // What is left of a thread's own part of a job. `next` is tagged with the job in its upper half: who comes
  // late finds another tag and takes nothing.
  struct alignas(64) Part {
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::uint32_t> end{0};
  };

  void run(std::uint32_t first, std::uint32_t end, std::uint32_t grain, Range range, const void* context);
  void work(std::size_t self);
  void takePart(std::uint32_t job, std::size_t part);
  void takeAll(std::uint32_t job, std::size_t self);

  std::atomic<bool> worksAlone_{false};
  std::atomic_flag isBusy_;
  std::vector<Part> parts_;  // one a thread
  std::atomic<Range> range_{nullptr};
  std::atomic<const void*> context_{nullptr};
  std::atomic<std::uint32_t> grain_{1};
  alignas(64) std::atomic<int> job_{0};  // number of the newest; -1: the end
  std::atomic<int> sleepers_{0};
  alignas(64) std::atomic<int> left_{0};  // entries of the job that are not done
  std::atomic<bool> isAwaited_{false};
  std::vector<std::thread> workers_;
};

// While it lives, what begins is done by its caller alone: where others want the cores, threads that wait for
// each other lose more than a second one gains. One at a time, on any thread.
class WorkAlone {
 public:
  explicit WorkAlone(ThreadTeam& team, bool alone = true) : team_(team) {
    team_.worksAlone_.store(alone, std::memory_order_relaxed);
  }
  ~WorkAlone() { team_.worksAlone_.store(false, std::memory_order_relaxed); }
  WorkAlone(const WorkAlone&) = delete;
  WorkAlone& operator=(const WorkAlone&) = delete;

 private:
  ThreadTeam& team_;
};

}  // namespace clothsim

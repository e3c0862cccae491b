#include "core/thread_team.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/spin.h"

namespace clothsim {
namespace {

// First entry of a part that waits for its job; no end lies behind it.
constexpr std::uint32_t NOTHING_LEFT = 0xffffffff;

int threadsWanted() {
  const char* text = std::getenv("CLOTHSIM_THREADS");
  if (text == nullptr)
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, ThreadTeam::MOST_THREADS);
  const std::string_view digits(text);
  int count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc{} || end != digits.data() + digits.size() || count < 1 ||
      count > ThreadTeam::MOST_THREADS)
    throw UsageError("CLOTHSIM_THREADS is \"" + std::string(digits) +
                     "\"; set a number of threads from 1 to " + std::to_string(ThreadTeam::MOST_THREADS) +
                     ", or unset it for one a core");
  return count;
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) : parts_(static_cast<std::size_t>(threads)) {
  assert(threads >= 1 && threads <= MOST_THREADS && "a team has 1 to 256 threads");
  try {
    for (int k = 1; k < threads; ++k) workers_.emplace_back([this, k] { work(static_cast<std::size_t>(k)); });
  } catch (const std::exception&) {
    // The system has no more threads, or memory for them: those that there are take over the parts of the
    // others.
  }
}

ThreadTeam::~ThreadTeam() {
  job_.store(-1);
  job_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

namespace {

// Never destroyed: exit() may come while another thread computes, as when Xlib loses the screen in the midst
// of a step. That thread's next job would undo the order to end, and the team would be waited for without
// end.
std::unique_ptr<ThreadTeam>& sharedTeam() {
  static auto& team = *new auto(std::make_unique<ThreadTeam>(threadsWanted()));
  return team;
}

}  // namespace

ThreadTeam& ThreadTeam::shared() { return *sharedTeam(); }

void ThreadTeam::setSharedThreads(int threads) { sharedTeam() = std::make_unique<ThreadTeam>(threads); }

void ThreadTeam::run(std::uint32_t first, std::uint32_t end, std::uint32_t grain, Range range,
                     const void* context) {
  const auto job = static_cast<std::uint32_t>(job_.load(std::memory_order_relaxed)) % 0x7fffffffU + 1;
  range_.store(range, std::memory_order_relaxed);
  context_.store(context, std::memory_order_relaxed);
  grain_.store(grain, std::memory_order_relaxed);
  left_.store(static_cast<int>(end - first), std::memory_order_relaxed);
  const std::uint64_t count = end - first, parts = parts_.size();
  for (std::uint64_t k = 0; k < parts; ++k) {
    const auto partFirst = first + static_cast<std::uint32_t>(count * k / parts);
    // The part changes hands before its end does: a thread that is late with the job before must not take
    // the new end for the old one.
    parts_[k].next.store(std::uint64_t{job} << 32 | NOTHING_LEFT, std::memory_order_relaxed);
    parts_[k].end.store(first + static_cast<std::uint32_t>(count * (k + 1) / parts),
                        std::memory_order_release);
    parts_[k].next.store(std::uint64_t{job} << 32 | partFirst, std::memory_order_release);
  }
  job_.store(static_cast<int>(job));
  if (sleepers_.load() > 0) job_.notify_all();

  takeAll(job, 0);
  const auto isDone = [&] { return left_.load(std::memory_order_acquire) == 0; };
  if (spinUntil(isDone)) return;
  isAwaited_.store(true);
  for (int left = left_.load(); left != 0; left = left_.load()) left_.wait(left);
  isAwaited_.store(false);
}

// What a part holds of the job, a grain at a time.
void ThreadTeam::takePart(std::uint32_t job, std::size_t part) {
  Part& own = parts_[part];
  std::uint64_t next = own.next.load(std::memory_order_acquire);
  while (next >> 32 == job) {
    const auto first = static_cast<std::uint32_t>(next);
    const std::uint32_t end = own.end.load(std::memory_order_acquire);
    if (first >= end) return;
    const std::uint32_t stop = std::min(end, first + grain_.load(std::memory_order_relaxed));
    const Range range = range_.load(std::memory_order_relaxed);
    const void* context = context_.load(std::memory_order_relaxed);
    // What was read belongs to the job if the part still does: a job ends only when all of it was taken, and
    // the next one changes `next` before anything else of the part.
    if (!own.next.compare_exchange_weak(next, std::uint64_t{job} << 32 | stop, std::memory_order_acq_rel))
      continue;
    range(context, first, stop);
    const int taken = static_cast<int>(stop - first);
    if (left_.fetch_sub(taken) == taken && isAwaited_.load()) left_.notify_all();
    next = own.next.load(std::memory_order_acquire);
  }
}

// Its own part first, so that a thread meets the same entries in every pass; then what others have left.
void ThreadTeam::takeAll(std::uint32_t job, std::size_t self) {
  for (std::size_t k = 0; k < parts_.size(); ++k) takePart(job, (self + k) % parts_.size());
}

void ThreadTeam::work(std::size_t self) {
  for (int seen = 0;;) {
    const auto isNew = [&] { return job_.load(std::memory_order_acquire) != seen; };
    if (!spinUntil(isNew)) {
      ++sleepers_;
      job_.wait(seen);
      --sleepers_;
    }
    seen = job_.load();
    if (seen < 0) return;
    takeAll(static_cast<std::uint32_t>(seen), self);
  }
}

}  // namespace clothsim

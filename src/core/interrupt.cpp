#include "core/interrupt.h"

#include <array>
#include <csignal>

#include "core/error.h"

namespace clothsim {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int) { interrupted = 1; }

constexpr std::array caughtSignals{SIGINT, SIGHUP, SIGTERM, SIGXCPU};

}  // namespace

void catchInterrupts() {
  for (const int signal : caughtSignals) {
    struct sigaction action {
    }, before{};
    action.sa_handler = remember;
    // SIGXCPU is repeated every second until the hard limit kills the process, so that its handler must stay.
    action.sa_flags = signal == SIGXCPU ? 0 : static_cast<int>(SA_RESETHAND);
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);  // a parent may have it ignored, which would hide how ffmpeg ended
}

void finishAfterInterrupt() {
  for (const int signal : caughtSignals) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler == remember) std::signal(signal, signal == SIGXCPU ? SIG_IGN : SIG_DFL);
  }
  interrupted = 0;
}

bool isInterrupted() { return interrupted != 0; }

void stopIfInterrupted() {
  if (isInterrupted()) throw Interrupted("interrupted; no file was left half written");
}

}  // namespace clothsim

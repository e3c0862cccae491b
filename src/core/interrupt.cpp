#include "core/interrupt.h"

#include <csignal>

#include "core/error.h"

namespace clothsim {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int) { interrupted = 1; }

}  // namespace

void catchInterrupts() {
  for (const int signal : {SIGINT, SIGHUP, SIGTERM, SIGXCPU}) {
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

bool isInterrupted() { return interrupted != 0; }

void stopIfInterrupted() {
  if (isInterrupted()) throw SimulationError("interrupted; no file was left half written");
}

}  // namespace clothsim

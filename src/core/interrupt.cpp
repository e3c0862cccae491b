#include "core/interrupt.h"

#include <csignal>

#include "core/error.h"

namespace clothsim {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void remember(int) { interrupted = 1; }

}  // namespace

void catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool isInterrupted() { return interrupted != 0; }

void stopIfInterrupted() {
  if (isInterrupted()) throw SimulationError("interrupted; no file was left half written");
}

}  // namespace clothsim

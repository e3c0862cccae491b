// Ctrl-C and a request to end (SIGINT, SIGTERM) let a command stop between two frames and tidy up after
// itself; a second one ends it at once.
#pragma once

namespace clothsim {

void catchInterrupts();

// Whether an interrupt has come. Solver::step() ends before its next step then.
[[nodiscard]] bool isInterrupted();

// For loops that take long. @throws SimulationError once an interrupt has come
void stopIfInterrupted();

}  // namespace clothsim

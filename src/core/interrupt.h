// Ctrl-C, a terminal that closes and a request to end (SIGINT, SIGHUP, SIGTERM, SIGXCPU) let a command stop
// between two frames and tidy up after itself; a second one ends it at once.
#pragma once

namespace clothsim {

// What was ignored from the start, as by nohup, stays so. A file that grows beyond the limit of its size and
// a pipe whose reader has gone (SIGXFSZ, SIGPIPE) become errors of writing rather than sudden ends.
void catchInterrupts();

// Whether an interrupt has come. Solver::step() ends before its next step then.
[[nodiscard]] bool isInterrupted();

// For loops that take long. @throws SimulationError once an interrupt has come
void stopIfInterrupted();

}  // namespace clothsim

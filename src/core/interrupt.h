// Ctrl-C, a terminal that closes and a request to end (SIGINT, SIGHUP, SIGTERM, SIGXCPU) let a command stop
// between two frames and tidy up. A second one ends it at once.
#pragma once

namespace clothsim {

// Signals that were ignored from the start, as under nohup, stay ignored. A file that exceeds the limit of
// file sizes and a pipe whose reader has gone (SIGXFSZ, SIGPIPE) become errors of writing instead of ending
// the program.
void catchInterrupts();

// Whether an interrupt has come. Solver::step() then ends before its next step.
[[nodiscard]] bool isInterrupted();

// For loops that take long. @throws Interrupted once an interrupt has come
void stopIfInterrupted();

// For a command that has stopped, and now finishes files that are worth keeping: the interrupt counts as
// answered, and another one ends the program at once.
void finishAfterInterrupt();

}  // namespace clothsim

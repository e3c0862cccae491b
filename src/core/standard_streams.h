// Standard input, output and error, as the program finds and leaves them.
#pragma once

namespace clothsim {

// If one of the three was closed (`clothsim run ... >&-`), the next file that is opened would take its number
// and receive what is printed. This takes those numbers first, with descriptors to which writing fails.
void holdStandardStreams();

// Flushes what was printed. A reader that has closed its end, as in `clothsim describe | head`, is no error.
// @throws InputOutputError when some of it was lost, as on a full disk
void finishStandardOutput();

}  // namespace clothsim

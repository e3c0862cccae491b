// Standard input, output and error, as the program finds and leaves them.
#pragma once

namespace clothsim {

// Where one of the three was closed (`clothsim run ... >&-`), the next file opened would take its number, and
// get what is printed. Their numbers are held instead; writing to them fails.
void holdStandardStreams();

// Sends what was printed on its way. A reader that has gone, as of `clothsim describe | head`, has had
// enough.
// @throws InputOutputError when some of it was lost, as on a full disk
void finishStandardOutput();

}  // namespace clothsim

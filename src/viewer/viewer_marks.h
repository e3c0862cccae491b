// Marks over the picture for what the hands do: where they hold, cut and blow.
#pragma once

#include "viewer/hands.h"

namespace clothsim {

void drawMarks(const HandMarks& marks);

}  // namespace clothsim

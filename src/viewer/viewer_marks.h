// Draws marks over the picture where the mouse grabs, cuts and blows.
#pragma once

#include "viewer/mouse_tools.h"

namespace clothsim {

void drawMarks(const MouseMarks& marks);

}  // namespace clothsim

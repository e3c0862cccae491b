// The typeface of everything that the program writes into pictures and windows.
#pragma once

#include <string>

struct ImFont;
struct ImFontAtlas;

namespace clothsim {

// Adds it in a size [pixels]: Roboto or DejaVu Sans where the system has them, else Dear ImGui's own bitmap
// font.
// @param crisp  whole pixels, to be copied; otherwise it may be drawn at fractions of pixels
ImFont* addTypeface(ImFontAtlas& atlas, float size, bool crisp = false);

}  // namespace clothsim

// Where in a picture the backdrop shows the stage's ground alone, or alone what is behind it: a software
// renderer works out what a shader may need for every pixel, so that drawing both takes twice as long.
#pragma once

#include <vector>

#include "render/flat_bounds.h"
#include "render/stage_look.h"
#include "shared/render_layout.h"

namespace clothsim {

enum class BackdropShows { both, ground, beyond };

struct BackdropPart {
  PixelRect pixels;
  BackdropShows shows;
};

// The parts of the picture that this frame looks at; together they are all of it.
[[nodiscard]] std::vector<BackdropPart> backdropParts(const shared::RenderFrame& frame, GroundShape shape);

}  // namespace clothsim

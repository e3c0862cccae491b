// What the weaves and knits of the model fabric are beside their pictures (tools/make_textures).
#pragma once

#include <string_view>

namespace clothsim {

struct Weave {
  double across = 16, along = 16;  // threads of the warp and of the weft, or wales and courses, in a repeat
  double distance = 1;             // from one thread of the weft, or course, to the next, in that of the warp
  double sheen = 1;                // of loose fibres, times what the gloss leaves of it
  double fuzz = 0;                 // how far fibres stand off it at least [m]
  double fuzzCover = 0.24;         // optical depth of those fibres, seen from straight ahead
  double reverseGloss = 1;         // of the reverse, as a part of the gloss
  double unevenness = 0;           // how far the dye of warp threads differs, as a part of it
  bool isKnit = false;             // whose reverse is no mirror image of its face
  bool isPile = false;             // upright on the front, over a ground that the back shows
  bool weftIsOther = false;        // its own colour, `back_color`, on both sides
};
[[nodiscard]] Weave weaveOf(std::string_view name);

}  // namespace clothsim

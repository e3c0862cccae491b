#include "render/weaves.h"

namespace clothsim {

Weave weaveOf(std::string_view name) {
  // Warp-faced, of smooth cotton, with a warp that is dyed on its outside only and takes the dye unevenly.
  if (name == "denim") return {.distance = 1.4, .sheen = 0.08, .unevenness = 0.35, .weftIsOther = true};
  if (name == "jersey") return {.across = 12, .distance = 0.75, .isKnit = true};
  if (name == "satin") return {.sheen = 0.6, .reverseGloss = 0.7};
  if (name == "velvet") return {.sheen = 1.6, .fuzz = 0.0015, .fuzzCover = 3, .isPile = true};
  if (name == "none") return {.sheen = 0};  // a film
  return {};
}

}  // namespace clothsim

// Which shell of fuzz is drawn: its height and its depth as parts of the fibres' length, and how far it is seen, 0 to 1.
#include "shared/render_layout.h"

layout(location = FUZZ_SHELL_UNIFORM) uniform vec3 shell;

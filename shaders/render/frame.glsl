// The uniform block that every drawing shader reads.
#include "shared/render_layout.h"

layout(std140, binding = RENDER_FRAME_BINDING) uniform RenderFrameBlock { RenderFrame frame; };

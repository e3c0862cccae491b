// The uniform block that every drawing shader reads.
#include "shared/render_layout.h"

layout(std140, binding = RENDER_FRAME_BINDING) uniform RenderFrameBlock { RenderFrame frame; };

// Whether the picture is one exposure of a mean (src/render/exposure.h).
bool isExposure() { return frame.toSky[0].w > 0.0; }

// The uniform block that every drawing shader reads.
#include "shared/render_layout.h"

layout(std140, binding = RENDER_FRAME_BINDING) uniform RenderFrameBlock { RenderFrame frame; };

// Whether the picture is one exposure of a mean (src/render/exposure.h). Known when the shader is compiled: llvmpipe would
// run what exposures need for every picture.
#ifdef EXPOSURE
bool isExposure() { return true; }
#else
bool isExposure() { return false; }
#endif

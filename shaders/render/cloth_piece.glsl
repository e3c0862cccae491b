// The grid that is being drawn or measured.
#include "shared/render_layout.h"

layout(std140, binding = CLOTH_GRID_BINDING) uniform ClothPieceBlock { ClothPiece piece; };

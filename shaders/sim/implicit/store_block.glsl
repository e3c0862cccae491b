// Stores a block of a level's matrix, and its inverse when it is on the diagonal.
layout(std430, binding = COARSE_BLOCKS_BINDING) writeonly buffer CoarseBlocks { vec4 newBlocks[]; };
layout(std430, binding = COARSE_INVERSES_BINDING) writeonly buffer CoarseInverses { vec4 newInverses[]; };

// Minus the inverse of a symmetric matrix, column by column, in place: every pivot in turn is swept out (Goodnight 1979, "A
// tutorial on the SWEEP operator").
void sweepOut(inout float matrix[36]) {
  float scales[6], column[6];
  for (int k = 0; k < 6; ++k) scales[k] = matrix[7 * k];
  for (int k = 0; k < 6; ++k) {
    float inverse = inversePivot(matrix[7 * k], scales[k]), scale = scales[k];
    for (int i = 0; i < 6; ++i) {
      column[i] = matrix[6 * k + i];
      scales[i] = scaleAfter(scales[i], column[i], inverse, scale);
    }
    for (int j = 0; j < 6; ++j) {
      precise float other = column[j] * inverse;
      for (int i = 0; i < 6; ++i) {
        precise float updated = matrix[6 * j + i] - column[i] * other;
        precise float swept = column[i] * inverse;
        float next = i != k && j != k ? updated : i == j ? -inverse : i == k ? other : swept;
        matrix[6 * j + i] = canonical(next);
      }
    }
  }
}

void storeBlock(RigidBlock block, uint number, uvec2 pair) {
  uint first = BLOCK_TEXELS * number;
  float matrix[36];
  for (uint c = 0u; c < 3u; ++c) {
    vec3 tt = canonical(block.tt[c]), tr = canonical(block.tr[c]), rt = canonical(block.rt[c]), rr = canonical(block.rr[c]);
    newBlocks[first + c] = vec4(tt, 0.0);
    newBlocks[first + 3u + c] = vec4(tr, 0.0);
    newBlocks[first + 6u + c] = vec4(rt, 0.0);
    newBlocks[first + 9u + c] = vec4(rr, 0.0);
    for (uint r = 0u; r < 3u; ++r) {
      matrix[6u * c + r] = tt[r];
      matrix[6u * c + 3u + r] = rt[r];
      matrix[6u * (3u + c) + r] = tr[r];
      matrix[6u * (3u + c) + 3u + r] = rr[r];
    }
  }
  if (pair.x != pair.y) return;
  sweepOut(matrix);
  uint inverse = BLOCK_TEXELS * pair.x;
  for (uint c = 0u; c < 3u; ++c) {
    uint left = 6u * c, right = 6u * (3u + c);
    newInverses[inverse + c] = vec4(matrix[left], matrix[left + 1u], matrix[left + 2u], 0.0);
    newInverses[inverse + 3u + c] = vec4(matrix[right], matrix[right + 1u], matrix[right + 2u], 0.0);
    newInverses[inverse + 6u + c] = vec4(matrix[left + 3u], matrix[left + 4u], matrix[left + 5u], 0.0);
    newInverses[inverse + 9u + c] = vec4(matrix[right + 3u], matrix[right + 4u], matrix[right + 5u], 0.0);
  }
}

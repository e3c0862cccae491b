// Blocks of 6 x 6 that join two aggregates, which move as rigid bodies (src/solver/implicit.h); the twin of
// src/solver/cpu/rigid_block.h.

// A translation and a rotation, or a force and a torque.
struct RigidVector {
  vec3 translation, rotation;
};

// Forces and motions of all vertices are about one origin: as they are, they add up from level to level. Here a force as it
// is about `center`, where its torque is another, and a motion about `center` as it is about the origin.
RigidVector forceAbout(vec3 center, RigidVector force) {
  precise vec3 torque = force.rotation - crossProduct(center, force.translation);
  return RigidVector(force.translation, torque);
}
RigidVector motionFrom(vec3 center, RigidVector motion) {
  precise vec3 translation = motion.translation + crossProduct(center, motion.rotation);
  return RigidVector(translation, motion.rotation);
}

// Columns of four 3 x 3 matrices: rows by columns, t for translation, r for rotation.
struct RigidBlock {
  vec3 tt[3], tr[3], rt[3], rr[3];
};

RigidBlock noBlock() {
  vec3 none[3] = vec3[3](vec3(0.0), vec3(0.0), vec3(0.0));
  return RigidBlock(none, none, none, none);
}

void transpose3(vec3 a[3], out vec3 result[3]) {
  result[0] = vec3(a[0].x, a[1].x, a[2].x);
  result[1] = vec3(a[0].y, a[1].y, a[2].y);
  result[2] = vec3(a[0].z, a[1].z, a[2].z);
}
RigidBlock transposedBlock(RigidBlock a) {
  RigidBlock result;
  transpose3(a.tt, result.tt);
  transpose3(a.rt, result.tr);
  transpose3(a.tr, result.rt);
  transpose3(a.rr, result.rr);
  return result;
}

// a (e_c x q)
vec3 turnedColumn(vec3 a[3], int c, vec3 q) {
  precise vec3 first = q.y * a[2] - q.z * a[1];
  precise vec3 second = q.z * a[0] - q.x * a[2];
  precise vec3 third = q.x * a[1] - q.y * a[0];
  return c == 0 ? first : c == 1 ? second : third;
}

// The block as bodies see it whose centers lie `p` and `q` before those of its own: s S(p)^T block S(q), S(p) (t, r) =
// (t + r x p, r).
RigidBlock shiftedBlock(float s, RigidBlock block, vec3 p, vec3 q) {
  RigidBlock part;
  for (int c = 0; c < 3; ++c) {
    precise vec3 tr = block.tr[c] + turnedColumn(block.tt, c, q);
    precise vec3 rr = block.rr[c] + turnedColumn(block.rt, c, q);
    precise vec3 partTT = s * block.tt[c];
    precise vec3 partTR = s * tr;
    precise vec3 partRT = s * (block.rt[c] + crossProduct(p, block.tt[c]));
    precise vec3 partRR = s * (rr + crossProduct(p, tr));
    part.tt[c] = partTT;
    part.tr[c] = partTR;
    part.rt[c] = partRT;
    part.rr[c] = partRR;
  }
  return part;
}

void addBlock(inout RigidBlock sum, RigidBlock part) {
  for (int c = 0; c < 3; ++c) {
    precise vec3 tt = sum.tt[c] + part.tt[c];
    precise vec3 tr = sum.tr[c] + part.tr[c];
    precise vec3 rt = sum.rt[c] + part.rt[c];
    precise vec3 rr = sum.rr[c] + part.rr[c];
    sum.tt[c] = tt;
    sum.tr[c] = tr;
    sum.rt[c] = rt;
    sum.rr[c] = rr;
  }
}

vec3 timesColumns(vec3 m[3], vec3 u) {
  precise vec3 product = (u.x * m[0] + u.y * m[1]) + u.z * m[2];
  return product;
}
RigidVector timesRigid(RigidBlock a, RigidVector v) {
  precise vec3 translation = timesColumns(a.tt, v.translation) + timesColumns(a.tr, v.rotation);
  precise vec3 rotation = timesColumns(a.rt, v.translation) + timesColumns(a.rr, v.rotation);
  return RigidVector(translation, rotation);
}

RigidBlock loadBlock(samplerBuffer stored, uint number) {
  RigidBlock block;
  int first = int(BLOCK_TEXELS * number);
  for (int c = 0; c < 3; ++c) {
    block.tt[c] = texelFetch(stored, first + c).xyz;
    block.tr[c] = texelFetch(stored, first + 3 + c).xyz;
    block.rt[c] = texelFetch(stored, first + 6 + c).xyz;
    block.rr[c] = texelFetch(stored, first + 9 + c).xyz;
  }
  return block;
}

// The reciprocal of a pivot; 0 where less of it is left than a part of its scale, which may be rounding alone, or where nothing
// is: that unknown stays 0.
float inversePivot(float pivot, float scale) {
  precise float least = uintBitsToFloat(0x35800000u) * scale;  // LEAST_PIVOT
  bool isSafe = scale > uintBitsToFloat(0x21800000u) && pivot >= least;  // 2^-60
  return isSafe ? reciprocal(pivot) : 0.0;
}

// The scale of a pivot, to which its rounding is in proportion: the entry that it began as, plus what each pivot swept out before
// took from it, times the ratio of that pivot's scale to that pivot. `entry` joins it to the pivot that is swept out.
float scaleAfter(float scale, float entry, float inverse, float sweptScale) {
  precise float enlarged = inverse * sweptScale;
  precise float result = scale + ((entry * inverse) * entry) * enlarged;
  return result;
}

// Sums over all particles, in an order that depends on nothing (shared/implicit.h), and what conjugate gradients or the line
// search do with them. SUM_LANES invocations a work group, a group for each block of particles; the last group to finish adds
// up the blocks. Needs `step`.
#include "sim/exact_math.glsl"
#include "sim/implicit/scalars.glsl"
#include "sim/last_group.glsl"

#if SUM_KIND == SUM_LENGTH
#define Sum vec4
#elif SUM_KIND == SUM_UPDATE
#define Sum vec2
#else
#define Sum float
#endif

layout(std430, binding = PARTIAL_SUMS_BINDING) coherent buffer PartialSums { Sum partialSums[]; };

// Two values become one: their sum; of updates the larger one.
Sum joined(Sum a, Sum b) {
#if SUM_KIND == SUM_UPDATE
  return vec2(a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y);
#else
  precise Sum sum = a + b;
  return sum;
#endif
}

// Joins what the lanes of a work group hold as a tree, in two goes; lane 0 gets the result.
shared Sum laneSums[SUM_LANES];

Sum joinedTwo(uint first, uint stride) { return joined(laneSums[first], laneSums[first + 8u * stride]); }
Sum joinedFour(uint first, uint stride) { return joined(joinedTwo(first, stride), joinedTwo(first + 4u * stride, stride)); }
Sum joinedEight(uint first, uint stride) { return joined(joinedFour(first, stride), joinedFour(first + 2u * stride, stride)); }
Sum joinedSixteen(uint first, uint stride) { return joined(joinedEight(first, stride), joinedEight(first + stride, stride)); }

Sum addLanes(Sum own) {
  uint lane = gl_LocalInvocationIndex;
  laneSums[lane] = own;
  barrier();
  if (lane < 16u) laneSums[lane] = joinedSixteen(lane, 16u);
  barrier();
  Sum total = Sum(0.0);
  if (lane == 0u) total = joinedSixteen(0u, 1u);
  return total;
}

#if SUM_KIND == SUM_UPDATE
float squareOf(vec3 v) {
  float square = sumOfProducts(v, v);
  return square < LARGE_SQUARE ? square : LARGE_SQUARE;
}
Sum squaresOf(vec3 update, vec3 displacement) { return vec2(squareOf(update), squareOf(displacement)); }
#endif

// a / b; 0 where b is none or too small for a reciprocal.
float quotient(float a, float b) {
  precise float result = a * reciprocal(b);
  return b > uintBitsToFloat(0x08800000u) ? result : 0.0;  // 2^-110
}

#if SUM_KIND == SUM_STEP || SUM_KIND == SUM_LENGTH
void refuseExactHessian() {
  scalars.isSystemSolved = SYSTEM_LOST;
  scalars.hessian = HESSIAN_REFUSED;
}
#endif

void takeTotal(Sum total) {
#if SUM_KIND == SUM_FIRST
  float residual = total < 0.0 ? 0.0 : total;
  precise float least = step.systemTolerance * residual;
  float sufficient = scalars.sufficientResidual;
  scalars.residual = residual;
  scalars.leastResidual = scalars.newtonSteps > 0u && least < sufficient ? sufficient : least;
  scalars.kept = 0.0;
  precise float most = LOST_RISE * residual;
  scalars.mostResidual = most;
  scalars.isSystemSolved = total < 0.0 ? SYSTEM_LOST : 0u;
#elif SUM_KIND == SUM_STEP
  scalars.stepSize = quotient(scalars.residual, total);
  scalars.iterations += 1u;
  if (total < 0.0) refuseExactHessian();
#elif SUM_KIND == SUM_NEXT
  float residual = total < 0.0 ? 0.0 : total;
  scalars.kept = quotient(residual, scalars.residual);
  scalars.residual = residual;
  bool isLost = total < 0.0 || total > scalars.mostResidual;
  scalars.isSystemSolved = isLost ? SYSTEM_LOST : residual <= scalars.leastResidual ? 1u : 0u;
#elif SUM_KIND == SUM_UPDATE
  precise float leastMotion = step.leastMotion * step.leastMotion;
  float motion = total.y < leastMotion ? leastMotion : total.y;
  precise float square = total.x * reciprocal(motion);
  precise float update = square * inverseSquareRoot(square);
  bool touches = step.colliderCount != 0u || scalars.pairs != 0u;
  bool isExact = scalars.hessian == HESSIAN_EXACT && scalars.isSystemSolved == 1u;
  precise float small = (touches ? TINY_UPDATE_IN_CONTACT : TINY_UPDATE) * update;
  bool isTiny = small <= step.tolerance;
  float last = scalars.lastUpdate;
  precise float most = 2.0 * step.tolerance;
  precise float squaredUpdate = update * update;
  precise float allowed = most * (last - update);
  precise float lastTimesUpdate = last * update;
  precise float allowedBefore = most * (scalars.updateBefore - last);
  bool isFalling = (touches || scalars.hessian == HESSIAN_REFUSED) && scalars.newtonSteps > 0u && squaredUpdate <= allowed &&
                   (touches || scalars.newtonSteps <= 2u || lastTimesUpdate <= allowedBefore);
  scalars.updateBefore = last;
  scalars.lastUpdate = update;
  precise float tolerated = step.toleratedStiffness * motion;
  bool isNextThorough = scalars.newtonSteps + 1u < THOROUGH_NEWTON_STEPS;
  float later = touches ? SUFFICIENT_RESIDUAL : SUFFICIENT_RESIDUAL_APART;
  float part = !isNextThorough ? later : touches ? 0.0 : EARLY_RESIDUAL;
  precise float sufficient = part * (step.toleratedStiffness * total.y);
  scalars.sufficientResidual = sufficient;
  bool isFollowed = scalars.isSystemSolved != SYSTEM_LOST &&
                    (scalars.isSystemSolved != 0u || scalars.residual <= tolerated);
  bool isConfirmed = !touches || scalars.newtonSteps > 0u;  // the first one takes predicted contacts
  scalars.isStepSolved = isConfirmed && update <= step.tolerance && isFollowed && (isExact || isTiny || isFalling) ? 1u : 0u;
  scalars.isSystemSolved = 0u;
  precise float exactBelow = EXACT_BELOW * step.tolerance;
  if (!touches && scalars.hessian != HESSIAN_REFUSED && update <= exactBelow)
    scalars.hessian = HESSIAN_EXACT;
  else if (scalars.hessian == HESSIAN_EXACT)
    scalars.hessian = HESSIAN_REFUSED;
  scalars.newtonSteps += 1u;
#else
  bool mayStay = scalars.hessian == HESSIAN_EXACT || scalars.isSystemSolved == SYSTEM_LOST;
  float shortest = total.w <= 0.0 || !mayStay ? 0.125 : 0.0;
  scalars.newtonLength = total.x <= 0.0 ? 1.0 : total.y <= 0.0 ? 0.5 : total.z <= 0.0 ? 0.25 : shortest;
  if (scalars.newtonLength == 0.0) refuseExactHessian();
#endif
}

// `sum`: what a lane has of the block of its group.
void addToTotal(Sum sum) {
  uint lane = gl_LocalInvocationIndex, group = gl_WorkGroupID.x, groups = gl_NumWorkGroups.x;
  Sum block = addLanes(sum);
  if (lane == 0u) partialSums[group] = block;
  if (!isLastGroupOf(gl_NumWorkGroups.x)) return;
  precise Sum all = Sum(0.0);
  for (uint k = lane; k < groups; k += uint(SUM_LANES)) all = joined(all, partialSums[k]);
  Sum total = addLanes(all);
  if (lane == 0u) takeTotal(total);
}

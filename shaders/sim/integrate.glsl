#include "sim/grab.glsl"

// x' = x + h v', v' = (1 - damping) v + h (g + w f); pinned particles rest or follow their path.
struct Particle {
  vec4 position;  // w: inverse mass
  vec3 velocity;
};

// Where a path takes the pin from its start position, or nearer to there (src/solver/pin_paths.h), at the velocity that
// leads there.
Particle movePin(uint i, vec4 x) {
  vec4 start = texelFetch(pinStarts, int(i));
  if (start.w == 0.0) return Particle(x, vec3(0.0));
  int row = (int(step.firstPinMotion) + int(start.w) - 1) * PIN_MOTION_ROWS;
  vec4 rowX = texelFetch(pinMotionRows, row);
  vec4 rowY = texelFetch(pinMotionRows, row + 1);
  vec4 rowZ = texelFetch(pinMotionRows, row + 2);
  vec4 pivot = texelFetch(pinMotionRows, row + 3);
  precise vec3 d = start.xyz - pivot.xyz;
  precise float rotatedX = sumOfProducts(rowX.xyz, d);
  precise float rotatedY = sumOfProducts(rowY.xyz, d);
  precise float rotatedZ = sumOfProducts(rowZ.xyz, d);
  precise vec3 move = vec3(rotatedX, rotatedY, rotatedZ) +
                      vec3(rowX.w, rowY.w, rowZ.w);
  precise vec3 sum = start.xyz + move;
  precise vec3 newX = canonical(sum);
  if (pivot.w != 0.0) {
    vec4 hold = texelFetch(pinMotionRows, row + 4);
    precise vec3 way = pivot.w * (newX - x.xyz);
    precise float waySquared = sumOfProducts(way, way);
    precise float part = hold.x * inverseSquareRoot(waySquared);
    if (waySquared > hold.y) way = part * way;
    precise vec3 heldX = x.xyz + way;
    newX = canonical(heldX);
  }
  precise vec3 newV = step.inverseTimeStep * (newX - x.xyz);
  precise vec3 storedV = canonical(newV);
  watchVelocity(PASS_INTEGRATE, i, storedV);
  return Particle(vec4(newX, x.w), storedV);
}

Particle integrateParticle(GridPoint p, vec3 force) {
  uint i = p.index;
  vec4 x = positionAt(i);
  vec3 v = velocityAt(i);
  if (x.w == 0.0 && hasMovingPins) return movePin(i, x);
  if (x.w == 0.0) return Particle(x, vec3(0.0));
  vec3 acceleration = accelerationOf(force, x.w);
  precise vec3 newV = step.velocityKept * v + step.timeStep * acceleration;
  if (hasGrab) newV = pulledVelocity(p, x.xyz, newV);
  precise vec3 newX = x.xyz + step.timeStep * newV;
  precise vec3 storedV = canonical(newV);
  watchVelocity(PASS_INTEGRATE, i, storedV);
  return Particle(vec4(canonical(newX), x.w), storedV);
}

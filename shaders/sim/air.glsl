#include "sim/grab.glsl"

// Wind on triangles.

// A third of the force of the air on triangle (a, b, c): pressure along its normal, rho C_d / 2 A (u.n)|u.n| n, and lift
// across the relative wind u, rho C_l / 2 A |u|^2 (e.n) (n - (e.n) e) with e = u/|u|. `normal` is 2 A n, and the factors of
// the step hold rho C / 12. Both terms are even in n: it does not matter to which side it points. Pressure p
// behind the cloth adds p A/3 n.
//
// It also adds up the matrices by which thirds of triangles resist a change of their velocity, as far as the implicit
// integrator takes the pressure for linear: with |u.n| as it is. Other passes do not read them.
vec3 resistanceDiagonal = vec3(0.0), resistanceOthers = vec3(0.0);

vec3 windForce(uint a, uint b, uint c) {
  vec3 xa = positionAt(a).xyz, xb = positionAt(b).xyz, xc = positionAt(c).xyz;
  vec3 va = velocityAt(a), vb = velocityAt(b), vc = velocityAt(c);
  const float third = uintBitsToFloat(0x3eaaaaabu);
  precise vec3 sideB = xb - xa;
  precise vec3 sideC = xc - xa;
  precise vec3 normal = crossProduct(sideB, sideC);
  precise float normalSquared = sumOfProducts(normal, normal);
  precise float inverseNormal = inverseSquareRoot(normalSquared);
  precise vec3 velocity = third * ((va + vb) + vc);
  precise vec3 air = vec3(step.airVelocityX, step.airVelocityY, step.airVelocityZ);
  float share = 0.0;
  if (hasJet) {
    precise vec3 middle = third * ((xa + xb) + xc);
    share = jetShare(middle);
    precise float jetSpeed = share * interaction.jetSpeed;
    air = air + jetSpeed * vec3(interaction.directionX, interaction.directionY, interaction.directionZ);
  }
  precise vec3 u = air - velocity;
  precise float speedSquared = sumOfProducts(u, u);
  precise float inverseSpeed = inverseSquareRoot(speedSquared);
  precise float speed = speedSquared * inverseSpeed;
  precise float through = sumOfProducts(u, normal);
  precise float across = through * inverseNormal;  // u.n
  precise float acrossMagnitude = across < 0.0 ? -across : across;
  precise float alongNormal = step.dragFactor * (across * acrossMagnitude) + step.liftFactor * (across * speed);
  precise float alongWind = step.liftFactor * ((across * through) * inverseSpeed);
  precise vec3 force = alongNormal * normal - alongWind * u;
  precise float resistance = (step.dragFactor * acrossMagnitude) * inverseNormal;
  if (hasJet && interaction.jetAlone != 0u) {
    force = share * force;
    resistance = share * resistance;
  }
  force = force + step.pressureFactor * normal;
  if (normalSquared < uintBitsToFloat(0x0d800000u)) return vec3(0.0);  // 2^-100: the triangle has no area
  precise vec3 scaledNormal = resistance * normal;
  precise vec3 diagonal = resistanceDiagonal + scaledNormal * normal;
  precise vec3 others = resistanceOthers + scaledNormal.xxy * normal.yzz;
  resistanceDiagonal = diagonal;
  resistanceOthers = others;
  return force;
}

// The triangles at a grid point in ascending number (src/cloth/cloth.h).
vec3 addWind(GridPoint p, vec3 force) {
  const uint i = p.index;
  const uint w = step.columns;
  const bool left = p.column >= 1u, right = p.column + 1u < w;
  const bool upper = p.row >= 1u, lower = p.row + 1u < step.rows;
  const uint lost = cutMaskOf(i) >> FIRST_CUT_TRIANGLE;
  precise vec3 f = force;
  if (upper && left && isIntact(lost, 0u)) f = f + windForce(i - w, i - 1u, i);
  if (upper && right) {
    if (isIntact(lost, 1u)) f = f + windForce(i - w, i, i - w + 1u);
    if (isIntact(lost, 2u)) f = f + windForce(i - w + 1u, i, i + 1u);
  }
  if (lower && left) {
    if (isIntact(lost, 3u)) f = f + windForce(i - 1u, i + w - 1u, i);
    if (isIntact(lost, 4u)) f = f + windForce(i, i + w - 1u, i + w);
  }
  if (lower && right && isIntact(lost, 5u)) f = f + windForce(i, i + w, i + 1u);
  return f;
}

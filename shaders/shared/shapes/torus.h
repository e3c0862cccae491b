// All points within `radius` of the circle of radius sizeX about y.
LAW Nearest nearestOnTorus(ColliderParams torus, vec3 p) {
  precise real axisSquared = p.x * p.x + p.z * p.z;
  precise real inverseAxis = inverseSquareRoot(axisSquared);
  precise real beyond = axisSquared * inverseAxis - torus.sizeX;
  precise real lengthSquared = beyond * beyond + p.y * p.y;
  precise real inverseLength = inverseSquareRoot(lengthSquared);
  precise real radial = (beyond * inverseLength) * inverseAxis;
  precise real distance = lengthSquared * inverseLength - torus.radius;
  precise vec3 normal = vec3(radial * p.x, inverseLength * p.y, radial * p.z);
  return Nearest(distance, normal);
}

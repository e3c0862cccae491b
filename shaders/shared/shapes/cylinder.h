// The cylinder of `radius` around y from -sizeY to sizeY.
LAW Nearest nearestOnCylinder(ColliderParams cylinder, vec3 p) {
  const real zero = real(0.0), one = real(1.0);
  vec3 q = canonical(p);
  precise real axisSquared = q.x * q.x + q.z * q.z;
  precise real inverseAxis = inverseSquareRoot(axisSquared);
  precise real beyondSide = axisSquared * inverseAxis - cylinder.radius;
  real above = q.y < zero ? -q.y : q.y;
  precise real beyondCap = above - cylinder.sizeY;
  // In the half-plane of p and the axis: outside the way to the rim or to a face, inside the nearest face.
  bool outsideSide = zero < beyondSide, outsideCap = zero < beyondCap;
  real across = outsideSide ? beyondSide : zero, along = outsideCap ? beyondCap : zero;
  precise real lengthSquared = across * across + along * along;
  precise real inverseLength = inverseSquareRoot(lengthSquared);
  precise real outward = inverseLength * across;
  precise real upward = inverseLength * along;
  precise real toRim = lengthSquared * inverseLength;
  bool outside = outsideSide || outsideCap;
  bool sideIsNearer = !(beyondSide < beyondCap);
  real toFace = sideIsNearer ? beyondSide : beyondCap;
  real normalAcross = outside ? outward : sideIsNearer ? one : zero;
  real normalAlong = outside ? upward : sideIsNearer ? zero : one;
  // On the axis every direction leads away from it.
  bool onAxis = !(zero < axisSquared);
  precise real awayX = onAxis ? one : inverseAxis * q.x;
  precise real awayZ = inverseAxis * q.z;
  precise vec3 normal =
      vec3(normalAcross * awayX, q.y < zero ? -normalAlong : normalAlong, normalAcross * awayZ);
  return Nearest(outside ? toRim : toFace, normal);
}

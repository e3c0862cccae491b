// The cone around y whose radius goes from sizeX at -sizeY to sizeZ at sizeY. `radius` is the length of its
// side, (normalX, normalY) the side's normal away from the axis and along it.
LAW Nearest nearestOnCone(ColliderParams cone, vec3 p) {
  const real zero = real(0.0), one = real(1.0);
  vec3 q = canonical(p);
  precise real axisSquared = q.x * q.x + q.z * q.z;
  precise real inverseAxis = inverseSquareRoot(axisSquared);
  precise real fromAxis = axisSquared * inverseAxis;
  // In the half-plane of p and the axis, seen from the lower rim: along the side and away from it.
  precise real across = fromAxis - cone.sizeX;
  precise real up = q.y + cone.sizeY;
  precise real alongSide = up * cone.normalX - across * cone.normalY;
  precise real beyondSide = across * cone.normalX + up * cone.normalY;
  bool upper = !(q.y < zero);
  real above = upper ? q.y : -q.y;
  precise real beyondCap = above - cone.sizeY;
  bool outsideSide = zero < beyondSide, outsideCap = zero < beyondCap;
  bool besideSide = !(alongSide < zero) && !(cone.radius < alongSide);
  bool overCap = !((upper ? cone.sizeZ : cone.sizeX) < fromAxis);
  // The nearest place is on the side, on a cap, or on a rim. Inside, the nearer of side and cap counts.
  bool outside = outsideSide || outsideCap;
  bool onCap = outside ? outsideCap && overCap : beyondSide < beyondCap;
  bool onSide = outside ? outsideSide && besideSide && !onCap : !onCap;
  bool lowerRim = alongSide < zero;
  precise real fromRim = fromAxis - (lowerRim ? cone.sizeX : cone.sizeZ);
  precise real overRim = q.y - (lowerRim ? -cone.sizeY : cone.sizeY);
  precise real lengthSquared = fromRim * fromRim + overRim * overRim;
  precise real inverseLength = inverseSquareRoot(lengthSquared);
  precise real toRim = lengthSquared * inverseLength;
  precise real rimAcross = inverseLength * fromRim;
  precise real rimAlong = inverseLength * overRim;
  real normalAcross = onSide ? cone.normalX : onCap ? zero : rimAcross;
  real normalAlong = onSide ? cone.normalY : !onCap ? rimAlong : upper ? one : -one;
  // On the axis every direction leads away from it.
  bool onAxis = !(zero < axisSquared);
  precise real awayX = onAxis ? one : inverseAxis * q.x;
  precise real awayZ = inverseAxis * q.z;
  precise vec3 normal = vec3(normalAcross * awayX, normalAlong, normalAcross * awayZ);
  return Nearest(onSide ? beyondSide : onCap ? beyondCap : toRim, normal);
}

// The connected parts of the coarsest levels, of all pieces.
layout(binding = DENSE_PARTS_UNIT) uniform usamplerBuffer denseParts;

uint densePartCount() { return uint(textureSize(denseParts)) / 2u; }
DensePart densePartAt(uint number) {
  uvec4 first = texelFetch(denseParts, int(2u * number)), second = texelFetch(denseParts, int(2u * number + 1u));
  return DensePart(first.x, first.y, first.z, first.w, second.x, 0u, 0u, 0u);
}

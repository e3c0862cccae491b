// A spring's line.
layout(location = 0) flat in vec3 lineColor;
layout(location = 1) flat in float halfWidth;
layout(location = 2) noperspective in float across;
layout(location = 3) flat in float opacity;
layout(location = 0) out vec4 color;

void main() {
  float cover = clamp(halfWidth + 0.5 - abs(across), 0.0, 1.0) * opacity;
  color = vec4(lineColor * cover, cover);
}

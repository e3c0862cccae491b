// The strain map: how far the cloth is stretched, in the colours of the legend, with a little shade for its shape.
#include "render/frame.glsl"
#include "render/surface.glsl"
#include "render/tone.glsl"

const float SHADE = 0.35;

layout(location = 0) in Surface surface;
layout(location = 0) out vec4 color;
#include "render/two_sided.glsl"

vec3 scaleColor(float strain) {
  float place = clamp(0.5 + 0.5 * strain / frame.strainRange, 0.0, 1.0) * float(STRAIN_STOPS - 1);
  int stop = min(int(place), STRAIN_STOPS - 2);
  return mix(frame.strainStops[stop].rgb, frame.strainStops[stop + 1].rgb, place - float(stop));
}

void main() {
  float shape = 0.5 + 0.5 * dot(normalToEye(), frame.toKeyLight.xyz);
  float open = clamp(1.0 - surface.hollow * facingSide(), 0.5, 1.0);
  color = vec4(canvasFromEncoded(sqrt(scaleColor(surface.strain) * (1.0 - SHADE * (1.0 - shape)) * open)), 1.0);
}

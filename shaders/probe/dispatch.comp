// Next to nothing: what a dispatch costs by itself, each needing what the one before has written.
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Numbers { float numbers[]; };

void main() {
  numbers[gl_LocalInvocationIndex] += 1.0;
}

// What conjugate gradients and the line search have come to so far; read here, written by sum_totals.comp alone.
layout(std430, binding = SCALARS_BINDING) readonly buffer Scalars { ImplicitScalars scalars; };

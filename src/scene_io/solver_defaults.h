// What the solver does where a scene does not say.
#pragma once

#include "scene/scene.h"

namespace clothsim {

// Scenes with `ks` get CS184's limiter and self-collision unless they say otherwise, scenes with a material
// Coulomb's friction and the implicit integrator in as many steps as it needs, with contact.
[[nodiscard]] SolverSettings solverDefaults(bool usesKs, bool usesMaterial);
[[nodiscard]] SelfCollision usualSelfCollision(bool usesKs, bool usesMaterial, Integrator integrator);
// With the self-collision that is usual for the integrator, where it was so before or cannot stay, and as
// many steps as that needs.
void setIntegrator(Scene& scene, Integrator integrator);
// Whether some cloth follows CS184's model. A cloth with neither constant does: the reader gives it
// defaultKs.
[[nodiscard]] bool usesKs(const Scene& scene);

}  // namespace clothsim

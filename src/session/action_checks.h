// Checks an action before it is applied. A recording may have been edited by hand and ask for anything.
#pragma once

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "session/actions.h"

namespace clothsim {

// @throws UsageError that says what was found and what was expected
void checkAction(const Action& action, const Cloth& cloth, const Scene& scene);

}  // namespace clothsim

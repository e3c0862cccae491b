// Whether an action makes sense where it is to act: hands may come from a recording that somebody has edited.
#pragma once

#include "cloth/cloth.h"
#include "scene/scene.h"
#include "session/actions.h"

namespace clothsim {

// @throws UsageError that says what was found and what was expected
void checkAction(const Action& action, const Cloth& cloth, const Scene& scene);

}  // namespace clothsim

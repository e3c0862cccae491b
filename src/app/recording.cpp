#include "app/recording.h"

#include "core/error.h"

namespace clothsim {

void Recording::save(const std::filesystem::path&) const { throw InputOutputError("recordings: not yet"); }
Recording Recording::load(const std::filesystem::path&) { throw SceneError("recordings: not yet"); }

}  // namespace clothsim

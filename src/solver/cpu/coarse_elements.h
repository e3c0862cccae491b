// The first coarse level's matrix, from the elements of the cloth.
#pragma once

#include <array>
#include <cstdint>

#include "solver/cpu/implicit_passes.h"

namespace clothsim::cpu {

// The blocks of the rows [first, end) of the level, as the state may hold them (canonical()).
void sumElements(const ImplicitArguments<float>& arguments, const LevelParams& level, std::uint32_t first,
                 std::uint32_t end);
void sumElements(const ImplicitArguments<double>& arguments, const LevelParams& level, std::uint32_t first,
                 std::uint32_t end);

}  // namespace clothsim::cpu

// The instructions that loops over particles may use. All give the same bits.
#pragma once

#include <string_view>
#include <vector>

namespace clothsim {

enum class VectorSet { plain, avx2, avx512 };  // plain: what every processor of the architecture has

[[nodiscard]] std::string_view nameOf(VectorSet set);  // "plain", "avx2", "avx512"
// Those that this build was compiled for and this processor has, narrowest first.
[[nodiscard]] std::vector<VectorSet> vectorSetsHere();
// The one in use, the same throughout a process: what CLOTHSIM_VECTORS names, otherwise the widest of
// vectorSetsHere(). @throws UsageError when the variable names none of those, in the first call
[[nodiscard]] VectorSet vectorSet();

}  // namespace clothsim

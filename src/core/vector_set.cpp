#include "core/vector_set.h"

#include <cstdlib>
#include <string>

#include "core/error.h"
#include "core/vector_clones.h"

namespace clothsim {
namespace {

VectorSet chosen() {
  const std::vector<VectorSet> here = vectorSetsHere();
  const char* wanted = std::getenv("CLOTHSIM_VECTORS");
  if (wanted == nullptr) return here.back();
  std::string names;
  for (const VectorSet set : here) {
    if (nameOf(set) == wanted) return set;
    names += (names.empty() ? "" : " or ") + std::string(nameOf(set));
  }
  throw UsageError("CLOTHSIM_VECTORS is \"" + std::string(wanted) + "\"; set it to " + names +
                   ", which this build and this processor have, or unset it for the widest");
}

}  // namespace

std::string_view nameOf(VectorSet set) {
  return set == VectorSet::plain ? "plain" : set == VectorSet::avx2 ? "avx2" : "avx512";
}

std::vector<VectorSet> vectorSetsHere() {
  std::vector<VectorSet> sets{VectorSet::plain};
#ifdef HAS_VECTOR_CLONES
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v3")) sets.push_back(VectorSet::avx2);
  if (__builtin_cpu_supports("x86-64-v4")) sets.push_back(VectorSet::avx512);
#endif
  return sets;
}

VectorSet vectorSet() {
  static const VectorSet set = chosen();
  return set;
}

}  // namespace clothsim

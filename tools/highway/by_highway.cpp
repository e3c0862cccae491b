// springForce() of src/solver/cpu/force_laws.h once more, operation by operation in Highway's functions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "by_highway.cpp"
#include "hwy/foreach_target.h"
// Highway's own header comes behind it.
#include "hwy/highway.h"
#include "springs.h"

HWY_BEFORE_NAMESPACE();
namespace trial::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void forces(const Row& row, std::ptrdiff_t springs, float stiffness, float restLength) {
  const hn::ScalableTag<float> floats;
  const hn::RebindToUnsigned<decltype(floats)> bits;
  const auto constant = [&](std::uint32_t of) { return hn::BitCast(floats, hn::Set(bits, of)); };
  const auto k = hn::Set(floats, stiffness), rest = hn::Set(floats, restLength), one = hn::Set(floats, 1.0f);
  const auto along = [&](const float* c) { return hn::Sub(hn::LoadU(floats, c + 1), hn::LoadU(floats, c)); };
  for (std::ptrdiff_t i = 0; i < springs; i += static_cast<std::ptrdiff_t>(hn::Lanes(floats))) {
    const auto dx = along(row.x + i), dy = along(row.y + i), dz = along(row.z + i);
    const auto squared = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    const auto half = hn::ShiftRight<1>(hn::BitCast(bits, squared));
    const auto guess =
        hn::BitCast(floats, hn::And(hn::Sub(hn::Set(bits, 0x5f330000u), half), hn::Set(bits, 0xfffff000u)));
    const auto residual = hn::Sub(one, hn::Mul(squared, hn::Mul(guess, guess)));
    auto power = constant(0x3ea74a11u);
    for (const std::uint32_t next : {0x3e9e9e34u, 0x3ebffe5au, 0x3f000021u})
      power = hn::Add(constant(next), hn::Mul(residual, power));
    const auto inverse = hn::Add(guess, hn::Mul(guess, hn::Mul(residual, power)));
    const auto scale = hn::Mul(hn::Mul(k, hn::Sub(hn::Mul(squared, inverse), rest)), inverse);
    hn::StoreU(hn::Mul(scale, dx), floats, row.forceX + i);
    hn::StoreU(hn::Mul(scale, dy), floats, row.forceY + i);
    hn::StoreU(hn::Mul(scale, dz), floats, row.forceZ + i);
  }
}

}  // namespace trial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trial {
HWY_EXPORT(forces);
void forcesByHighway(const Row& row, std::ptrdiff_t springs, float stiffness, float restLength) {
  HWY_DYNAMIC_DISPATCH(forces)(row, springs, stiffness, restLength);
}
}  // namespace trial
#endif

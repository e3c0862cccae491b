// What the panels' controls say of fields, and how they read what is typed.
#include <gtest/gtest.h>

#include "viewer/panels/field_widgets.h"
#include "viewer/panels/number_controls.h"

namespace clothsim {
namespace {

TEST(FieldText, SaysUnitsAsAPersonWouldWriteThem) {
  EXPECT_EQ(unitText("kg/m^2"), "kg/m\u00b2");
  EXPECT_EQ(unitText("kg/m^3"), "kg/m\u00b3");
  EXPECT_EQ(numberFormat("%"), "%.4g %%");
  EXPECT_EQ(numberFormat(""), "%.4g");
  EXPECT_EQ(labelOf("num_width_points"), "num width points");
}

TEST(FieldText, TypedNumbersMayHaveAUnit) {
  EXPECT_EQ(numberIn(" 0.5 ", "m"), 0.5);
  EXPECT_EQ(numberIn("1e-3", ""), 1e-3);
  EXPECT_EQ(numberIn("+2 m", "m"), 2);
  EXPECT_DOUBLE_EQ(numberIn("20 cm", "m").value(), 0.2);
  EXPECT_DOUBLE_EQ(numberIn("3mm", "m").value(), 0.003);
  EXPECT_DOUBLE_EQ(numberIn("10 in", "m").value(), 0.254);
  EXPECT_DOUBLE_EQ(numberIn("36 km/h", "m/s").value(), 10);
  EXPECT_DOUBLE_EQ(numberIn("150 g/m^2", "kg/m^2").value(), 0.15);
  EXPECT_DOUBLE_EQ(numberIn("150 g/m\u00b2", "kg/m^2").value(), 0.15);
  EXPECT_EQ(numberIn("1 kg", "kg"), 1);
  EXPECT_EQ(numberIn("50 %", "%"), 50);
  for (const char* wrong : {"", "m", "2 lb", "2 m/s", "nan", "1e999", "2 3", "*2"})
    EXPECT_EQ(numberIn(wrong, "m"), std::nullopt) << wrong;
  EXPECT_EQ(numberIn("2 m", ""), std::nullopt);
}

TEST(FieldText, EverySliderHasARangeThatHoldsItsDefaultAndLiesWithinTheLimits) {
  const auto check = [](const auto& owner, const auto& fields) {
    for (const auto& field : fields) {
      std::visit(
          [&](auto member) {
            const auto& value = owner.*member;
            using T = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
              const Usual range = sliderRange(field, static_cast<double>(value));
              EXPECT_LT(range.low, range.high) << field.key;
              EXPECT_GE(range.low, field.limits.low) << field.key;
              EXPECT_LE(range.high, field.limits.high) << field.key;
              EXPECT_LE(range.low, static_cast<double>(value)) << field.key;
              EXPECT_GE(range.high, static_cast<double>(value)) << field.key;
            }
          },
          field.member);
    }
  };
  check(Scene{}, fieldsOf<Scene>());
  check(ClothSettings{}, fieldsOf<ClothSettings>());
  check(SolverSettings{}, fieldsOf<SolverSettings>());
  check(Wind{}, fieldsOf<Wind>());
  check(Gust{}, fieldsOf<Gust>());
  check(RenderSettings{}, fieldsOf<RenderSettings>());
  check(Sphere{}, fieldsOf<Sphere>());
  check(Capsule{}, fieldsOf<Capsule>());
  check(Box{}, fieldsOf<Box>());
  check(Torus{}, fieldsOf<Torus>());
  check(Cylinder{}, fieldsOf<Cylinder>());
  check(Cone{}, fieldsOf<Cone>());
}

}  // namespace
}  // namespace clothsim

#include "scene_io/describe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/files.h"

namespace clothsim {
namespace {

FieldInfo fieldAt(const std::string& path) {
  const std::vector<FieldInfo> fields = describeFields();
  const auto at =
      std::find_if(fields.begin(), fields.end(), [&](const FieldInfo& field) { return field.path == path; });
  if (at == fields.end()) {
    ADD_FAILURE() << "no field " << path;
    return {};
  }
  return *at;
}

TEST(DescribeFields, TellsTypeUnitRangeDefaultAndWhenAChangeTakesEffect) {
  const FieldInfo damping = fieldAt("cloth.damping");
  EXPECT_EQ(damping.type, "number");
  EXPECT_EQ(damping.unit, "%");
  EXPECT_EQ(damping.range, "0 to 100");
  EXPECT_EQ(damping.defaultValue, "0.2");
  EXPECT_TRUE(damping.live);

  EXPECT_EQ(fieldAt("cloth.num_width_points").range, "2 to 16384");
  EXPECT_FALSE(fieldAt("cloth.num_width_points").live);
  EXPECT_EQ(fieldAt("cloth.ks").unit, "N/m");
  EXPECT_EQ(fieldAt("cloth.ks").range, "> 0");
  EXPECT_EQ(fieldAt("solver.integrator").type, "one of verlet, euler, implicit, bdf2");
  EXPECT_EQ(fieldAt("solver.integrator").defaultValue, "\"verlet\"; in scenes with a material \"implicit\"");
  EXPECT_EQ(fieldAt("solver.strain_limit").type, "false or number");
  EXPECT_EQ(fieldAt("gravity").type, "[x, y, z]");
  EXPECT_EQ(fieldAt("gravity").defaultValue, "[0, -9.8, 0]");
  EXPECT_EQ(fieldAt("render.color").type, "[r, g, b]");
  EXPECT_EQ(fieldAt("wind").defaultValue, "none");
  EXPECT_EQ(fieldAt("expect.min_y").type, "[low, high]");
  EXPECT_EQ(fieldAt("colliders[].motion.keys[].t").defaultValue, "required");
  EXPECT_EQ(fieldAt("cloth.pin_motion").type, "object or list of objects");
  EXPECT_TRUE(fieldAt("cloth.pin_motion[].keys[].position").live);
  EXPECT_EQ(fieldAt("colliders[].type").type,
            "one of sphere, plane, capsule, box, torus, mesh, cylinder, cone");
}

TEST(DescribeFields, NamesEveryKeyOnce) {
  std::set<std::string> paths;
  for (const FieldInfo& field : describeFields()) EXPECT_TRUE(paths.insert(field.path).second) << field.path;
}

TEST(DescribeFields, TellsTheKeysOfAShapeAlone) {
  std::set<std::string> paths;
  for (const FieldInfo& field : describeShape("sphere")) paths.insert(field.path);
  EXPECT_TRUE(paths.contains("sphere.origin") && paths.contains("sphere.radius"));
  EXPECT_FALSE(paths.contains("sphere.normal") || paths.contains("sphere.file"));
  EXPECT_TRUE(describeShape("cube").empty());
}

TEST(DescribeFields, AreThePageOfSceneFiles) {
  EXPECT_EQ(readFile(std::filesystem::path(SOURCE_ROOT) / "docs/scene-format.md"), fieldsAsMarkdown())
      << "make it anew: clothsim describe --markdown > docs/scene-format.md";
}

TEST(DescribeFields, HelpsInOneLineThatFitsATerminal) {
  for (const FieldInfo& field : describeFields()) {
    EXPECT_FALSE(field.help.empty()) << field.path;
    EXPECT_LE(field.help.size(), 110U) << field.path;
    EXPECT_EQ(field.help.find('\n'), std::string::npos) << field.path;
    EXPECT_TRUE(field.help.ends_with('.')) << field.path;
  }
}

}  // namespace
}  // namespace clothsim

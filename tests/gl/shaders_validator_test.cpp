// Every shader against Khronos' own reference compiler and its checker of SPIR-V, which are stricter than any
// driver. Needs no context.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/files.h"
#include "gl/shader_source.h"
#include "shared/implicit.h"
#include "solver/gpu/pass_programs.h"
#include "support/command.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

const fs::path shaderFolder = fs::path(SOURCE_ROOT) / "shaders";

// "comp", "vert", "frag", ... as glslc calls stages, and as our files' extensions do; "" for an include.
std::string stageOf(const fs::path& file) {
  const std::string extension = file.extension().string();
  for (const char* stage : {".comp", ".vert", ".frag", ".geom", ".tesc", ".tese"})
    if (extension == stage) return extension.substr(1);
  return "";
}

// Relative to shaders/, in alphabetical order.
std::vector<std::string> shaderFiles() {
  std::vector<std::string> files;
  for (const char* folder : {"sim", "render", "probe"}) {
    if (!fs::is_directory(shaderFolder / folder)) continue;  // a test of its own misses it
    for (const auto& entry : fs::recursive_directory_iterator(shaderFolder / folder))
      if (!stageOf(entry.path()).empty())
        files.push_back(fs::relative(entry.path(), shaderFolder).generic_string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// One of the variants that the program compiles, as a text of its own.
struct Variant {
  std::string name, stage, text;
};

// Compiles them to SPIR-V, all in one go, which reads the language's own functions once; and has that
// checked: drivers like zink and those of Vulkan's makers go the same way.
test::CommandResult validate(const std::vector<Variant>& variants) {
  const test::TemporaryFolder folder;
  for (const Variant& variant : variants)
    writeFileAtomically(folder / (variant.name + "." + variant.stage), variant.text);
  return test::runCommand("(cd " + folder.path().string() +
                          " && glslc -c --target-env=opengl4.5 -fauto-map-locations -fauto-bind-uniforms * &&"
                          " for f in *.spv; do spirv-val --target-env opengl4.5 $f || exit; done) 2>&1");
}

// NVIDIA's compiler refuses a shader that declares more, used or not (driver 580, error C7612).
constexpr std::size_t MOST_DECLARED_SAMPLERS = 32;

std::size_t countSamplers(const std::string& text) {
  std::size_t count = 0;
  for (const std::string declaration : {"uniform sampler", "uniform usampler"})
    for (std::size_t at = 0; (at = text.find(declaration, at)) != std::string::npos; ++at) ++count;
  return count;
}

// Those that the preprocessor leaves; it is run only where there may be too many.
std::size_t declaredSamplers(const Variant& variant) {
  if (const std::size_t most = countSamplers(variant.text); most <= MOST_DECLARED_SAMPLERS) return most;
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / ("shader." + variant.stage);
  writeFileAtomically(file, variant.text);
  const test::CommandResult result = test::runCommand("glslc -E " + file.string());
  EXPECT_EQ(result.exitCode, 0) << result.output;
  return countSamplers(result.output);
}

// The variants in which the program compiles a shader: simulation passes with everything and with nothing of
// what a scene may have, the resolve with and without multisampling, the other drawing shaders just as they
// are.
std::vector<gl::Defines> variantsOf(const std::string& file) {
  if (file == "probe/stencil.comp") {
    std::vector<gl::Defines> variants;
    for (const char* loads : {"0", "1", "2"})
      variants.push_back({{"GROUP_COLUMNS", "32"}, {"GROUP_ROWS", "8"}, {"SIZE", "1024u"}, {"LOADS", loads}});
    return variants;
  }
  if (file == "probe/springs.comp")
    return {{{"ARITHMETIC", "0"}, {"SPRINGS", "64u"}},
            {{"ARITHMETIC", "1"}, {"SPRINGS", "64u"}},
            {{"ARITHMETIC", "2"}, {"SPRINGS", "64u"}}};
  if (file == "render/floor_shadow.frag") return {{{"FIRST_AXIS", ""}}, gl::Defines{}};
  if (file == "render/normals.comp") return {gl::Defines{}, {{"CUTS", ""}, {"STRAIN", ""}}};
  if (file == "render/mesh_normals.comp") return {gl::Defines{}, {{"STRAIN", ""}}};
  if (file == "render/smooth_points.comp") return {gl::Defines{}, {{"LEAN", ""}}};
  if (file == "render/smooth_choose.comp") return {gl::Defines{}, {{"CENTERS", ""}}};
  if (file == "render/smooth_triangles.comp") return {gl::Defines{}, {{"COUNT", ""}}};
  if (file == "render/resolve.frag")
    return {{{"SAMPLES", "1"}},
            {{"SAMPLES", "4"}},
            {{"SAMPLES", "1"}, {"ADDS", ""}},
            {{"SAMPLES", "4"}, {"ADDS", ""}},
            {{"SAMPLES", "1"}, {"MEAN", ""}}};
  if (file == "render/backdrop.frag")
    return {gl::Defines{},
            {{"SKY", ""}},
            {{"PLAIN", ""}},
            {{"LAY", ""}},
            {{"LAY", ""}, {"EXPOSURE", ""}},
            {{"TABLE", ""}, {"GROUND_ALONE", ""}},
            {{"WINDOW", ""}, {"BEYOND_ALONE", ""}}};
  if (file == "render/layer_bulges.comp") return {gl::Defines{}, {{"PATCHES", ""}}};
  if (file == "render/layer_shares.comp") return {gl::Defines{}, {{"INSERT", ""}}, {{"AGAIN", ""}}};
  if (file == "render/fuzz.vert") return {{{"TANGENT", ""}, {"THICK", ""}}};
  if (file == "render/cloth.vert")
    return {gl::Defines{}, {{"TANGENT", ""}, {"DISPLACEMENT", ""}}, {{"STRAIN", ""}}};
  if (file == "render/cloth_shadow.vert" || file == "render/cloth_depth.vert")
    return {gl::Defines{}, {{"DISPLACEMENT", ""}}};
  if (file == "render/fabric.frag")
    return {{{"TANGENT", ""}}, {{"TANGENT", ""}, {"WOVEN", ""}, {"PRINT", ""}, {"EXPOSURE", ""}}};
  if (file == "render/bump.frag" || file == "render/displacement.frag" || file == "render/fuzz.frag")
    return {{{"TANGENT", ""}}, {{"TANGENT", ""}, {"EXPOSURE", ""}}};
  if (file == "render/strain.frag") return {{{"STRAIN", ""}}, {{"STRAIN", ""}, {"EXPOSURE", ""}}};
  if (file.starts_with("render/") && file.ends_with(".frag")) return {gl::Defines{}, {{"EXPOSURE", ""}}};
  if (!file.starts_with("sim/")) return {gl::Defines{}};
  PassFeatures everything{.wind = true,
                          .movingColliders = true,
                          .coulombFriction = true,
                          .movingPins = true,
                          .restLengthTable = true,
                          .grab = true,
                          .jet = true,
                          .cuts = true};
  everything.colliderTypes = 0xffffffff;
  everything.particleForces = ~0u;
  everything.enabledSlots = (1u << SPRING_SLOTS) - 1;
  PassFeatures cs184 = everything;
  cs184.coulombFriction = false;
  everything.limitSprings = everything.material = everything.contactPlanes = everything.history = true;
  everything.surface = everything.smallColliders = everything.seams = true;
  PassFeatures mesh = everything;
  mesh.mesh = mesh.storageLoads = true;
  cs184.storageLoads = true;
  if (file.ends_with("invert_dense.comp")) cs184.groupColumns = 1024;
  everything.gate = GATE_STEP;
  mesh.gate = GATE_SYSTEM;
  std::vector<gl::Defines> variants{definesFor(everything), definesFor(cs184), definesFor(PassFeatures{}),
                                    definesFor(mesh)};
  const bool sumsNumbers = file.ends_with("search.comp") || file.ends_with("prolong_particles.comp");
  const auto sumKind = [&](std::size_t i) -> std::size_t {
    if (file.ends_with("try_lengths.comp")) return SUM_LENGTH;
    if (file.ends_with("accept.comp")) return SUM_UPDATE;
    return sumsNumbers ? i % SUM_LENGTH : i;
  };
  for (std::size_t i = 0; i < variants.size(); ++i) {
    variants[i].emplace_back("SUM_KIND", std::to_string(sumKind(i)));
    variants[i].emplace_back("IS_SUM", std::to_string(i % 2));
    variants[i].emplace_back("UPDATES_SOLUTION", std::to_string(i % 2));
    variants[i].emplace_back("PREDICTS", std::to_string(i % 2));
    variants[i].emplace_back("COLLIDES_IN_STEP", std::to_string(i % 2));
    variants[i].emplace_back("SELF_ROBUST", std::to_string(i % 2));
    variants[i].emplace_back("SELF_HAS_MESH", i == 3 ? "1" : "0");
    variants[i].emplace_back("SELF_NEAR_CODES", std::to_string(1 - i % 2));
    variants[i].emplace_back("SEARCHES_TOUCHING", std::to_string(i % 2));
    variants[i].emplace_back("WRITES_PAIRS", std::to_string(i / 2));
    variants[i].emplace_back("SCANS_LISTS", std::to_string(i % 2));
    variants[i].emplace_back("LATER", std::to_string(i / 2));
    variants[i].emplace_back("ONLY_BOXES", std::to_string(i == 2));
    variants[i].emplace_back("ONLY_COUNTS", std::to_string(i == 1));
    variants[i].emplace_back("STOPS_SLIPS", std::to_string(i == 0));
  }
  return variants;
}

class ShaderFolder : public testing::TestWithParam<std::string> {};

TEST_P(ShaderFolder, PassesTheReferenceCompiler) {
  std::vector<Variant> variants;
  for (const std::string& file : shaderFiles()) {
    if (!file.starts_with(GetParam() + "/")) continue;
    std::string name = file;
    std::replace(name.begin(), name.end(), '/', '_');
    for (const gl::Defines& defines : variantsOf(file))
      variants.push_back({name + "." + std::to_string(variants.size()), stageOf(file),
                          gl::loadShaderSource(file, defines).text});
  }
  const test::CommandResult result = validate(variants);
  EXPECT_EQ(result.exitCode, 0) << result.output;
  for (const Variant& variant : variants)
    EXPECT_LE(declaredSamplers(variant), MOST_DECLARED_SAMPLERS) << variant.name;
}

INSTANTIATE_TEST_SUITE_P(All, ShaderFolder, testing::Values("sim", "render", "probe"),
                         [](const auto& folder) { return folder.param; });

TEST(ShaderValidator, FindsShadersOfBothKinds) {
  for (const char* folder : {"sim/", "render/"}) {
    const std::vector<std::string> files = shaderFiles();
    EXPECT_TRUE(std::any_of(files.begin(), files.end(), [&](const std::string& file) {
      return file.starts_with(folder);
    })) << folder;
  }
}

TEST(ShaderValidator, RefusesAShaderThatIsWrong) {
  const Variant right{"right", "vert", "#version 450 core\nvoid main() {}\n"};
  const Variant wrong{"wrong", "vert", "#version 450 core\nvoid main() { float x = undeclared; }\n"};
  EXPECT_EQ(validate({right}).exitCode, 0);
  const test::CommandResult result = validate({right, wrong});
  EXPECT_NE(result.exitCode, 0);
  EXPECT_NE(result.output.find("wrong.vert:2: error: 'undeclared'"), std::string::npos) << result.output;

  Variant many{"many", "vert", "#version 450 core\n#if 0\nuniform usampler2D left;\n#endif\n"};
  for (int i = 0; i < 33; ++i) many.text += "uniform samplerBuffer s" + std::to_string(i) + ";\n";
  EXPECT_EQ(declaredSamplers(many), 33u);
}

}  // namespace
}  // namespace clothsim

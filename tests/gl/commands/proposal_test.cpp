// What `doctor` proposes, and how it is kept for --resolution auto.
#include "commands/proposal.h"

#include <gtest/gtest.h>

#include <string>

#include "core/files.h"
#include "core/vector_set.h"
#include "gl/gl_test.h"
#include "support/process.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

const Proposal some{"cpu", 80, Quality::normal, 0.25, 0.125};

TEST(Proposal, IsKeptForTheMachineThatItWasMeasuredOn) {
  const test::TemporaryFolder folder;
  const auto path = folder / "settings" / "machine.json";  // the folder is made
  EXPECT_EQ(keptProposal(path, "this one"), std::nullopt) << "nothing is there yet";
  EXPECT_EQ(keepProposal(some, path, "this one"), "");
  EXPECT_EQ(keptProposal(path, "this one"), some);
  EXPECT_EQ(keptProposal(path, "another one"), std::nullopt);
  EXPECT_EQ(keptProposal("", "this one"), std::nullopt);
  EXPECT_NE(keepProposal(some, "", "this one"), "");
  EXPECT_NE(keepProposal(some, path / "below a file", "this one"), "");
}

TEST(Proposal, IsMeasuredAgainWhereItsFileIsNone) {
  const test::TemporaryFolder folder;
  const auto path = folder / "machine.json";
  const std::string whole =
      R"({"machine":"m","backend":"cpu","size":80,"quality":"draft","simulation_seconds":1,"draw_seconds":1})";
  writeFileAtomically(path, whole);
  EXPECT_TRUE(keptProposal(path, "m").has_value());
  for (const auto& [from, to] :
       {std::pair("\"cpu\"", "\"tpu\""), std::pair("80", "-1"), std::pair("80", "1e9"),
        std::pair("\"draft\"", "\"best\""), std::pair("\"size\"", "\"sizes\""), std::pair("80", "\"80\""),
        std::pair("{", "[{"), std::pair("}", "")}) {
    std::string wrong = whole;
    wrong.replace(wrong.find(from), std::string(from).size(), to);
    writeFileAtomically(path, wrong);
    EXPECT_EQ(keptProposal(path, "m"), std::nullopt) << wrong;
  }
}

TEST(Proposal, ThatIsKeptIsTakenByAutoWithoutMeasuring) {
  const test::TemporaryFolder folder;
  testContext();
  const std::string home = "XDG_CONFIG_HOME=" + folder.path().string();
  EXPECT_EQ(keepProposal(some, folder / "clothsim" / "machine.json", machineName()), "");
  const test::CommandResult run = test::runCommand(
      "env " + home +
      " " CLOTHSIM_PROGRAM " run -f demo --resolution auto --frames 0 --backend cpu --json 2>&1 >/dev/null");
  EXPECT_EQ(run.output.find("measuring"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("at 80x80"), std::string::npos) << run.output;
}

TEST(Proposal, OfDoctorIsKeptAndTheDeviceIsTested) {
  const test::TemporaryFolder folder;
  const nlohmann::json doctor = test::jsonOf("doctor --json", "XDG_CONFIG_HOME=" + folder.path().string());
  EXPECT_TRUE(doctor["bitwise_equal"].get<bool>());
  EXPECT_TRUE(doctor["software"].is_boolean());
  EXPECT_EQ(doctor["vectors"], nameOf(vectorSet()));
  const nlohmann::json& proposal = doctor["proposal"];
  testContext();
  const auto kept = keptProposal(folder / "clothsim" / "machine.json", machineName());
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(proposal["backend"], kept->backend);
  EXPECT_EQ(proposal["resolution"], std::to_string(kept->size) + "x" + std::to_string(kept->size));
  EXPECT_EQ(proposal["quality"], nameOf(kept->quality));
  EXPECT_GT(kept->simulationSeconds, 0);
  EXPECT_GT(kept->drawSeconds, 0);
  if (doctor["software"].get<bool>()) {
    EXPECT_EQ(kept->backend, "cpu");
    EXPECT_NE(kept->quality, Quality::final) << "a software renderer takes longer for it";
  }
}

}  // namespace
}  // namespace clothsim

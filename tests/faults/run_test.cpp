// A short run that saves every kind of file, with one call after the other failing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "app/commands.h"
#include "core/files.h"
#include "faults/faults.h"
#include "support/temporary_folder.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

using test::Fault;
using test::Outcome;

constexpr const char* scene = R"({"cloth": {"num_width_points": 3, "num_height_points": 3, "ks": 500,
  "pinned": ["top"]}, "solver": {"simulation_steps": 1}})";

// In memory, where a system has such a place: thousands of runs each write nine files.
fs::path quickFolder() { return fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path(); }

class RunUnderFaults : public testing::Test {
 protected:
  RunUnderFaults() {
    fs::create_directory(folder_ / "saves");
    writeFileAtomically(folder_ / "tiny.json", scene);
    words_ = {"clothsim", "run", "-f", (folder_ / "tiny.json").string(), "--frames", "1", "--backend", "cpu"};
    for (const char* save : {"a.state", "a.csv", "a.obj", "a.ply", "a.pc2", "a.usda", "a%02d.csv"}) {
      words_.push_back("--save");
      words_.push_back((folder_ / "saves" / save).string());
    }
    EXPECT_EQ(run(Fault::none, 1, false).exitCode, 0) << readFile(said_);
    whole_ = content();
  }

  [[nodiscard]] std::vector<std::string> content() const {
    std::vector<std::string> all;
    for (const std::string& name : files_) all.push_back(readFile(folder_ / "saves" / name));
    return all;
  }

  // Over files of an earlier run.
  Outcome run(Fault fault, int n, bool forGood) {
    if (content_ != old_) {
      for (const std::string& name : files_) writeFileAtomically(folder_ / "saves" / name, "old");
      content_ = old_;
    }
    std::vector<char*> argv;
    for (std::string& word : words_) argv.push_back(word.data());
    argv.push_back(nullptr);
    return test::runWithFault(fault, n, forGood, said_.c_str(),
                              [&] { return runCommandLine(static_cast<int>(argv.size()) - 1, argv.data()); });
  }

  // Every n until a run makes fewer such calls. Returns how many it makes.
  int tryAll(Fault fault, bool forGood) {
    for (int n = 1;; ++n) {
      const Outcome outcome = run(fault, n, forGood);
      content_ = content();
      if (outcome.calls < n) return n - 1;
      const std::string said = readFile(said_);
      SCOPED_TRACE("call " + std::to_string(n) + ", exit code " + std::to_string(outcome.exitCode) + "\n" +
                   said);
      check(outcome, said);
      if (HasFailure()) return n;
    }
  }

  void check(const Outcome& outcome, const std::string& said) const {
    for (std::size_t i = 0; i < files_.size(); ++i)
      EXPECT_TRUE(content_[i] == "old" || content_[i] == whole_[i]) << files_[i] << " is torn";
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "saves"), {}),
              static_cast<std::ptrdiff_t>(files_.size()))
        << "something was left behind";
    if (outcome.exitCode == 0) {
      EXPECT_EQ(content_, whole_) << "done, but not all is saved";
      return;
    }
    EXPECT_TRUE(outcome.exitCode == 1 || outcome.exitCode == 3 || outcome.exitCode == 5);
    EXPECT_NE(said.find("clothsim: "), std::string::npos) << "no message";
  }

  test::TemporaryFolder folder_{quickFolder()};
  std::string said_ = (folder_ / "said.txt").string();
  std::vector<std::string> words_;
  const std::vector<std::string> files_{"a.state", "a.csv",      "a.obj",   "a.ply",  "a.pc2",
                                        "a.usda",  "a_rest.obj", "a00.csv", "a01.csv"};
  const std::vector<std::string> old_ = std::vector<std::string>(files_.size(), "old");
  std::vector<std::string> whole_;    // after a run without a fault
  std::vector<std::string> content_;  // after the last one
};

struct Tried {
  Fault fault;
  const char* name;
  int least;  // such calls in a run that saves nine files
};

TEST_F(RunUnderFaults, LeavesWholeFilesAndAMessageWhereverACallToTheSystemFails) {
  for (const Tried& tried : {Tried{Fault::open, "open", 9}, Tried{Fault::write, "write", 9},
                             Tried{Fault::synchronise, "fsync", 18}, Tried{Fault::close, "close", 18},
                             Tried{Fault::rename, "rename", 9}, Tried{Fault::stat, "stat", 27}})
    for (const bool forGood : {false, true}) {
      const int count = tryAll(tried.fault, forGood);
      std::cout << tried.name << (forGood ? ", and all after it" : "") << ": " << count << " tried\n";
      EXPECT_GE(count, tried.least) << "are they still counted?";
    }
}

TEST_F(RunUnderFaults, LeavesWholeFilesAndAMessageWhereverAnAllocationFails) {
  const int count = tryAll(Fault::allocate, false);
  std::cout << "allocation: " << count << " tried\n";
  EXPECT_GE(count, 1000) << "are they still counted?";
}

}  // namespace
}  // namespace clothsim

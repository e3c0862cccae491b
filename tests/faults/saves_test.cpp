// Short work that saves every kind of file, with one call after the other failing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
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

// Some work that writes files into the folder saves.
class FaultsTest : public testing::Test {
 protected:
  explicit FaultsTest(std::vector<std::string> files) : files_(std::move(files)), old_(files_.size(), "old") {
    fs::create_directory(folder_ / "saves");
  }

  // The exit code; errors are said as `clothsim` says them.
  virtual int work() = 0;

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
    return test::runWithFault(fault, n, forGood, said_.c_str(), [this] { return work(); });
  }

  void runWithoutFault() {
    EXPECT_EQ(run(Fault::none, 1, false).exitCode, 0) << readFile(said_);
    whole_ = content_ = content();
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

  struct Tried {
    Fault fault;
    const char* name;
    int least;  // such calls in the work
  };
  void tryAll(const std::vector<Tried>& all) {
    for (const Tried& tried : all)
      for (const bool forGood : {false, true}) {
        const int count = tryAll(tried.fault, forGood);
        std::cout << tried.name << (forGood ? ", and all after it" : "") << ": " << count << " tried\n";
        EXPECT_GE(count, tried.least) << "are they still counted?";
      }
  }

  test::TemporaryFolder folder_{quickFolder()};
  std::string said_ = (folder_ / "said.txt").string();

 private:
  std::vector<std::string> files_, old_;
  std::vector<std::string> whole_;    // after a run without a fault
  std::vector<std::string> content_;  // after the last one
};

class RunUnderFaults : public FaultsTest {
 protected:
  RunUnderFaults()
      : FaultsTest(
            {"a.state", "a.csv", "a.obj", "a.ply", "a.pc2", "a.usda", "a_rest.obj", "a00.csv", "a01.csv"}) {
    writeFileAtomically(folder_ / "tiny.json", scene);
    words_ = {"clothsim", "run", "-f", (folder_ / "tiny.json").string(), "--frames", "1", "--backend", "cpu"};
    for (const char* save : {"a.state", "a.csv", "a.obj", "a.ply", "a.pc2", "a.usda", "a%02d.csv"}) {
      words_.push_back("--save");
      words_.push_back((folder_ / "saves" / save).string());
    }
    for (std::string& word : words_) arguments_.push_back(word.data());
    arguments_.push_back(nullptr);
    runWithoutFault();
  }

  int work() override { return runCommandLine(static_cast<int>(words_.size()), arguments_.data()); }

 private:
  std::vector<std::string> words_;
  std::vector<char*> arguments_;
};

TEST_F(RunUnderFaults, LeavesWholeFilesAndAMessageWhereverACallToTheSystemFails) {
  tryAll({{Fault::open, "open", 9},
          {Fault::write, "write", 9},
          {Fault::synchronise, "fsync", 18},
          {Fault::close, "close", 18},
          {Fault::rename, "rename", 9},
          {Fault::stat, "stat", 27}});
}

TEST_F(RunUnderFaults, LeavesWholeFilesAndAMessageWhereverAnAllocationFails) {
  const int count = tryAll(Fault::allocate, false);
  std::cout << "allocation: " << count << " tried\n";
  EXPECT_GE(count, 1000) << "are they still counted?";
}

class FilmUnderFaults : public FaultsTest {
 protected:
  FilmUnderFaults() : FaultsTest({"a.mp4"}) {
    fs::create_directory(folder_ / "bin");
    writeFileAtomically(folder_ / "bin" / "ffmpeg", "#!/bin/sh\ncat >/dev/null && echo film >&3\n");
    fs::permissions(folder_ / "bin" / "ffmpeg", fs::perms(0755));
    ::setenv("PATH", ((folder_ / "bin").string() + ":" + std::getenv("PATH")).c_str(), 1);
    runWithoutFault();
  }

  int work() override {
    try {
      VideoWriter film(folder_ / "saves" / "a.mp4", 16, 16, 30);
      film.addFrame(std::vector<std::uint8_t>(16 * 16 * 3, 200));
      film.close();
      return 0;
    } catch (const Error& error) {
      std::cerr << "clothsim: " << error.what() << '\n';
    } catch (const std::bad_alloc&) {
      std::cerr << "clothsim: not enough memory\n";
    }
    return 1;
  }
};

TEST_F(FilmUnderFaults, IsWholeOrAsItWasWithAMessageWhereverACallFails) {
  tryAll({{Fault::open, "open", 2},
          {Fault::synchronise, "fsync", 2},
          {Fault::close, "close", 4},
          {Fault::rename, "rename", 1},
          {Fault::stat, "stat", 2},
          {Fault::allocate, "allocation", 20}});
}

}  // namespace
}  // namespace clothsim

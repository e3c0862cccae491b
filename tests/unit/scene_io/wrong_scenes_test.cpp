// Every wrong file gets a message that names the file, the place, what was found and what was expected.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "scene_io/scene_io.h"
#include "support/temporary_folder.h"
#include "support/throws.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

const fs::path listFolder = fs::path(TEST_DATA) / "unit" / "scene_io";

// A case of wrong_scenes.txt, which says how it is written.
struct WrongCase {
  std::string name, scene;
  std::vector<std::string> messageParts;
};

// The case that a line "== NAME" or "== NAME < FILE" begins.
WrongCase beginCase(const std::string& line) {
  const std::size_t file = line.find(" < ");
  return {.name = line.substr(3, file == std::string::npos ? file : file - 3),
          .scene = file == std::string::npos ? "" : readFile(listFolder / line.substr(file + 3)),
          .messageParts = {}};
}

std::vector<WrongCase> readCases() {
  std::vector<WrongCase> cases;
  std::istringstream lines(readFile(listFolder / "wrong_scenes.txt"));
  bool inScene = false, firstLine = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("== ")) {
      cases.push_back(beginCase(line));
      inScene = firstLine = true;
    } else if (line.starts_with("-> ") && !cases.empty()) {
      cases.back().messageParts.push_back(line.substr(3));
      inScene = false;
    } else if (inScene) {
      cases.back().scene += (firstLine ? "" : "\n") + line;
      firstLine = false;
    } else if (!line.empty() && !line.starts_with("#")) {
      throw std::runtime_error("wrong_scenes.txt: this line belongs to no case: " + line);
    }
  }
  return cases;
}

void PrintTo(const WrongCase& wrong, std::ostream* out) { *out << wrong.name; }

std::string messageOfLoading(const fs::path& path) {
  try {
    (void)loadScene(path);
  } catch (const SceneError& error) {
    EXPECT_EQ(error.exitCode(), ExitCode::scene);
    return error.what();
  }
  return "no SceneError";
}

std::string messageOfLoading(const test::TemporaryFolder& folder, const std::string& bytes) {
  const fs::path path = folder / "scene.json";
  writeFileAtomically(path, bytes);
  return messageOfLoading(path);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class WrongScene : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongScene, GetsItsMessage) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / (GetParam().name + ".json");
  writeFileAtomically(path, GetParam().scene);
  const std::string message = messageOfLoading(path);
  EXPECT_TRUE(message.starts_with(path.string() + ":")) << message;
  EXPECT_FALSE(contains(message, "json.exception")) << message;
  EXPECT_FALSE(contains(message, "syntax error while")) << "a raw message of the library: " << message;
  EXPECT_FALSE(GetParam().messageParts.empty()) << "the list says nothing of the message";
  for (const std::string& part : GetParam().messageParts)
    EXPECT_TRUE(contains(message, part)) << "expected: " << part << "\nmessage:  " << message;
}

INSTANTIATE_TEST_SUITE_P(Files, WrongScene, testing::ValuesIn(readCases()),
                         [](const testing::TestParamInfo<WrongCase>& wrong) { return wrong.param.name; });

TEST(WrongSceneFile, MissingNamesTheNearestFileInTheFolder) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "pinned2.json", "{}");
  EXPECT_EQ(messageOfLoading(folder / "pined2.json"),
            (folder / "pined2.json").string() + ": no such file; did you mean \"pinned2.json\"?");
}

TEST(WrongSceneFile, MissingFolderIsAMissingFile) {
  EXPECT_EQ(messageOfLoading("/nonexistent/folder/a.json"), "/nonexistent/folder/a.json: no such file");
}

TEST(WrongSceneFile, DirectoryIsNotReadAsAFile) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(messageOfLoading(folder.path()), folder.path().string() + ": is a folder, not a file");
}

TEST(WrongSceneFile, PipeDoesNotHang) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
  EXPECT_TRUE(contains(messageOfLoading(folder / "pipe.json"), "is not a regular file"));
}

TEST(WrongSceneFile, DanglingLinkIsMissing) {
  const test::TemporaryFolder folder;
  fs::create_symlink("nothing.json", folder / "link.json");
  EXPECT_TRUE(contains(messageOfLoading(folder / "link.json"),
                       "link.json: cannot be read: No such file or directory"));
}

TEST(WrongSceneFile, LoopOfLinksIsReported) {
  const test::TemporaryFolder folder;
  fs::create_symlink("b.json", folder / "a.json");
  fs::create_symlink("a.json", folder / "b.json");
  EXPECT_TRUE(
      contains(messageOfLoading(folder / "a.json"), "cannot be read: Too many levels of symbolic links"));
}

TEST(WrongSceneFile, NameThatIsTooLongIsReported) {
  EXPECT_TRUE(contains(messageOfLoading("/tmp/" + std::string(300, 'a') + ".json"), "File name too long"));
}

// Permission bits do not bind root, so a child gives its rights up.
TEST(WrongSceneFile, WithoutPermissionSaysSo) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "secret.json";
  writeFileAtomically(path, "{}");
  fs::permissions(path, fs::perms::none);
  fs::permissions(folder.path(), fs::perms(0755));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (geteuid() == 0 && seteuid(65534) != 0) _exit(2);
    _exit(messageOfLoading(path) == path.string() + ": cannot be read: Permission denied" ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(WrongSceneFile, Above16MebibytesIsNotRead) {
  const test::TemporaryFolder folder;
  const std::string message =
      messageOfLoading(folder, "{\"comment\": \"" + std::string(16 << 20, 'x') + "\"}");
  EXPECT_TRUE(contains(message, "more than the limit of 16777216")) << message;
}

TEST(WrongSceneFile, MillionsOfBracketsDoNotCrash) {
  const test::TemporaryFolder folder;
  for (const char* brackets : {"[", "{\"a\":"}) {
    std::string text;
    while (text.size() < 4'000'000) text += brackets;
    const std::string message = messageOfLoading(folder, text);
    EXPECT_TRUE(contains(message, "nested more than 64 deep")) << message;
  }
}

TEST(WrongSceneFile, MillionsOfValuesAreRefused) {
  const test::TemporaryFolder folder;
  std::string text = "{\"comment\": [0";
  for (int i = 0; i < 1'000'000; ++i) text += ",0";
  const std::string message = messageOfLoading(folder, text + "]}");
  EXPECT_TRUE(contains(message, "more than 1000000 values")) << message;
}

TEST(WrongSceneFile, CutAnywhereIsAnErrorAndNoCrash) {
  const std::string text = readFile(fs::path(TEST_DATA) / "data" / "cs184" / "sphere.json");
  const std::size_t end = text.rfind('}');
  for (std::size_t length = 0; length <= end; ++length)
    EXPECT_THROW((void)parseScene(text.substr(0, length), "cut"), SceneError) << length;
}

TEST(WrongSceneFile, EndsWithItsLastBrace) {
  for (const std::string& more : {std::string("\0", 1), std::string("\n\0 {", 4), std::string("x"),
                                  std::string("{}"), std::string("\xff")}) {
    const std::string message =
        test::messageThrownBy<SceneError>([&] { (void)parseScene("{\"cloth\": {}}" + more, "more"); });
    EXPECT_TRUE(message.starts_with(more.size() == 4 ? "more:2:" : "more:1:")) << message;
  }
}

// A changed byte may leave a right scene; it must not end in anything but a scene or a SceneError.
TEST(WrongSceneFile, WithAnyByteChangedIsReadOrRefused) {
  const std::string text = readFile(fs::path(TEST_DATA) / "data" / "cs184" / "pinned2.json");
  int refused = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char byte : {'\0', '"', '}', '[', '9', '-', '\xff'}) {
      std::string changed = text;
      changed[i] = byte;
      try {
        (void)parseScene(changed, "changed");
      } catch (const SceneError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(WrongSceneFile, LongGarbageIsShortenedInTheMessage) {
  const std::string garbage(100'000, 'x');
  for (const std::string& text : {"{\"cloth\": {\"ks\": \"" + garbage + "\"}}", "{\"" + garbage + "\": 1}",
                                  "{\"cloth\": {\"ks\": " + garbage + "}}"}) {
    try {
      (void)parseScene(text, "long");
      ADD_FAILURE() << "no SceneError";
    } catch (const SceneError& error) {
      EXPECT_LT(std::string(error.what()).size(), 500U);
    }
  }
}

}  // namespace
}  // namespace clothsim

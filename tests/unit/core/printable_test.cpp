#include "core/printable.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene_io/scene_io.h"
#include "support/throws.h"

namespace clothsim {
namespace {

TEST(Printable, LeavesTextOfAnyLanguageAlone) {
  for (const std::string text : {"", "a\tb\nc\n", "Größe 布 🧵 ~"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("\x1b[31mred\x07\r\x7f"), "\\x1b[31mred\\x07\\x0d\\x7f");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\x9b31m")
      << "one character that begins a sequence";
  EXPECT_EQ(printable("gpj.\u202eexe"), "gpj.\\u202eexe") << "written from right to left";
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\x9b\xff"), "\\x9b\\xff");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "overlong";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a pair";
  EXPECT_EQ(printable("\xf0\x9f\xa7"), "\\xf0\\x9f\\xa7") << "cut off";
}

TEST(Printable, ShortensLinesButNotTheirNumber) {
  const std::string text = printable("begin" + std::string(100'000, 'x') + "end\nnext");
  EXPECT_LT(text.size(), 2100u);
  EXPECT_TRUE(text.starts_with("beginxxx"));
  EXPECT_TRUE(text.ends_with("xxxend\nnext"));
  EXPECT_NE(text.find("98108 bytes more"), std::string::npos) << text;
}

// Keys, strings and names of a foreign file, wherever a message quotes them.
TEST(Error, NeverCarriesControlCharactersOfAForeignFile) {
  for (const std::string scene :
       {R"({"cloth": {}, "\u001b[2J": 1})", R"({"cloth": {"pinned": ["\u009b2J"]}})",
        R"({"cloth": {"pinned": ["\u001b[2J"]}})", R"({"cloth": {"mesh": "\u001b[2J.obj"}, "solver": 3})",
        R"({"schema": "\u001b[2J", "cloth": {}})", "{\"cloth\": {}, \"\x1b[2J\": 1}"}) {
    const std::string message =
        test::messageThrownBy<SceneError>([&] { (void)parseScene(scene, "\x1b]0;name\x07.json"); });
    EXPECT_EQ(message.find('\x1b'), std::string::npos) << scene;
    EXPECT_EQ(message.find("\xc2\x9b"), std::string::npos) << scene;
    EXPECT_EQ(message.find('\x07'), std::string::npos) << scene;
  }
}

}  // namespace
}  // namespace clothsim

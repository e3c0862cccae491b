// JSON text to a tree with line numbers. RapidJSON reads the text and hands its values to a builder; the
// offsets of its stream tell where they are, and its error codes what is wrong.
#include <locale.h>  // newlocale() and strtod_l() of POSIX
#include <rapidjson/memorystream.h>
#include <rapidjson/reader.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>

#include "scene_io/json_tree.h"

namespace clothsim {

namespace {

constexpr std::size_t deepest = 64;
constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view incompleteEscape = "a \\u escape is incomplete; write the character itself";

// Numbers are handed over as they are spelled, for messages; numberOf() rounds them correctly.
constexpr unsigned readerFlags =
    rapidjson::kParseValidateEncodingFlag | rapidjson::kParseNumbersAsStringsFlag;

// What is wrong with the syntax, and the byte that shows it.
struct Mistake {
  rapidjson::ParseErrorCode code;
  std::size_t at;
};

[[noreturn]] void complainAt(std::string_view text, std::size_t at, const std::string& message) {
  const std::string_view before = text.substr(0, at);
  const std::size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
  throw JsonComplaint(1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
                      1 + static_cast<int>(at - lineStart), "", message);
}

std::string inAscii(std::string_view text) {
  std::string result;
  for (const char c : text) result += c >= ' ' && c <= '~' ? c : '?';
  return result.size() > 160 ? result.substr(0, 160) + "..." : result;
}

// JSON has a decimal point wherever the program that loaded this library comes from: std::strtod would take
// what the user's language has.
double numberOf(const char* spelled) {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  return ::strtod_l(spelled, nullptr, plain);
}

// RapidJSON gives up on some numbers that are spelled as no person would: 0e400, or 400 digits and e-300.
[[noreturn]] void complainOfNumber(std::string_view text, std::size_t begin, std::size_t end) {
  const std::string spelled(text.substr(begin, end - begin));
  const bool isTooLarge = !std::isfinite(numberOf(spelled.c_str()));
  complainAt(text, end - 1,
             "the number " + inAscii(spelled) +
                 (isTooLarge ? " is too large" : " has too many digits or too large an exponent"));
}

// The word or single character at `at`, for messages and to guess what was meant.
std::string_view wordAround(std::string_view text, std::size_t at) {
  const auto isLetter = [&](std::size_t i) { return std::isalpha(static_cast<unsigned char>(text[i])) != 0; };
  if (at >= text.size()) return {};
  std::size_t begin = at, end = at + 1;
  if (!isLetter(at) && !(at > 0 && isLetter(at - 1))) return text.substr(at, 1);
  while (begin > 0 && isLetter(begin - 1)) --begin;
  while (end < text.size() && isLetter(end)) ++end;
  return text.substr(begin, end - begin);
}

char lastBefore(std::string_view text, std::size_t at) {
  const std::size_t place = text.substr(0, at).find_last_not_of(" \t\r\n");
  return place == std::string_view::npos ? '\0' : text[place];
}

bool isInString(rapidjson::ParseErrorCode code) {
  return code >= rapidjson::kParseErrorStringUnicodeEscapeInvalidHex &&
         code <= rapidjson::kParseErrorStringInvalidEncoding;
}

// What is wrong, for a user who wants to know what to do.
std::string_view sentenceAbout(rapidjson::ParseErrorCode code) {
  switch (code) {
    case rapidjson::kParseErrorStringInvalidEncoding:
      return "a string holds bytes that are not valid UTF-8";
    case rapidjson::kParseErrorStringMissQuotationMark:
      return "a string runs over the end of its line, or holds a control character; write \\n or \\t";
    case rapidjson::kParseErrorStringEscapeInvalid:
      return "after a backslash only \" \\ / b f n r t u may follow; a backslash itself is \\\\";
    case rapidjson::kParseErrorStringUnicodeEscapeInvalidHex:
    case rapidjson::kParseErrorStringUnicodeSurrogateInvalid:
      return incompleteEscape;
    case rapidjson::kParseErrorDocumentRootNotSingular:
      return "there is more text after the closing brace of the scene";
    case rapidjson::kParseErrorObjectMissColon:
      return "a colon is missing between a key and its value";
    case rapidjson::kParseErrorObjectMissName:
      return "expected a key in double quotes";
    case rapidjson::kParseErrorNumberMissFraction:
    case rapidjson::kParseErrorNumberMissExponent:
      return "this is not a number; write 0.5 or 1e-3";
    case rapidjson::kParseErrorObjectMissCommaOrCurlyBracket:
      return "expected a comma or a closing brace before this";
    case rapidjson::kParseErrorArrayMissCommaOrSquareBracket:
      return "expected a comma or a closing bracket before this";
    default:
      return "expected a value here: a number, \"text\", true, false, [list] or {object}";
  }
}

// What a word or character at the place of the mistake was probably meant to be.
std::string guessFromText(std::string_view text, std::size_t at) {
  std::string word(wordAround(text, at));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const std::string_view wrong : {"nan", "inf", "infinity"})
    if (word == wrong) return "NaN and Infinity are not numbers in JSON; write a finite number";
  const bool misspelled = word == "none" || word != wordAround(text, at);
  if (misspelled && (word == "true" || word == "false" || word == "none" || word == "null"))
    return "expected true, false or null in lower case, found " + inAscii(wordAround(text, at));
  const char c = text[at];
  if (c == '/' || c == '#' || (c == '*' && at > 0 && text[at - 1] == '/'))
    return "JSON has no comments; write them as a key, \"comment\": \"...\"";
  if (c == '\'') return "strings stand in double quotes in JSON, not in single quotes";
  if ((c == '}' || c == ']') && lastBefore(text, at) == ',')
    return "trailing comma before the closing bracket";
  if (c == '+' || c == '.') return "a number begins with a digit or -, such as 0.5";
  return "";
}

// Whether the digits that end at `at` begin with a zero too many.
bool hasLeadingZero(std::string_view text, std::size_t at) {
  std::size_t begin = at;
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(text[begin - 1])) != 0) --begin;
  return begin < at && text[begin] == '0' && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

std::string syntaxMessage(std::string_view text, Mistake mistake) {
  if (mistake.at >= text.size()) return "the file ends too early: a brace, bracket or quote is not closed";
  const auto byte = static_cast<unsigned char>(text[mistake.at]);
  if (mistake.at == 0 && (byte >= 0x7F || (byte < ' ' && byte != '\n')))
    return "the file is not text in UTF-8";
  if (!isInString(mistake.code)) {
    if (hasLeadingZero(text, mistake.at)) return "a number has no leading zeros";
    if (std::string guess = guessFromText(text, mistake.at); !guess.empty()) return guess;
  }
  return std::string(sentenceAbout(mistake.code));
}

// The first byte that does not continue the character of UTF-8 that begins at `at` (Unicode 15, table 3-7).
std::size_t illFormedByte(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
  const unsigned char lead = byte(at), second = byte(at + 1);
  if (lead < 0xC2 || lead > 0xF4) return at;
  const int lowest = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  const int highest = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  if (second < lowest || second > highest) return at + 1;
  return (byte(at + 2) & 0xC0U) == 0x80U ? at + 3 : at + 2;
}

// The first byte that is wrong in the escape that begins at `at`: a pair of \uXXXX is the longest.
std::size_t wrongByteOfEscape(std::string_view text, std::size_t at) {
  for (const char expected : std::string_view("\\uXXXX\\uXXXX")) {
    const char c = at < text.size() ? text[at] : '\0';
    if (expected == 'X' ? std::isxdigit(static_cast<unsigned char>(c)) == 0 : c != expected) return at;
    ++at;
  }
  return at - 1;
}

// The end of the number that begins at `begin`.
std::size_t numberEnd(std::string_view text, std::size_t begin) {
  double value = 0;
  return static_cast<std::size_t>(std::from_chars(text.data() + begin, text.data() + text.size(), value).ptr -
                                  text.data());
}

// A handler that ignores all values.
using Ignore = rapidjson::BaseReaderHandler<>;

Mistake refined(std::string_view text, Mistake mistake);

// A token stands where another kind was expected: the mistake is within the token, or else shown at its end.
Mistake atMisplacedToken(std::string_view text, Mistake mistake) {
  if (mistake.at >= text.size() ||
      std::string_view("{}[]:,").find(text[mistake.at]) != std::string_view::npos)
    return mistake;
  rapidjson::MemoryStream stream(text.data() + mistake.at, text.size() - mistake.at);
  rapidjson::Reader reader;
  Ignore ignore;
  const auto result = reader.Parse<readerFlags | rapidjson::kParseStopWhenDoneFlag>(stream, ignore);
  if (!result.IsError()) return {mistake.code, mistake.at + stream.Tell() - 1};
  const Mistake inToken = refined(text, {result.Code(), mistake.at + result.Offset()});
  if (inToken.code == rapidjson::kParseErrorNumberTooBig)
    return {mistake.code, numberEnd(text, mistake.at) - 1};
  const bool commaIsMissing = mistake.code == rapidjson::kParseErrorObjectMissCommaOrCurlyBracket ||
                              mistake.code == rapidjson::kParseErrorArrayMissCommaOrSquareBracket;
  const bool isWrongNumber = inToken.code == rapidjson::kParseErrorNumberMissFraction ||
                             inToken.code == rapidjson::kParseErrorNumberMissExponent;
  if (isInString(inToken.code) || (isWrongNumber && commaIsMissing)) return inToken;
  return {mistake.code, inToken.at};
}

// RapidJSON reports where a token begins; people look where it goes wrong.
Mistake refined(std::string_view text, Mistake mistake) {
  switch (mistake.code) {
    case rapidjson::kParseErrorObjectMissName:
    case rapidjson::kParseErrorObjectMissColon:
    case rapidjson::kParseErrorObjectMissCommaOrCurlyBracket:
    case rapidjson::kParseErrorArrayMissCommaOrSquareBracket:
    case rapidjson::kParseErrorDocumentRootNotSingular:
      return atMisplacedToken(text, mistake);
    case rapidjson::kParseErrorStringEscapeInvalid:  // of a control character, too
      if (text[mistake.at] != '\\') return {rapidjson::kParseErrorStringMissQuotationMark, mistake.at};
      return {mistake.code, wrongByteOfEscape(text, mistake.at)};
    case rapidjson::kParseErrorStringUnicodeEscapeInvalidHex:
    case rapidjson::kParseErrorStringUnicodeSurrogateInvalid:
      return {mistake.code, wrongByteOfEscape(text, mistake.at)};
    case rapidjson::kParseErrorStringInvalidEncoding:
      return {mistake.code, illFormedByte(text, mistake.at)};
    case rapidjson::kParseErrorValueInvalid:  // of a minus without a number, too
      if (mistake.at > 0 && text[mistake.at - 1] == '-')
        return {rapidjson::kParseErrorNumberMissFraction, mistake.at};
      return mistake;
    default:
      return mistake;
  }
}

// RapidJSON's handler: builds the tree, and refuses duplicate keys and what is too deep or too much.
class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const rapidjson::MemoryStream& stream, std::size_t mostValues)
      : text_(text), stream_(stream), mostValues_(mostValues) {}

  bool Null() { return add(std::make_unique<JsonNode>()); }
  bool Bool(bool value) { return add(makeBoolean(value)); }
  bool RawNumber(const char* spelled, rapidjson::SizeType length, bool) {
    JsonPointer node = makeNumber(numberOf(spelled));
    node->text.assign(spelled, length);
    if (!std::isfinite(node->number)) complainOfNumber(text_, stream_.Tell() - length, stream_.Tell());
    return add(std::move(node));
  }
  bool String(const char* value, rapidjson::SizeType length, bool) {
    return add(makeString(checked({value, length})));
  }
  bool StartObject() { return open(makeObject()); }
  bool StartArray() { return open(makeList()); }
  bool EndObject(rapidjson::SizeType) { return close(); }
  bool EndArray(rapidjson::SizeType) { return close(); }

  bool Key(const char* name, rapidjson::SizeType length, bool) {
    key_ = checked({name, length});
    if (!isComment(key_) && !keys_.back().insert(key_).second) {
      JsonNode duplicate;
      duplicate.key = key_;
      duplicate.parent = open_.back();
      duplicate.line = currentLine();
      complain(duplicate,
               "the key is there twice, first in line " + std::to_string(open_.back()->find(key_)->line));
    }
    return true;
  }

  // Numbers come as they are spelled.
  static bool Int(int) { return false; }
  static bool Uint(unsigned) { return false; }
  static bool Int64(std::int64_t) { return false; }
  static bool Uint64(std::uint64_t) { return false; }
  static bool Double(double) { return false; }

  JsonPointer takeRoot() { return std::move(root_); }

 private:
  // The line of the token just read.
  int currentLine() {
    const char* const end = text_.data() + stream_.Tell();
    line_ += static_cast<int>(std::count(text_.data() + counted_, end, '\n'));
    counted_ = stream_.Tell();
    return line_;
  }

  // RapidJSON 1.1 takes the second half of a surrogate pair for a character.
  std::string_view checked(std::string_view string) {
    for (std::size_t at = string.find('\xED'); at != std::string_view::npos; at = string.find('\xED', at + 1))
      if (static_cast<unsigned char>(string[at + 1]) >= 0xA0)
        throw JsonComplaint(currentLine(), 0, "", std::string(incompleteEscape));
    return string;
  }

  bool add(JsonPointer node) {
    insert(std::move(node));
    return true;
  }

  JsonNode& insert(JsonPointer node) {
    node->line = currentLine();
    if (++values_ > mostValues_)
      throw JsonComplaint(node->line, 0, "",
                          "the file holds more than " + std::to_string(mostValues_) + " values");
    if (!open_.empty()) return open_.back()->append(std::move(key_), std::move(node));
    root_ = std::move(node);
    return *root_;
  }

  bool open(JsonPointer node) {
    if (open_.size() >= deepest)
      throw JsonComplaint(currentLine(), 0, "",
                          "brackets are nested more than " + std::to_string(deepest) + " deep");
    open_.push_back(&insert(std::move(node)));
    keys_.emplace_back();
    return true;
  }

  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  std::string_view text_;
  const rapidjson::MemoryStream& stream_;
  std::size_t mostValues_, counted_ = 0, values_ = 0;
  int line_ = 1;
  std::string key_;
  JsonPointer root_;
  std::vector<JsonNode*> open_;
  std::vector<std::set<std::string>> keys_;  // of the open objects and lists
};

}  // namespace

JsonPointer parseJson(std::string_view text, std::size_t mostValues, const std::string& what) {
  if (text.find_first_not_of(" \t\r\n\xEF\xBB\xBF") == std::string_view::npos)
    throw JsonComplaint(0, 0, "", "the file is empty; expected " + what + ", {...}");
  rapidjson::MemoryStream stream(text.data(), text.size());
  if (text.starts_with(byteOrderMark.front()))
    for (const char byte : byteOrderMark) {
      if (stream.Peek() != byte) complainAt(text, stream.Tell(), "the file is not text in UTF-8");
      stream.Take();
    }
  TreeBuilder builder(text, stream, mostValues);
  rapidjson::Reader reader;
  const rapidjson::ParseResult result = reader.Parse<readerFlags>(stream, builder);
  if (result.Code() == rapidjson::kParseErrorNumberTooBig)
    complainOfNumber(text, result.Offset(), numberEnd(text, result.Offset()));
  if (result.IsError()) {
    const Mistake mistake = refined(text, {result.Code(), result.Offset()});
    complainAt(text, mistake.at, syntaxMessage(text, mistake));
  }
  // To RapidJSON it is the end of the text.
  if (const std::size_t at = text.find('\0'); at != std::string_view::npos)
    throw JsonComplaint(
        1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')),
        0, "", "found a NUL character, expected text; nothing may follow the closing brace of the scene");
  return builder.takeRoot();
}

}  // namespace clothsim

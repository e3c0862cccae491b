// JSON text to a tree with line numbers. nlohmann::json's lexer calls our handler with the values; an
// iterator that notes how far the lexer has read tells where they are.
#include <algorithm>
#include <cctype>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "scene_io/json_tree.h"

namespace clothsim {

namespace {

constexpr std::size_t deepest = 64;
constexpr std::size_t mostValues = 1'000'000;

// Walks over the text and leaves a mark of the farthest character read.
class MarkingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  MarkingIterator(const char* at, std::size_t* consumed) : at_(at), consumed_(consumed) {}
  reference operator*() const { return *at_; }
  MarkingIterator& operator++() {
    ++at_;
    ++*consumed_;
    return *this;
  }
  MarkingIterator operator++(int) {
    MarkingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const MarkingIterator& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  std::size_t* consumed_;
};

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text) result += c >= ' ' && c <= '~' ? c : '?';
  return result.size() > 160 ? result.substr(0, 160) + "..." : result;
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

// nlohmann's words for a mistake, and ours, which tell what to do.
struct Rewording {
  std::string_view theirs, ours;
};
constexpr Rewording rewordings[] = {
    {"ill-formed UTF-8", "a string holds bytes that are not valid UTF-8"},
    {"invalid BOM", "the file is not text in UTF-8"},
    {"control character",
     "a string runs over the end of its line, or holds a control character; write \\n or \\t"},
    {"forbidden character after backslash",
     "after a backslash only \" \\ / b f n r t u may follow; a backslash itself is \\\\"},
    {"expected end of input", "there is more text after the closing brace of the scene"},
    {"parsing object separator", "a colon is missing between a key and its value"},
    {"parsing object key", "expected a key in double quotes"},
    {"invalid number", "this is not a number; write 0.5 or 1e-3"},
    {"must be followed by", "a \\u escape is incomplete; write the character itself"},
    {"parsing object - ", "expected a comma or a closing brace before this"},
    {"parsing array - ", "expected a comma or a closing bracket before this"},
    {"parsing value - ", "expected a value here: a number, \"text\", true, false, [list] or {object}"},
};

// What a word or character at the place of the mistake was probably meant to be.
std::string guessFromText(std::string_view text, std::size_t at) {
  std::string word(wordAround(text, at));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const std::string_view wrong : {"nan", "inf", "infinity"})
    if (word == wrong) return "NaN and Infinity are not numbers in JSON; write a finite number";
  const bool misspelled = word == "none" || word != wordAround(text, at);
  if (misspelled && (word == "true" || word == "false" || word == "none" || word == "null"))
    return "expected true, false or null in lower case, found " + printable(wordAround(text, at));
  const char c = text[at];
  if (c == '/' || c == '#' || (c == '*' && at > 0 && text[at - 1] == '/'))
    return "JSON has no comments; write them as a key, \"comment\": \"...\"";
  if (c == '\'') return "strings stand in double quotes in JSON, not in single quotes";
  if ((c == '}' || c == ']') && lastBefore(text, at) == ',')
    return "trailing comma before the closing bracket";
  if (c == '+' || c == '.') return "a number begins with a digit or -, such as 0.5";
  return "";
}

// The digits of a number that ends at `at`.
bool hasLeadingZero(std::string_view text, std::size_t at) {
  std::size_t begin = at;
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(text[begin - 1])) != 0) --begin;
  return begin < at && text[begin] == '0' && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

// The message of a wrong syntax; `error` is nlohmann's, for what we do not know better.
std::string syntaxMessage(std::string_view text, std::size_t at, const std::string& error) {
  constexpr std::string_view overflow = "number overflow parsing '";
  if (const std::size_t place = error.find(overflow); place != std::string::npos)
    return "the number " +
           printable(error.substr(place + overflow.size(), error.rfind('\'') - place - overflow.size())) +
           " is too large";
  if (at >= text.size()) return "the file ends too early: a brace, bracket or quote is not closed";
  const auto byte = static_cast<unsigned char>(text[at]);
  if (at == 0 && (byte >= 0x7F || (byte < ' ' && byte != '\n'))) return "the file is not text in UTF-8";
  const bool insideString = error.find("invalid string") != std::string::npos;
  if (!insideString) {
    if (hasLeadingZero(text, at)) return "a number has no leading zeros";
    if (std::string guess = guessFromText(text, at); !guess.empty()) return guess;
  }
  for (const auto& [theirs, ours] : rewordings)
    if (error.find(theirs) != std::string::npos) return std::string(ours);
  const std::size_t sentence = error.find("syntax error");
  return printable(sentence == std::string::npos ? error : error.substr(sentence));
}

// nlohmann's SAX interface: builds the tree, and refuses what its own tree would swallow.
class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const std::size_t* consumed) : text_(text), consumed_(consumed) {}

  bool null() { return add(std::make_unique<JsonNode>()); }
  bool boolean(bool value) { return add(makeBoolean(value)); }
  bool number_integer(std::int64_t value) {  // below 0, and -0
    return value == 0 ? addNumber(-0.0, "-0") : addNumber(static_cast<double>(value), std::to_string(value));
  }
  bool number_unsigned(std::uint64_t value) {
    return addNumber(static_cast<double>(value), std::to_string(value));
  }
  bool number_float(double value, const std::string& spelled) { return addNumber(value, spelled); }
  bool string(std::string& value) { return add(makeString(value)); }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(makeObject()); }
  bool start_array(std::size_t) { return open(makeList()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    key_ = name;
    if (!isComment(name) && !keys_.back().insert(name).second) {
      JsonNode duplicate;
      duplicate.key = name;
      duplicate.parent = open_.back();
      duplicate.line = currentLine();
      complain(duplicate,
               "the key is there twice, first in line " + std::to_string(open_.back()->find(name)->line));
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) {
    const std::size_t at = std::min(position == 0 ? 0 : position - 1, text_.size());
    const std::string_view before = text_.substr(0, at);
    const std::size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
    const int line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    throw JsonComplaint(line, 1 + static_cast<int>(at - lineStart), "",
                        syntaxMessage(text_, at, error.what()));
  }

  JsonPointer takeRoot() { return std::move(root_); }

 private:
  // The line of the token just read. The character read last is either its end or, after a number, the one
  // behind it.
  int currentLine() {
    const std::size_t end = *consumed_ == 0 ? 0 : std::min(*consumed_ - 1, text_.size());
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(std::max(end, counted_)),
                                         '\n'));
    counted_ = std::max(end, counted_);
    return line_;
  }

  bool addNumber(double value, std::string spelled) {
    JsonPointer node = makeNumber(value);
    node->text = std::move(spelled);
    return add(std::move(node));
  }

  bool add(JsonPointer node) {
    insert(std::move(node));
    return true;
  }

  JsonNode& insert(JsonPointer node) {
    node->line = currentLine();
    if (++values_ > mostValues)
      throw JsonComplaint(node->line, 0, "",
                          "the file holds more than " + std::to_string(mostValues) + " values");
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
  const std::size_t* consumed_;
  std::size_t counted_ = 0, values_ = 0;
  int line_ = 1;
  std::string key_;
  JsonPointer root_;
  std::vector<JsonNode*> open_;
  std::vector<std::set<std::string>> keys_;  // of the open objects and lists
};

}  // namespace

JsonPointer parseJson(std::string_view text) {
  if (text.find_first_not_of(" \t\r\n\xEF\xBB\xBF") == std::string_view::npos)
    throw JsonComplaint(0, 0, "", "the file is empty; expected a scene, {...}");
  std::size_t consumed = 0, unused = 0;
  TreeBuilder builder(text, &consumed);
  nlohmann::json::sax_parse(MarkingIterator(text.data(), &consumed),
                            MarkingIterator(text.data() + text.size(), &unused), &builder);
  // nlohmann's lexer takes it for the end of the text.
  if (const std::size_t at = text.find('\0'); at != std::string_view::npos)
    throw JsonComplaint(
        1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')),
        0, "", "found a NUL character, expected text; nothing may follow the closing brace of the scene");
  return builder.takeRoot();
}

}  // namespace clothsim

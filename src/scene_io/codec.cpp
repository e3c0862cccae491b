// The JSON forms of single values.
#include "scene_io/codec.h"

#include <array>
#include <cmath>
#include <utility>

#include "cloth/material.h"
#include "core/nearest.h"

namespace clothsim {

namespace {

// Squares of larger numbers overflow in binary32, and those of smaller ones vanish.
constexpr double largestNumber = 1e15, smallestNumber = 1e-20;

template <class Enum, std::size_t count = 2>
using Words = std::array<std::pair<std::string_view, Enum>, count>;

// Of an enumeration whose words stand in its order, without the first `left`.
template <class Enum, std::size_t left = 0, std::size_t count>
constexpr auto wordsInOrder(const std::array<const char*, count>& names) {
  Words<Enum, count - left> words{};
  for (std::size_t i = left; i < count; ++i) words[i - left] = {names[i], static_cast<Enum>(i)};
  return words;
}

constexpr Words<Orientation> orientations{
    {{"horizontal", Orientation::horizontal}, {"vertical", Orientation::vertical}}};
constexpr auto integrators = wordsInOrder<Integrator>(integratorNames);
constexpr auto selfCollisions = wordsInOrder<SelfCollision, 1>(selfCollisionNames);  // but "off"
constexpr Words<Interpolation> interpolations{
    {{"linear", Interpolation::linear}, {"cubic", Interpolation::cubic}}};
constexpr Words<Paint, 3> paints{{{"red", Paint::red}, {"green", Paint::green}, {"blue", Paint::blue}}};
constexpr Words<FrictionLaw> frictionLaws{{{"cs184", FrictionLaw::cs184}, {"coulomb", FrictionLaw::coulomb}}};
constexpr std::array<std::pair<std::string_view, GridSide>, 4> gridSides{{{"top", GridSide::top},
                                                                          {"bottom", GridSide::bottom},
                                                                          {"left", GridSide::left},
                                                                          {"right", GridSide::right}}};

std::vector<std::string> wordsOf(std::span<const std::string_view> choices) {
  return {choices.begin(), choices.end()};
}

template <class Table>
std::vector<std::string> wordsOf(const Table& table) {
  std::vector<std::string> words;
  for (const auto& [word, value] : table) words.emplace_back(word);
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

template <class Table>
auto readWord(const JsonNode& node, const Table& table, const std::string& expected) {
  if (node.kind == JsonKind::string) {
    for (const auto& [word, value] : table)
      if (word == node.text) return value;
    complain(node,
             "expected " + expected + ", found " + foundText(node) + didYouMean(node.text, wordsOf(table)));
  }
  complainExpected(node, expected);
}

std::string readChoice(const JsonNode& node, std::span<const std::string_view> choices) {
  const std::vector<std::string> words = wordsOf(choices);
  const std::string expected = "one of " + joined(words);
  if (node.kind != JsonKind::string) complainExpected(node, expected);
  if (std::find(words.begin(), words.end(), node.text) == words.end())
    complain(node, "expected " + expected + ", found " + foundText(node) + didYouMean(node.text, words));
  return node.text;
}

template <class Table, class Enum>
JsonPointer writeWord(const Table& table, Enum wanted) {
  for (const auto& [word, value] : table)
    if (value == wanted) return makeString(word);
  return makeString("");
}

// "a number > 0", "a whole number from 2 to 16384"
std::string numberText(const Limits& limits, const std::string& noun) {
  const std::string text = limits.nonZero ? "" : limitsText(limits);
  if (text.empty()) return noun;
  return noun + (text.find(" to ") != std::string::npos ? " from " : " ") + text;
}

void checkNumber(const JsonNode& node, const Limits& limits, const std::string& expected) {
  if (node.kind != JsonKind::number || !within(limits, node.number)) complainExpected(node, expected);
  const double size = std::abs(node.number);
  if (size > largestNumber) complainExpected(node, "a number of at most 1e15");
  if (size != 0 && size < smallestNumber) complainExpected(node, "0, or a number of at least 1e-20");
}

const FieldTraits anyNumber{.key = "", .help = ""};

// The shapes by their names, each with its defaults.
std::vector<std::pair<std::string_view, Collider>> shapes() {
  std::vector<std::pair<std::string_view, Collider>> table;
  for (const Collider& collider : defaultColliders()) table.emplace_back(typeOf(collider), collider);
  return table;
}

}  // namespace

void readValue(const JsonNode& node, const FieldTraits&, bool& target) {
  if (node.kind != JsonKind::boolean) complainExpected(node, "true or false");
  target = node.boolean;
}

void readValue(const JsonNode& node, const FieldTraits& traits, int& target) {
  const std::string expected = numberText(traits.limits, "a whole number");
  if (node.kind != JsonKind::number || node.number != std::floor(node.number))
    complainExpected(node, expected);
  if (!within(traits.limits, node.number)) complainExpected(node, expected);
  if (std::abs(node.number) > std::numeric_limits<int>::max())
    complainExpected(node, expected + " of at most " + std::to_string(std::numeric_limits<int>::max()));
  target = static_cast<int>(node.number);
}

void readValue(const JsonNode& node, const FieldTraits& traits, double& target) {
  checkNumber(node, traits.limits, numberText(traits.limits, "a number"));
  target = node.number;
}

void readValue(const JsonNode& node, const FieldTraits& traits, std::string& target) {
  if (!traits.choices.empty()) {
    target = readChoice(node, traits.choices);
    return;
  }
  if (node.kind != JsonKind::string) complainExpected(node, "a string in double quotes");
  target = node.text;
}

void readValue(const JsonNode& node, const FieldTraits& traits, Vec3d& target) {
  const bool isColor = traits.format == Format::color;
  const std::string expected =
      isColor ? "three numbers from 0 to 1, [r, g, b]" : std::string("three numbers, ") + "[x, y, z]";
  if (node.kind != JsonKind::list || node.children.size() != 3) complainExpected(node, expected);
  double* const components[] = {&target.x, &target.y, &target.z};
  for (std::size_t i = 0; i < 3; ++i) {
    checkNumber(*node.children[i], traits.limits, numberText(traits.limits, "a number"));
    *components[i] = node.children[i]->number;
  }
  if (traits.limits.nonZero && target == Vec3d{})
    complain(node, "expected a direction other than [0, 0, 0], found zeros");
}

void readValue(const JsonNode& node, const FieldTraits&, Orientation& target) {
  const std::string expected = "0 or \"horizontal\", 1 or \"vertical\"";
  if (node.kind == JsonKind::number && (node.number == 0 || node.number == 1))
    target = node.number == 0 ? Orientation::horizontal : Orientation::vertical;
  else
    target = readWord(node, orientations, expected);
}

void readValue(const JsonNode& node, const FieldTraits&, Integrator& target) {
  target = readWord(node, integrators, "one of " + joined(wordsOf(integrators)));
}

void readValue(const JsonNode& node, const FieldTraits& traits, SelfCollision& target) {
  if (node.kind != JsonKind::boolean)
    target = readWord(node, selfCollisions, typeName(traits, target));
  else if (!node.boolean)
    target = SelfCollision::off;
  else if (target == SelfCollision::off)
    target = SelfCollision::robust;
}

void readValue(const JsonNode& node, const FieldTraits&, Interpolation& target) {
  target = readWord(node, interpolations, "one of " + joined(wordsOf(interpolations)));
}

void readValue(const JsonNode& node, const FieldTraits&, Paint& target) {
  target = readWord(node, paints, "one of " + joined(wordsOf(paints)));
}

void readValue(const JsonNode& node, const FieldTraits&, FrictionLaw& target) {
  target = readWord(node, frictionLaws, "one of " + joined(wordsOf(frictionLaws)));
}

void readValue(const JsonNode& node, const FieldTraits& traits, GridPoint& target) {
  if (node.kind != JsonKind::list || node.children.size() != 2)
    complainExpected(node, "a pair [column, row] of whole numbers");
  readValue(*node.children[0], traits, target.column);
  readValue(*node.children[1], traits, target.row);
}

void readValue(const JsonNode& node, const FieldTraits&, Range& target) {
  if (node.kind != JsonKind::list || node.children.size() != 2)
    complainExpected(node, "two numbers, [low, high]");
  readValue(*node.children[0], anyNumber, target.low);
  readValue(*node.children[1], anyNumber, target.high);
  if (target.low > target.high)
    complain(node, "expected [low, high] with low <= high, found " + formatJsonLine(node));
}

namespace {

template <class T>
Pin pinOf(const JsonNode& node) {
  T pin;
  readObject(node, pin);
  return pin;
}

Pin readPinObject(const JsonNode& node) {
  if (node.find("vertex") != nullptr) return pinOf<VertexPin>(node);
  if (node.find("region") != nullptr) return pinOf<RegionPin>(node);
  if (node.find("group") != nullptr) return pinOf<GroupPin>(node);
  if (node.find("painted") != nullptr) return pinOf<PaintedPin>(node);
  for (const auto& member : node.children)
    if (!isComment(member->key) && member->key != "from" && member->key != "to")
      complainUnknownKey(*member, {"from", "to", "vertex", "region", "group", "painted"});
  return pinOf<GridRange>(node);
}

}  // namespace

void readValue(const JsonNode& node, const FieldTraits& traits, Pin& target) {
  GridPoint point;
  switch (node.kind) {
    case JsonKind::list:
      readValue(node, traits, point);
      target = point;
      break;
    case JsonKind::object:
      target = readPinObject(node);
      break;
    default:
      target = readWord(node, gridSides,
                        "[column, row], \"top\", \"bottom\", \"left\", \"right\", or "
                        "{\"from\": [column, row], \"to\": [column, row]}; of a mesh {\"vertex\": number}, "
                        "{\"region\": {from, to}}, {\"group\": name}, or {\"painted\": \"red\"}");
  }
}

void readValue(const JsonNode& node, const FieldTraits&, Collider& target) {
  expectObject(node);
  const std::string expected = "one of " + colliderTypes();
  const JsonNode* type = node.find("type");
  if (type == nullptr) complain(node, "the collider needs the key \"type\": " + expected);
  target = readWord(*type, shapes(), expected);
  std::visit([&](auto& shape) { readObject(node, shape, {"type"}); }, target);
}

void readValue(const JsonNode& node, const FieldTraits&, std::vector<PinMotion>& target) {
  if (node.kind != JsonKind::list && node.kind != JsonKind::object)
    complainExpected(node, "a motion {\"keys\": [...]}, or a list of motions");
  target.clear();
  if (node.kind == JsonKind::object) readObject(node, target.emplace_back());
  if (node.kind == JsonKind::list)
    for (const auto& child : node.children) readObject(*child, target.emplace_back());
}

void readValue(const JsonNode& node, const FieldTraits& traits, std::optional<double>& target) {
  const bool orFalse = traits.format == Format::orFalse;
  if (orFalse && node.kind == JsonKind::boolean && !node.boolean) {
    target.reset();
    return;
  }
  checkNumber(node, traits.limits, (orFalse ? "false or " : "") + numberText(traits.limits, "a number"));
  target = node.number;
}

void readValue(const JsonNode& node, const FieldTraits& traits, AutoCount& target) {
  if (node.kind == JsonKind::string && node.text == "auto") {
    target.automatic = true;
    return;
  }
  if (node.kind == JsonKind::string)
    complainExpected(node, "\"auto\" or " + numberText(traits.limits, "a whole number"));
  int count = 0;
  readValue(node, traits, count);
  target = count;
}

void readValue(const JsonNode& node, const FieldTraits&, std::optional<Material>& target) {
  if (node.kind == JsonKind::string) {
    target = materialPreset(node.text);
    if (!target)
      complain(node, "expected an object or one of " + joined(materialPresetNames()) + ", found " +
                         foundText(node) + didYouMean(node.text, materialPresetNames()));
    return;
  }
  if (!target) target.emplace();
  readObject(node, *target);
}

// A preset by its name, which says more than its numbers.
JsonPointer writeValue(const FieldTraits&, const std::optional<Material>& value) {
  for (const std::string& name : materialPresetNames())
    if (value == materialPreset(name)) return makeString(name);
  return spelledOut(*value);
}
JsonPointer spelledOut(const Material& material) { return writeObject(material, Material{}); }

JsonPointer writeValue(const FieldTraits&, bool value) { return makeBoolean(value); }
JsonPointer writeValue(const FieldTraits&, int value) { return makeNumber(value); }
JsonPointer writeValue(const FieldTraits&, double value) { return makeNumber(value); }
JsonPointer writeValue(const FieldTraits&, const std::string& value) { return makeString(value); }
JsonPointer writeValue(const FieldTraits&, Vec3d value) { return makeVector(value); }
JsonPointer writeValue(const FieldTraits&, Orientation value) { return writeWord(orientations, value); }
JsonPointer writeValue(const FieldTraits&, Integrator value) { return writeWord(integrators, value); }
JsonPointer writeValue(const FieldTraits&, SelfCollision value) {
  return value == SelfCollision::off ? makeBoolean(false) : writeWord(selfCollisions, value);
}

JsonPointer writeValue(const FieldTraits&, FrictionLaw value) { return writeWord(frictionLaws, value); }
JsonPointer writeValue(const FieldTraits&, Interpolation value) { return writeWord(interpolations, value); }
JsonPointer writeValue(const FieldTraits&, Paint value) { return writeWord(paints, value); }

JsonPointer writeValue(const FieldTraits&, GridPoint value) {
  JsonPointer pair = makeList();
  pair->append("", makeNumber(value.column));
  pair->append("", makeNumber(value.row));
  return pair;
}

JsonPointer writeValue(const FieldTraits&, const Range& value) {
  JsonPointer pair = makeList();
  pair->append("", makeNumber(value.low));
  pair->append("", makeNumber(value.high));
  return pair;
}

JsonPointer writeValue(const FieldTraits& traits, const Pin& value) {
  if (const auto* side = std::get_if<GridSide>(&value)) return writeWord(gridSides, *side);
  if (const auto* point = std::get_if<GridPoint>(&value)) return writeValue(traits, *point);
  return std::visit(
      [](const auto& pin) -> JsonPointer {
        using T = std::remove_cvref_t<decltype(pin)>;
        if constexpr (HasFields<T>)
          return writeObject(pin, T{});
        else
          return makeObject();
      },
      value);
}

JsonPointer writeValue(const FieldTraits&, const Collider& value) {
  JsonPointer node = makeObject();
  node->append("type", makeString(std::string(typeOf(value))));
  JsonPointer members = std::visit(
      [](const auto& shape) { return writeObject(shape, std::remove_cvref_t<decltype(shape)>{}); }, value);
  for (auto& member : members->children) {
    std::string key = member->key;
    node->append(std::move(key), std::move(member));
  }
  return node;
}

JsonPointer writeValue(const FieldTraits&, const std::vector<PinMotion>& values) {
  if (values.size() == 1 && values[0].pinned.empty()) return writeObject(values[0], PinMotion{});
  JsonPointer list = makeList();
  for (const PinMotion& motion : values) list->append("", writeObject(motion, PinMotion{}));
  return list;
}

JsonPointer writeValue(const FieldTraits&, const std::optional<double>& value) {
  return value ? makeNumber(*value) : makeBoolean(false);
}

JsonPointer writeValue(const FieldTraits& traits, const AutoCount& value) {
  return value.automatic ? makeString("auto") : writeValue(traits, value.count);
}

std::string colliderTypes() { return joined(wordsOf(shapes())); }

std::string typeName(const FieldTraits&, const bool&) { return "boolean"; }
std::string typeName(const FieldTraits&, const int&) { return "integer"; }
std::string typeName(const FieldTraits&, const double&) { return "number"; }
std::string typeName(const FieldTraits& traits, const std::string&) {
  return traits.choices.empty() ? "string" : "one of " + joined(wordsOf(traits.choices));
}
std::string typeName(const FieldTraits& traits, const Vec3d&) {
  return traits.format == Format::color ? "[r, g, b]" : "[x, y, z]";
}
std::string typeName(const FieldTraits&, const Orientation&) { return "one of 0 (horizontal), 1 (vertical)"; }
std::string typeName(const FieldTraits&, const SelfCollision&) {
  return "false, true, " + joined(wordsOf(selfCollisions));
}
std::string typeName(const FieldTraits&, const Integrator&) {
  return "one of " + joined(wordsOf(integrators));
}
std::string typeName(const FieldTraits&, const FrictionLaw&) {
  return "one of " + joined(wordsOf(frictionLaws));
}
std::string typeName(const FieldTraits&, const Interpolation&) {
  return "one of " + joined(wordsOf(interpolations));
}
std::string typeName(const FieldTraits&, const Paint&) { return "one of " + joined(wordsOf(paints)); }
std::string typeName(const FieldTraits&, const GridPoint&) { return "[column, row]"; }
std::string typeName(const FieldTraits&, const Range&) { return "[low, high]"; }
std::string typeName(const FieldTraits&, const Pin&) {
  return "[column, row], " + joined(wordsOf(gridSides)) +
         ", or {from, to}; of a mesh {vertex}, {region}, {group}, or {painted}";
}
std::string typeName(const FieldTraits&, const AutoCount&) { return "integer or auto"; }
std::string typeName(const FieldTraits&, const std::optional<Material>&) {
  return "object or one of " + joined(materialPresetNames());
}
std::string typeName(const FieldTraits&, const Collider&) { return "object"; }
std::string typeName(const FieldTraits&, const std::vector<PinMotion>&) {
  return "object or list of objects";
}
std::string typeName(const FieldTraits& traits, const std::optional<double>&) {
  return traits.format == Format::orFalse ? "false or number" : "number";
}

}  // namespace clothsim

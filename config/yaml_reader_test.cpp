#include "config/yaml_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "config/parameter_table.hpp"
#include "config/yaml_writer.hpp"

namespace spf {

enum class Flavour { sweet, sour };
template <>
struct EnumNames<Flavour> {
  static constexpr std::array<std::pair<Flavour, const char*>, 2> values{
      {{Flavour::sweet, "sweet"}, {Flavour::sour, "sour"}}};
};

namespace {

struct Inner {
  double length = 2.0;
  double reach = std::numeric_limits<double>::infinity();
  bool on = true;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("length", self.length, "m", Range{0.0, 10.0}, "a length");
    visit("reach", self.reach, "m", Range{0.0, std::numeric_limits<double>::infinity()}, "a reach");
    visit("on", self.on, "a switch");
  }
};

struct Entry {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  std::optional<double> angle;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("place");
    visit("place", self.place, "m", Range{-100.0, 100.0}, "a place");
    visit("angle", self.angle, "rad", Range{-7.0, 7.0}, "an angle");
  }
};

struct Outer {
  int count = 3;
  std::uint64_t seed = 1;
  Flavour flavour = Flavour::sweet;
  std::string name = "none";
  Inner inner;
  std::optional<Inner> other;
  std::vector<Entry> entries;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("count", self.count, "1", Range{1, 100}, "a number");
    visit("seed", self.seed, "1", Range{0.0, 18446744073709551615.0}, "a seed");
    visit("flavour", self.flavour, "a choice");
    visit("name", self.name, "a text");
    visit.group("inner", self.inner);
    visit.optional_group("other", self.other, "a group that may be absent");
    visit.list("entries", self.entries, "a list");
  }
};

struct Read {
  Outer outer;
  InputProblems problems;
};

Read read(const std::string& text, const std::vector<std::string>& settings = {}) {
  Read result;
  YamlNode root = parse_yaml(text, "file.yaml", result.problems);
  for (const std::string& setting : settings) apply_setting(root, setting, "--set", result.problems);
  read_parameters(root, result.outer, result.problems);
  return result;
}

TEST(YamlReader, ReadsEveryKindOfField) {
  const Read result = read(
      "count: 7\nseed: 18446744073709551615\nflavour: sour\nname: \"a: b\"\n"
      "inner: {length: +1.5e0, reach: .inf, on: false}\nother: {length: 4}\n"
      "entries:\n  - place: [1, -2.5]\n  - {place: [0, 0], angle: 3}\n");
  ASSERT_EQ(result.problems.to_text(), "");
  EXPECT_EQ(result.outer.count, 7);
  EXPECT_EQ(result.outer.seed, 18446744073709551615u);
  EXPECT_EQ(result.outer.flavour, Flavour::sour);
  EXPECT_EQ(result.outer.name, "a: b");
  EXPECT_EQ(result.outer.inner.length, 1.5);
  EXPECT_FALSE(result.outer.inner.on);
  ASSERT_TRUE(result.outer.other.has_value());
  EXPECT_EQ(result.outer.other->length, 4.0);
  ASSERT_EQ(result.outer.entries.size(), 2u);
  EXPECT_EQ(result.outer.entries[0].place, (Eigen::Vector2d{1.0, -2.5}));
  EXPECT_FALSE(result.outer.entries[0].angle.has_value());
  EXPECT_EQ(result.outer.entries[1].angle, 3.0);
}

TEST(YamlReader, KeepsDefaultsOfAbsentKeys) {
  const Read result = read("inner: {length: 1}\nother:\n");
  ASSERT_EQ(result.problems.to_text(), "");
  EXPECT_EQ(result.outer.count, 3);
  EXPECT_EQ(result.outer.inner.length, 1.0);
  EXPECT_TRUE(result.outer.inner.on);
  EXPECT_TRUE(std::isinf(result.outer.inner.reach));
}

struct BadInput {
  const char* text;
  const char* expected;  ///< the whole report
};

class YamlReaderBadInput : public testing::TestWithParam<BadInput> {};

TEST_P(YamlReaderBadInput, IsRefusedWithPlaceKeyValueAndLimit) {
  const Outer before;
  const Read result = read(GetParam().text);
  EXPECT_EQ(result.problems.to_text(), GetParam().expected);
  EXPECT_EQ(result.outer.count, before.count);  // nothing bad is taken over
  EXPECT_EQ(result.outer.inner.length, before.inner.length);
}

INSTANTIATE_TEST_SUITE_P(
    Values, YamlReaderBadInput,
    testing::Values(
        BadInput{"count: 0", "file.yaml:1:8: count = 0 must lie in [1, 100]"},
        BadInput{"count: 1.5", "file.yaml:1:8: count = 1.5 must be a whole number"},
        BadInput{"count: 99999999999999999999",
                 "file.yaml:1:8: count = 99999999999999999999 must lie in [1, 100]"},
        BadInput{"count: \"5\"", "file.yaml:1:8: count = \"5\" must be a whole number"},
        BadInput{"count: 0x10", "file.yaml:1:8: count = 0x10 must be a whole number"},
        BadInput{"count: [1]", "file.yaml:1:8: count = [1] must be a whole number"},
        BadInput{"count: {a: 1}", "file.yaml:1:8: count = {...} must be a whole number"},
        BadInput{"count:", "file.yaml:1:1: count = nothing must be a whole number"},
        BadInput{"seed: -1", "file.yaml:1:7: seed = -1 must be a whole number"},
        BadInput{"flavour: bitter", "file.yaml:1:10: flavour = bitter must be one of sweet, sour"},
        BadInput{"flavour: sweat",
                 "file.yaml:1:10: flavour = sweat must be one of sweet, sour; did you mean sweet?"},
        BadInput{"name: [a]", "file.yaml:1:7: name = [a] must be text"},
        BadInput{"inner:\n  length: -1", "file.yaml:2:11: inner.length = -1 must lie in [0, 10] m"},
        BadInput{"inner: {length: .nan}",
                 "file.yaml:1:17: inner.length = .nan must be a number in m, not NaN"},
        BadInput{"inner: {length: nan}", "file.yaml:1:17: inner.length = nan must be a number in m, not NaN"},
        BadInput{"inner: {length: .inf}",
                 "file.yaml:1:17: inner.length = .inf must lie in [0, 10] m and be finite"},
        BadInput{"inner: {length: inf}", "file.yaml:1:17: inner.length = inf must be a number in m"},
        BadInput{"inner: {length: 1e999}",
                 "file.yaml:1:17: inner.length = 1e999 is too large or too small for a number; it must lie "
                 "in [0, 10] m"},
        BadInput{"inner: {length: 3 m}",
                 "file.yaml:1:17: inner.length = 3 m must be a number in m, written without a unit"},
        BadInput{"inner: {length: long}", "file.yaml:1:17: inner.length = long must be a number in m"},
        BadInput{"inner: {length: \"1,5\"}", "file.yaml:1:17: inner.length = \"1,5\" must be a number in m"},
        BadInput{"inner: {reach: -.inf}",
                 "file.yaml:1:16: inner.reach = -.inf must be at least 0 m and be finite"},
        BadInput{"inner: {on: yes}", "file.yaml:1:13: inner.on = yes must be true or false"},
        BadInput{"inner: {on: 1}", "file.yaml:1:13: inner.on = 1 must be true or false"},
        BadInput{"inner: 5", "file.yaml:1:8: inner = 5 must be a map of keys and values"},
        BadInput{"inner: [1]", "file.yaml:1:8: inner = [1] must be a map of keys and values"},
        BadInput{"entries: 5", "file.yaml:1:10: entries = 5 must be a list"},
        BadInput{"entries: [5]", "file.yaml:1:11: entries[0] = 5 must be a map of keys and values"},
        BadInput{"entries: [{angle: 1}]", "file.yaml:1:11: entries[0].place is missing"},
        BadInput{"entries: [{place: [1, 2, 3]}]",
                 "file.yaml:1:19: entries[0].place = [1, 2, 3] must be a pair [x, y] in m"},
        BadInput{"entries: [{place: 5}]", "file.yaml:1:19: entries[0].place = 5 must be a pair [x, y] in m"},
        BadInput{"entries: [{place: [1, x]}]",
                 "file.yaml:1:23: entries[0].place[1] = x must be a number in m"},
        BadInput{"entries: [{place: [1, 101]}]",
                 "file.yaml:1:23: entries[0].place[1] = 101 must lie in [-100, 100] m"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, YamlReaderBadInput,
    testing::Values(
        BadInput{"cuont: 5", "file.yaml:1:1: cuont = 5 is not a known key; did you mean count?"},
        BadInput{"length: 5", "file.yaml:1:1: length = 5 is not a known key; did you mean inner.length?"},
        BadInput{"banana: 5", "file.yaml:1:1: banana = 5 is not a known key"},
        BadInput{"inner:\n  lenght: 5",
                 "file.yaml:2:3: inner.lenght = 5 is not a known key; did you mean inner.length?"},
        BadInput{"? [a, b]\n: 5", "file.yaml:1:3: a key must be a plain name, not [a, b]"},
        BadInput{"inner: {reach: 1,5}", "file.yaml:1:18: inner.5 = nothing is not a known key"},
        BadInput{"inner.length: 5", "file.yaml:1:1: inner.length = 5 is not a known key"},
        BadInput{"name: x\nname: y", "file.yaml:2:1: key name stands twice (first in line 1)"},
        BadInput{"inner: {on: true, on: false}", "file.yaml:1:19: key on stands twice (first in line 1)"}));

INSTANTIATE_TEST_SUITE_P(
    Documents, YamlReaderBadInput,
    testing::Values(
        BadInput{"", "file.yaml: is empty: must be a map of keys and values"},
        BadInput{"# nothing\n", "file.yaml: is empty: must be a map of keys and values"},
        BadInput{"5", "file.yaml:1:1: must be a map of keys and values, not 5"},
        BadInput{"[1, 2]", "file.yaml:1:1: must be a map of keys and values, not [1, 2]"},
        BadInput{"a: &x 5\nb: *x",
                 "file.yaml:1:1: a = 5 is not a known key\n"
                 "file.yaml:1:4: anchors (&name) are not supported\n"
                 "file.yaml:2:1: b = nothing is not a known key\n"
                 "file.yaml:2:4: aliases (*name) are not supported: write the value out"},
        BadInput{"name: !!str 5", "file.yaml:1:7: tags (tag:yaml.org,2002:str) are not supported"},
        BadInput{"name: a\n---\nname: b", "file.yaml:3:1: must hold one YAML document, not several"},
        BadInput{"name: \xFF\xFE", "file.yaml:1:7: byte 0xff is not UTF-8 text"},
        BadInput{"name: a\nb: \xC3", "file.yaml:2:4: byte 0xc3 is not UTF-8 text"},
        BadInput{"name: \x01", "file.yaml:1:7: byte 0x1 is not UTF-8 text"}));

TEST(YamlReader, ReportsAllProblemsAtOnce) {
  const Read result =
      read("count: 0\nflavour: bitter\ninner: {on: maybe, lenght: 3}\nentries: [{}, {place: 1}]\n");
  EXPECT_EQ(result.problems.kept().size(), 6u) << result.problems.to_text();
}

TEST(YamlReader, RefusesBrokenSyntaxWithItsLine) {
  for (const char* text :
       {"a: [1, 2", "a: b: c", "a: 1\n b: 2", "\"", "{", "a: *nowhere", "- a\nb: 1", "a: '", "%YAML 9\n---\n",
        "key: |\n x\n\ty", "a: {b", "[[[[", "!", "&", "? ", "@x: 1", "`"}) {
    SCOPED_TRACE(text);
    const Read result = read(text);
    ASSERT_FALSE(result.problems.empty());
    EXPECT_EQ(result.problems.kept().front().location.source, "file.yaml");
  }
}

TEST(YamlReader, RefusesWhatIsTooDeepTooLongOrTooLarge) {
  const auto report = [](const std::string& text) { return read(text).problems.to_text(); };
  EXPECT_NE(report("a: " + std::string(100000, '[')).find("deeper than"), std::string::npos);
  EXPECT_NE(report("a: " + std::string(100000, '{')).find("deeper than"), std::string::npos);
  std::string lines;
  for (int i = 0; i < 500; ++i) lines += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_NE(report(lines).find("deeper than"), std::string::npos);
  EXPECT_NE(report("a: " + std::string(5u << 20, 'x')).find("larger than"), std::string::npos);
  InputProblems problems;
  YamlLimits limits;
  limits.nodes = 10;
  static_cast<void>(parse_yaml("[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]", "file.yaml", problems, limits));
  EXPECT_NE(problems.to_text().find("more than 10 values"), std::string::npos);
}

// Each level doubles the last one: expanded it would have 2^40 values.
TEST(YamlReader, DoesNotExpandAnchorBombs) {
  std::string text = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string last = std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [*a" + last + ", *a" + last + "]\n";
  }
  const Read result = read(text);
  EXPECT_NE(result.problems.to_text().find("aliases"), std::string::npos);
}

TEST(YamlReader, KeepsItsReportShort) {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += "key" + std::to_string(i) + ": 1\n";
  const Read result = read(text);
  EXPECT_EQ(result.problems.kept().size(), InputProblems::kMostProblems);
  EXPECT_EQ(result.problems.left_out(), 20000 - InputProblems::kMostProblems);
}

TEST(YamlReader, RefusesWhatIsNoFile) {
  const std::filesystem::path folder = std::filesystem::path{testing::TempDir()} / "spf_yaml_reader_test";
  std::filesystem::create_directories(folder);
  const auto report = [](const std::string& path) {
    InputProblems problems;
    static_cast<void>(read_yaml_file(path, problems));
    return problems.to_text();
  };
  const std::string missing = (folder / "missing.yaml").string();
  EXPECT_EQ(report(missing), missing + ": no such file");
  EXPECT_EQ(report(missing + "/below"), missing + "/below: no such file");
  EXPECT_EQ(report(folder.string()), folder.string() + ": is a directory, not a file");
  EXPECT_EQ(report("/dev/null"), "/dev/null: is not a regular file");
  EXPECT_EQ(report(""), ": no such file");
  const std::string good = (folder / "good.yaml").string();
  std::ofstream{good} << "count: 3\n";
  EXPECT_EQ(report(good), "");
}

TEST(Settings, GoThroughTheSameChecks) {
  const Read good =
      read("inner: {length: 1}\nentries: [{place: [0, 0]}]",
           {"inner.length=3", "inner.on=false", "count=9", "entries[0].place=[4, 5]", "other.length=2"});
  ASSERT_EQ(good.problems.to_text(), "");
  EXPECT_EQ(good.outer.inner.length, 3.0);
  EXPECT_FALSE(good.outer.inner.on);
  EXPECT_EQ(good.outer.count, 9);
  EXPECT_EQ(good.outer.entries[0].place.y(), 5.0);
  EXPECT_EQ(good.outer.other->length, 2.0);

  struct BadSetting {
    const char* setting;
    const char* expected;
  };
  for (const auto& [setting, expected] :
       {BadSetting{"count=0", "--set: count = 0 must lie in [1, 100]"},
        BadSetting{"inner.lenght=1",
                   "--set: inner.lenght = 1 is not a known key; did you mean inner.length?"},
        BadSetting{"count", "--set: 'count' must read key=value or group.key=value"},
        BadSetting{"=5", "--set: '=5' must read key=value or group.key=value"},
        BadSetting{"inner..length=5", "--set: 'inner..length=5' must read key=value or group.key=value"},
        BadSetting{"count=", "--set: count needs a value"},
        BadSetting{"count=[1", "--set: count: is not YAML: end of sequence flow not found"},
        BadSetting{"name.x=1", "--set: name.x: a has no key x"},
        BadSetting{"entries[3].place=[1, 2]",
                   "--set: entries[3].place: there is no entry [3]; the list has 1"}}) {
    const Read bad = read("name: a\nentries: [{place: [0, 0]}]", {setting});
    EXPECT_EQ(bad.problems.to_text(), expected) << setting;
  }
}

TEST(Settings, MergeMapsAndLetTheLastOneWin) {
  const Read result = read("inner: {length: 1, on: false}", {"inner={length: 2}", "count=4", "count=5"});
  ASSERT_EQ(result.problems.to_text(), "");
  EXPECT_EQ(result.outer.inner.length, 2.0);
  EXPECT_FALSE(result.outer.inner.on);
  EXPECT_EQ(result.outer.count, 5);
}

TEST(YamlWriter, WritesWhatTheReaderReadsBack) {
  Outer outer;
  outer.count = 42;
  outer.seed = 18446744073709551615u;
  outer.flavour = Flavour::sour;
  outer.name = "quotes \" and \\ and\nlines: #";
  outer.inner.length = 0.1 + 0.2;  // needs all 17 digits
  outer.other.emplace().on = false;
  outer.entries.resize(2);
  outer.entries[1].place = {1.0 / 3.0, -1e-5};
  outer.entries[1].angle = 2.5;
  const std::string text = to_yaml(outer);
  const Read result = read(text);
  ASSERT_EQ(result.problems.to_text(), "") << text;
  EXPECT_EQ(to_yaml(result.outer), text);
  EXPECT_EQ(result.outer.inner.length, outer.inner.length);
  EXPECT_EQ(result.outer.name, outer.name);
  EXPECT_EQ(result.outer.entries[1].place, outer.entries[1].place);
}

TEST(ParameterRows, ListEveryField) {
  const std::vector<ParameterRow> rows = parameter_rows(Outer{});
  ASSERT_EQ(rows.size(), 14u);
  EXPECT_EQ(rows[0].key, "count");
  EXPECT_EQ(rows[0].value, "3");
  EXPECT_EQ(rows[0].range, "[1, 100]");
  EXPECT_EQ(rows[2].range, "sweet, sour");
  EXPECT_EQ(rows[5].key, "inner.reach");
  EXPECT_EQ(rows[5].range, ">= 0");
  EXPECT_EQ(rows[5].unit, "m");
  EXPECT_EQ(rows.back().key, "entries[].angle");
}

// Random bytes and random mutations of a good file: whatever comes, the answer is a report or a value.
TEST(YamlReader, SurvivesArbitraryInput) {
  const std::string good =
      "count: 7\nname: \"a\"\ninner: {length: 1.5, on: false}\nentries:\n  - place: [1, -2.5]\n  - {place: "
      "[0, 0]}\n";
  std::uint64_t state = 17;
  const auto draw = [&state](std::size_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  const std::string alphabet = "{}[]:,-?&*!|>'\"%@`# \n\tab01.";
  for (int i = 0; i < 20000; ++i) {
    std::string text = i % 2 == 0 ? good : std::string(draw(60), 'a');
    const std::size_t edits = i % 2 == 0 ? 1 + draw(4) : text.size();
    for (std::size_t k = 0; k < edits && !text.empty(); ++k)
      text[i % 2 == 0 ? draw(text.size()) : k] = alphabet[draw(alphabet.size())];
    const Read result = read(text, {"count=5"});
    EXPECT_GE(result.outer.count, 1) << text;
  }
}

}  // namespace
}  // namespace spf

#include "spf/math/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace spf {

enum class Colour { red, green };

template <>
struct EnumNames<Colour> {
  static constexpr std::array<std::pair<Colour, const char*>, 2> values{
      {{Colour::red, "red"}, {Colour::green, "green"}}};
};

namespace {

struct InnerParameters {
  double gain = 1.0;
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("gain", self.gain, "m/s", Range{0.0, 2.0}, "a gain");
  }
};

struct OuterParameters {
  int count = 3;
  bool active = true;
  Colour colour = Colour::green;
  InnerParameters inner;
  double length = 0.5;
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("count", self.count, "1", Range{1, 5}, "a count");
    visit("active", self.active, "a switch");
    visit("colour", self.colour, "a choice");
    visit.group("inner", self.inner);
    visit("length", self.length, "m", Range{0.1, 10.0}, "a length");
  }
};

TEST(Parameters, DefaultsHaveNoProblem) {
  EXPECT_TRUE(problems(OuterParameters{}).empty());
  EXPECT_EQ(validated(OuterParameters{}).count, 3);
}

TEST(Parameters, NamesEveryProblemWithValueUnitAndLimit) {
  OuterParameters parameters;
  parameters.count = 9;
  parameters.inner.gain = -0.5;
  parameters.length = std::nan("");
  EXPECT_THAT(problems(parameters), testing::ElementsAre("count = 9 [1] must lie in [1, 5]",
                                                         "inner.gain = -0.5 [m/s] must lie in [0, 2]",
                                                         "length = nan [m] must lie in [0.1, 10]"));
}

TEST(Parameters, RefusesWithAllReasonsAtOnce) {
  OuterParameters parameters;
  parameters.count = 0;
  parameters.inner.gain = 3.0;
  try {
    static_cast<void>(validated(parameters));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(), "count = 0 [1] must lie in [1, 5]; inner.gain = 3 [m/s] must lie in [0, 2]");
  }
}

TEST(Parameters, RangeIncludesItsEndsAndRefusesNaN) {
  const Range range{-1.0, 2.0};
  EXPECT_TRUE(range.contains(-1.0));
  EXPECT_TRUE(range.contains(2.0));
  EXPECT_FALSE(range.contains(std::nextafter(2.0, 3.0)));
  EXPECT_FALSE(range.contains(std::nan("")));
  EXPECT_FALSE(range.contains(std::numeric_limits<double>::infinity()));
}

TEST(Parameters, OneListAlsoWritesFields) {
  struct Doubler {
    void operator()(const char*, double& value, const char*, Range, const char*) { value *= 2.0; }
    void operator()(const char*, int& value, const char*, Range, const char*) { value *= 2; }
    void operator()(const char*, bool& value, const char*) { value = !value; }
    void operator()(const char*, Colour& value, const char*) { value = Colour::red; }
    void group(const char*, InnerParameters& nested) { InnerParameters::visit_fields(nested, *this); }
  };
  OuterParameters parameters;
  OuterParameters::visit_fields(parameters, Doubler{});
  EXPECT_EQ(parameters.count, 6);
  EXPECT_EQ(parameters.inner.gain, 2.0);
  EXPECT_EQ(parameters.length, 1.0);
  EXPECT_FALSE(parameters.active);
  EXPECT_EQ(parameters.colour, Colour::red);
}

TEST(Parameters, NamesEnumerators) {
  EXPECT_STREQ(enum_name(Colour::green), "green");
  EXPECT_STREQ(enum_name(static_cast<Colour>(7)), "?");
}

}  // namespace
}  // namespace spf

// The table of methods: each of the paper's differs from the paper's by what it names, and
// nothing else.
#include "spf/team/method_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>

namespace spf {
namespace {

const MethodTable kMethods;

/// Every field by its full name, as text that shows every bit.
class FieldLister {
 public:
  template <class Number>
  void operator()(const char* name, const Number& value, const char* /*unit*/, Range /*range*/,
                  const char* /*what*/) {
    std::ostringstream text;
    text << std::hexfloat << value;
    fields_[prefix_ + name] = text.str();
  }
  void operator()(const char* name, const bool& value, const char* /*what*/) {
    fields_[prefix_ + name] = value ? "true" : "false";
  }
  template <class Choice>
  void operator()(const char* name, const Choice& value, const char* /*what*/) {
    fields_[prefix_ + name] = enum_name(value);
  }
  void values(const char* name, const std::vector<Eigen::Vector2d>& points, const char* /*unit*/,
              Range /*range*/, const char* /*what*/) {
    std::ostringstream text;
    for (const Eigen::Vector2d& point : points) text << std::hexfloat << point.x() << " " << point.y() << ";";
    fields_[prefix_ + name] = text.str();
  }
  template <class Parameters>
  void group(const char* name, const Parameters& nested) {
    const std::string outer = prefix_;
    prefix_ += std::string{name} + ".";
    Parameters::visit_fields(nested, *this);
    prefix_ = outer;
  }
  [[nodiscard]] const std::map<std::string, std::string>& fields() const { return fields_; }

 private:
  std::string prefix_;
  std::map<std::string, std::string> fields_;
};

std::map<std::string, std::string> fields_of(const AgentParameters& parameters) {
  FieldLister lister;
  AgentParameters::visit_fields(parameters, lister);
  return lister.fields();
}

std::set<std::string> differing(const AgentParameters& a, const AgentParameters& b) {
  const std::map<std::string, std::string> fields_a = fields_of(a);
  const std::map<std::string, std::string> fields_b = fields_of(b);
  std::set<std::string> keys;
  for (const auto& [key, value] : fields_a)
    if (fields_b.at(key) != value) keys.insert(key);
  return keys;
}

std::set<std::string> change_from_the_paper(const char* method) {
  return differing(with_method(AgentParameters{}, "spf_empc"), with_method(AgentParameters{}, method));
}

TEST(WithMethod, DiffersFromThePaperByWhatItNamesOnly) {
  using Keys = std::set<std::string>;
  EXPECT_EQ(change_from_the_paper("es2"), Keys{"planner.dynamic_model"});
  EXPECT_EQ(change_from_the_paper("es2_constant_velocity"), Keys{"planner.dynamic_model"});
  EXPECT_EQ(change_from_the_paper("spf_empc_without_field"), Keys{"field.directional"});
  EXPECT_EQ(change_from_the_paper("spf_empc_without_self_sampling"), Keys{"tracker.reference.self_sampling"});
  EXPECT_EQ(change_from_the_paper("spf_empc_without_observer"), Keys{"tracker.observer.kind"});
}

TEST(WithMethod, NamesTheRightValues) {
  const AgentParameters any;
  EXPECT_EQ(with_method(any, "spf_empc").planner.dynamic_model, DynamicModel::probability_field);
  EXPECT_EQ(with_method(any, "spf_empc").tracker.observer.kind, ObserverKind::eso);
  EXPECT_TRUE(with_method(any, "spf_empc").tracker.reference.self_sampling);
  EXPECT_TRUE(with_method(any, "spf_empc").field.directional);
  EXPECT_EQ(with_method(any, "es2").planner.dynamic_model, DynamicModel::frozen);
  EXPECT_EQ(with_method(any, "es2_constant_velocity").planner.dynamic_model, DynamicModel::constant_velocity);
  EXPECT_FALSE(with_method(any, "spf_empc_without_field").field.directional);
  EXPECT_FALSE(with_method(any, "spf_empc_without_self_sampling").tracker.reference.self_sampling);
  EXPECT_EQ(with_method(any, "spf_empc_without_observer").tracker.observer.kind, ObserverKind::none);
}

TEST(WithMethod, KeepsWhatTheMethodDoesNotName) {
  AgentParameters mine;
  mine.robot.radius = 0.21;
  mine.robot.max_speed = 0.7;
  mine.planner.safety_distance = 0.44;
  mine.field.attention = 0.3;
  mine.team.plan_period = 0.05;
  mine.space_time.margin = 0.17;
  mine.orca.time_horizon = 2.3;
  mine.tracker.mpc.horizon = 8;
  const std::set<std::string> own = differing(AgentParameters{}, mine);
  ASSERT_EQ(own.size(), 8U);
  for (const Method& method : kMethods.all()) {
    SCOPED_TRACE(method.name);
    EXPECT_EQ(differing(with_method(AgentParameters{}, method), with_method(mine, method)), own);
  }
}

TEST(WithMethod, OfThePapersPlannerForgetsTheOneBefore) {
  // A file may name one method and the command line another: the result must not depend on the way there.
  for (const Method& first : kMethods.all()) {
    for (const Method& second : kMethods.all()) {
      SCOPED_TRACE(first.name + " then " + second.name);
      const AgentParameters expected = with_method(AgentParameters{}, second);
      if (!second.change) continue;  // those name their planner only
      const AgentParameters detour = with_method(with_method(AgentParameters{}, first), second);
      EXPECT_THAT(differing(expected, detour), ::testing::IsEmpty());
    }
  }
}

TEST(AgentParameters, DefaultsAreInRangeForEveryMethod) {
  for (const Method& method : kMethods.all())
    EXPECT_THAT(problems(with_method(AgentParameters{}, method)), ::testing::IsEmpty()) << method.name;
}

/// Stands wherever it is.
class Stander final : public Planner {
 public:
  explicit Stander(const RobotParameters& robot) : robot_{robot} {}
  void plan(const PlanRequest& request, PlanResult& result) override {
    result.clear();
    stand_instead(request, robot_, PlanOutcome::unsafe, result);
  }

 private:
  RobotParameters robot_;
};

Method stander() {
  return {"stander", "stands",
          [](const AgentParameters& agent) { return std::make_unique<Stander>(agent.robot); }};
}

TEST(MethodTable, TakesAMethodFromElsewhereAndLeavesOtherTablesAlone) {
  MethodTable table;
  const std::size_t built_in = table.all().size();
  const MethodTable copy = table;
  table.add(stander());
  EXPECT_EQ(table.all().size(), built_in + 1);
  EXPECT_EQ(copy.all().size(), built_in);
  EXPECT_EQ(copy.find("stander"), nullptr);
  const AgentParameters agent = with_method(AgentParameters{}, table.at("stander"));
  EXPECT_NE(dynamic_cast<Stander*>(agent.make_planner(agent).get()), nullptr);
}

TEST(MethodTable, RefusesWhatIsNoMethod) {
  MethodTable table;
  table.add(stander());
  EXPECT_THROW(table.add(stander()), std::invalid_argument);  // taken
  EXPECT_THROW(table.add({"", "nameless", stander().make_planner}), std::invalid_argument);
  EXPECT_THROW(table.add({"empty", "makes nothing", nullptr}), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(table.at("no_such_method")), std::invalid_argument);
}

TEST(MethodTable, TheDefaultIsThatOfTheParameters) {
  const AgentParameters agent;
  EXPECT_EQ(typeid(*agent.make_planner(agent)),
            typeid(*MethodTable{}.at(kDefaultMethod).make_planner(agent)));
}

}  // namespace
}  // namespace spf

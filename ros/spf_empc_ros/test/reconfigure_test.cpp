// What clients of dynamic_reconfigure read about the fields.
#include <gtest/gtest.h>

#include <algorithm>

#include "spf_empc_ros/reconfigure_server.hpp"

namespace spf_empc_ros {
namespace {

template <class Parameters>
auto value_of(const Parameters& parameters, const std::string& name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const auto& parameter) { return parameter.name == name; });
  EXPECT_NE(found, parameters.end()) << name;
  return found->value;
}

TEST(Reconfigure, DescribesEveryFieldWithLimitsDefaultAndWords) {
  const std::vector<spf::RunTimeField> fields = run_time_fields(spf::read_robot_file(""));
  const dynamic_reconfigure::ConfigDescription description = description_of(fields);
  ASSERT_EQ(description.groups.size(), 1u);
  const auto& parameters = description.groups[0].parameters;
  ASSERT_EQ(parameters.size(), fields.size() + 1);  // and the pause
  for (std::size_t i = 0; i < fields.size(); ++i) {
    EXPECT_EQ(parameters[i].name, fields[i].name);
    EXPECT_NE(parameters[i].description, "");
    if (fields[i].choices.empty()) {
      EXPECT_EQ(parameters[i].type, "double");
      EXPECT_EQ(value_of(description.min.doubles, fields[i].name), fields[i].range.low);
      EXPECT_EQ(value_of(description.max.doubles, fields[i].name), fields[i].range.high);
      EXPECT_EQ(value_of(description.dflt.doubles, fields[i].name), std::get<double>(fields[i].value));
    } else {
      EXPECT_EQ(parameters[i].type, "str");
      EXPECT_EQ(value_of(description.dflt.strs, fields[i].name), std::get<std::string>(fields[i].value));
      for (const std::string& choice : fields[i].choices)
        EXPECT_NE(parameters[i].edit_method.find("'value': '" + choice + "'"), std::string::npos);
    }
  }
  EXPECT_EQ(parameters.back().name, "pause");
  EXPECT_FALSE(value_of(description.dflt.bools, "pause"));
}

}  // namespace
}  // namespace spf_empc_ros

#include "spf_empc_ros/reconfigure_server.hpp"

#include <stdexcept>
#include <utility>

namespace spf_empc_ros {
namespace {

using dynamic_reconfigure::Config;
using spf::RunTimeField;
using spf::RunTimeValue;

constexpr const char* kPause = "pause";

template <class Parameter, class Value>
Parameter named(const std::string& name, const Value& value) {
  Parameter parameter;
  parameter.name = name;
  parameter.value = value;
  return parameter;
}

void add(const std::string& name, const RunTimeValue& value, Config& config) {
  if (const double* number = std::get_if<double>(&value))
    config.doubles.push_back(named<dynamic_reconfigure::DoubleParameter>(name, *number));
  else
    config.strs.push_back(named<dynamic_reconfigure::StrParameter>(name, std::get<std::string>(value)));
}

void add_pause(bool paused, Config& config) {
  config.bools.push_back(named<dynamic_reconfigure::BoolParameter>(kPause, paused));
}

/// Clients expect the group that holds all parameters.
void add_group(Config& config) {
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = true;
  config.groups.push_back(group);
}

dynamic_reconfigure::ParamDescription described(const std::string& name, const char* type,
                                                const std::string& what) {
  dynamic_reconfigure::ParamDescription parameter;
  parameter.name = name;
  parameter.type = type;
  parameter.description = what;
  return parameter;
}

/// The choices of an enumeration as clients read them: a literal of Python.
std::string edit_method(const RunTimeField& field) {
  std::string choices;
  for (const std::string& choice : field.choices)
    choices += std::string{choices.empty() ? "" : ", "} + "{'name': '" + choice +
               "', 'type': 'str', 'value': '" + choice +
               "', 'description': '', 'srcline': 0, 'srcfile': '', 'cconsttype': 'const char * const', "
               "'ctype': 'std::string'}";
  return "{'enum_description': '', 'enum': [" + choices + "]}";
}

}  // namespace

dynamic_reconfigure::ConfigDescription description_of(const std::vector<RunTimeField>& fields) {
  dynamic_reconfigure::ConfigDescription description;
  dynamic_reconfigure::Group group;
  group.name = "Default";
  for (const RunTimeField& field : fields) {
    const bool number = field.choices.empty();
    const std::string unit = number && field.unit != "1" ? " [" + field.unit + "]" : "";
    group.parameters.push_back(described(field.name, number ? "double" : "str", field.what + unit));
    if (!number) group.parameters.back().edit_method = edit_method(field);
    add(field.name, number ? RunTimeValue{field.range.low} : RunTimeValue{std::string{}}, description.min);
    add(field.name, number ? RunTimeValue{field.range.high} : RunTimeValue{std::string{}}, description.max);
    add(field.name, field.value, description.dflt);
  }
  group.parameters.push_back(
      described(kPause, "bool", "brakes and holds; goes on with the same goal after it"));
  add_pause(false, description.min);
  add_pause(true, description.max);
  add_pause(false, description.dflt);
  for (Config* config : {&description.min, &description.max, &description.dflt}) add_group(*config);
  description.groups.push_back(group);
  return description;
}

ReconfigureServer::ReconfigureServer(const ros::NodeHandle& own, const spf::RobotFile& file,
                                     ParameterStore& store, Apply apply, Refuse refuse)
    : own_{own},
      file_{file},
      fields_{run_time_fields(file)},
      store_{store},
      apply_{std::move(apply)},
      refuse_{std::move(refuse)} {
  descriptions_ = own_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  updates_ = own_.advertise<Config>("parameter_updates", 1, true);
  read_parameters();
  descriptions_.publish(description_of(fields_));
  service_ = own_.advertiseService("set_parameters", &ReconfigureServer::on_set, this);
}

void ReconfigureServer::read_parameters() {
  Config config;
  for (const RunTimeField& field : fields_) {
    double number = 0.0;
    std::string text;
    if (own_.getParam(field.name, number))
      add(field.name, number, config);
    else if (own_.getParam(field.name, text))
      add(field.name, text, config);
  }
  bool paused = false;
  if (own_.getParam(kPause, paused)) add_pause(paused, config);
  try {
    change(config);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument{"parameters of " + own_.getNamespace() + ": " + error.what()};
  }
}

bool ReconfigureServer::on_set(dynamic_reconfigure::Reconfigure::Request& request,
                               dynamic_reconfigure::Reconfigure::Response& response) {
  try {
    change(request.config);
  } catch (const std::invalid_argument& error) {
    refuse_("set_parameters", error.what());
    return false;
  }
  response.config = present();
  return true;
}

void ReconfigureServer::change(const Config& asked) {
  std::map<std::string, RunTimeValue> values = values_;
  for (const auto& number : asked.doubles) values[number.name] = number.value;
  for (const auto& number : asked.ints) values[number.name] = static_cast<double>(number.value);
  for (const auto& text : asked.strs) values[text.name] = text.value;
  bool paused = paused_;
  for (const auto& flag : asked.bools) {
    if (flag.name != kPause) throw std::invalid_argument{flag.name + " cannot be changed at run time"};
    paused = flag.value != 0;
  }
  apply_({with_run_time_values(file_, values), paused});
  for (const RunTimeField& field : fields_) {
    const auto value = values.find(field.name);
    if (value == values.end()) continue;
    if (value->second == field.value) {  // as in the file again, and in the one that a later process reads
      values.erase(value);
      store_.erase(field.name);
    } else if (const double* number = std::get_if<double>(&value->second)) {
      store_.set(field.name, *number);
    } else {
      store_.set(field.name, std::get<std::string>(value->second));
    }
  }
  if (paused != paused_) store_.set(kPause, paused);
  values_ = std::move(values);
  paused_ = paused;
  updates_.publish(present());
}

Config ReconfigureServer::present() const {
  Config config;
  for (const RunTimeField& field : fields_) {
    const auto changed = values_.find(field.name);
    add(field.name, changed == values_.end() ? field.value : changed->second, config);
  }
  add_pause(paused_, config);
  add_group(config);
  return config;
}

}  // namespace spf_empc_ros

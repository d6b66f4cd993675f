#include "ros2/node/arguments.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace ros2 {
namespace {

/// "NODE:NAME:=TEXT" in its parts; NODE may be missing.
struct Assignment {
  std::string node, name, text;
};

Assignment assignment_of(const std::string& option, const std::string& text) {
  const std::size_t at = text.find(":=");
  if (at == std::string::npos || at == 0)
    throw std::invalid_argument{option + " " + text + ": must be NAME:=VALUE or NODE:NAME:=VALUE"};
  Assignment result;
  result.name = text.substr(0, at);
  result.text = text.substr(at + 2);
  if (const std::size_t colon = result.name.find(':'); colon != std::string::npos) {
    result.node = result.name.substr(0, colon);
    result.name.erase(0, colon + 1);
  }
  if (result.name.empty()) throw std::invalid_argument{option + " " + text + ": has no name"};
  return result;
}

LogLevel log_level_of(const std::string& text) {
  std::string level = text.substr(text.find(":=") == std::string::npos ? 0 : text.find(":=") + 2);
  std::transform(level.begin(), level.end(), level.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  constexpr std::array<std::pair<const char*, LogLevel>, 5> kLevels{{{"debug", LogLevel::debug},
                                                                     {"info", LogLevel::info},
                                                                     {"warn", LogLevel::warn},
                                                                     {"error", LogLevel::error},
                                                                     {"fatal", LogLevel::fatal}}};
  for (const auto& [name, value] : kLevels)
    if (level == name) return value;
  throw std::invalid_argument{"--log-level " + text + ": must be one of debug, info, warn, error, fatal"};
}

bool is_log_switch(const std::string& option) {
  for (const char* what : {"rosout-logs", "stdout-logs", "external-lib-logs"})
    if (option == std::string{"--enable-"} + what || option == std::string{"--disable-"} + what) return true;
  return false;
}

/// One option of --ros-args with its value.
void take_option(Arguments& to, const std::string& option, const std::string& value) {
  if (option == "-r" || option == "--remap") {
    const Assignment rule = assignment_of(option, value);
    if (rule.text.empty()) throw std::invalid_argument{option + " " + value + ": has no new name"};
    to.remaps.push_back({rule.node, rule.name, rule.text});
  } else if (option == "-p" || option == "--param") {
    const Assignment rule = assignment_of(option, value);
    try {
      to.parameters.push_back(
          {rule.node.empty() ? "/**" : rule.node, rule.name, parse_parameter_value(rule.text)});
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument{option + " " + value + ": " + error.what()};
    }
  } else if (option == "--params-file") {
    for (ParameterRule& rule : read_parameter_file(value)) to.parameters.push_back(std::move(rule));
  } else if (option == "--log-level") {
    to.log_level = log_level_of(value);
  }
}

bool takes_value(const std::string& option) {
  for (const char* known : {"-r", "--remap", "-p", "--param", "--params-file", "--log-level", "-e",
                            "--enclave", "--log-config-file"})
    if (option == known) return true;
  return false;
}

}  // namespace

Arguments Arguments::parse(const std::vector<std::string>& arguments) {
  Arguments result;
  bool for_ros = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--ros-args") {
      for_ros = true;
    } else if (!for_ros) {
      result.others.push_back(argument);
    } else if (argument == "--") {
      for_ros = false;
    } else if (is_log_switch(argument)) {
      if (argument == "--disable-rosout-logs") result.rosout = false;
      if (argument == "--enable-rosout-logs") result.rosout = true;
    } else if (takes_value(argument)) {
      if (i + 1 == arguments.size()) throw std::invalid_argument{argument + " has no value"};
      take_option(result, argument, arguments[++i]);
    } else {
      throw std::invalid_argument{"unknown argument of --ros-args: " + argument};
    }
  }
  return result;
}

std::vector<std::pair<std::string, ParameterValue>> Arguments::parameters_for(const std::string& node) const {
  std::vector<std::pair<std::string, ParameterValue>> found;
  for (const ParameterRule& rule : parameters) {
    if (!matches(rule.node, node)) continue;
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const auto& other) { return other.first == rule.name; });
    if (same == found.end())
      found.emplace_back(rule.name, rule.value);
    else
      same->second = rule.value;
  }
  return found;
}

}  // namespace ros2

#include "ros2/node/names.hpp"

#include <algorithm>
#include <stdexcept>

namespace ros2 {
namespace {

constexpr std::size_t kLongestName = 255;  // what a discovery sample has room for

bool is_letter(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || letter == '_';
}

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// Of a name as it is written: absolute, private or relative.
std::string whole_name(const std::string& name, const NodeName& node) {
  if (name.empty()) return name;
  if (name.front() == '/') return name;
  if (name.front() == '~')
    return node.full() + (name.size() > 1 && name[1] != '/' ? "/" : "") + name.substr(1);
  return (node.ns == "/" ? "" : node.ns) + "/" + name;
}

bool is_for(const RemapRule& rule, const NodeName& node) {
  return rule.node.empty() || rule.node == node.name;
}

}  // namespace

std::string fault_of_node_name(const std::string& name) {
  if (name.empty()) return "is empty";
  if (name.size() > kLongestName) return "is longer than 255 characters";
  if (is_digit(name.front())) return "begins with a digit";
  const auto wrong = std::find_if_not(name.begin(), name.end(),
                                      [](char letter) { return is_letter(letter) || is_digit(letter); });
  if (wrong == name.end()) return {};
  return std::string{"has '"} + *wrong + "', which is no letter, digit or underscore";
}

std::string fault_of_full_name(const std::string& name) {
  if (name == "/") return {};
  if (name.empty() || name.front() != '/') return "does not begin with a slash";
  if (name.size() > kLongestName) return "is longer than 255 characters";
  for (std::size_t begin = 1; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string token = name.substr(begin, end - begin);
    if (token.empty()) return "has an empty part";
    if (std::string fault = fault_of_node_name(token); !fault.empty()) return fault;
    begin = end + 1;
  }
  return {};
}

std::string resolved(const std::string& name, const NodeName& node, const std::vector<RemapRule>& rules) {
  std::string whole = whole_name(name, node);
  for (const RemapRule& rule : rules) {
    if (!is_for(rule, node) || rule.from.rfind("__", 0) == 0 || whole_name(rule.from, node) != whole)
      continue;
    whole = whole_name(rule.to, node);
    break;
  }
  if (const std::string fault = fault_of_full_name(whole); !fault.empty() || whole == "/")
    throw std::invalid_argument{"the name '" + name + "' (" + whole + ") " +
                                (fault.empty() ? "is no topic" : fault)};
  return whole;
}

NodeName resolved_node(const NodeName& asked, const std::vector<RemapRule>& rules) {
  NodeName node = asked;
  const auto rule_of = [&](const char* what) {
    return std::find_if(rules.begin(), rules.end(),
                        [&](const RemapRule& rule) { return is_for(rule, asked) && rule.from == what; });
  };
  for (const char* word : {"__node", "__name"})
    if (const auto rule = rule_of(word); rule != rules.end()) node.name = rule->to;
  if (const auto rule = rule_of("__ns"); rule != rules.end()) node.ns = rule->to;
  if (const std::string fault = fault_of_node_name(node.name); !fault.empty())
    throw std::invalid_argument{"the node's name '" + node.name + "' " + fault};
  if (const std::string fault = fault_of_full_name(node.ns); !fault.empty())
    throw std::invalid_argument{"the node's namespace '" + node.ns + "' " + fault};
  return node;
}

std::string dds_type_name(const std::string& package, const std::string& kind, const std::string& name) {
  return package + "::" + kind + "::dds_::" + name + "_";
}

std::optional<std::string> user_data_value(const std::string& user_data, const std::string& key) {
  for (std::size_t begin = 0; begin < user_data.size();) {
    const std::size_t end = std::min(user_data.find(';', begin), user_data.size());
    const std::string item = user_data.substr(begin, end - begin);
    if (item.rfind(key + "=", 0) == 0) return item.substr(key.size() + 1);
    begin = end + 1;
  }
  return std::nullopt;
}

}  // namespace ros2

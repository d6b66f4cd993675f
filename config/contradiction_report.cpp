#include "config/contradiction_report.hpp"

#include <string_view>

namespace spf {
namespace {

/// The value at a path of keys; null when the document does not set it.
const YamlNode* node_at(const YamlNode& root, std::string_view path) {
  const YamlNode* node = &root;
  while (node != nullptr && !path.empty()) {
    const std::size_t dot = path.find('.');
    node = node->find(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  }
  return node;
}

/// Where either of the two settings is written; one that is not has its default.
const SourceLocation& location_of(const YamlNode& root, const host::Contradiction& contradiction) {
  for (const std::string& key : {contradiction.key, contradiction.other})
    if (const YamlNode* node = node_at(root, key)) return node->location;
  return root.location;
}

}  // namespace

void report_contradictions(const YamlNode& root, const std::vector<host::Contradiction>& found,
                           InputProblems& problems, std::vector<InputProblem>& warnings) {
  for (const host::Contradiction& contradiction : found) {
    const SourceLocation& location = location_of(root, contradiction);
    if (contradiction.severity == host::Severity::error)
      problems.add(location, to_text(contradiction), contradiction.key);
    else
      warnings.push_back({location, to_text(contradiction), contradiction.key});
  }
}

std::string warning_text(const InputProblem& warning) {
  return to_string(warning.location) + ": warning: " + warning.sentence;
}

}  // namespace spf

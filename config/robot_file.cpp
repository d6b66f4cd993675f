#include "config/robot_file.hpp"

#include "config/yaml_reader.hpp"
#include "config/yaml_writer.hpp"

namespace spf {
namespace {

RobotFile read_document(const YamlNode& root, InputProblems problems) {
  if (root.kind == YamlKind::nothing) problems.throw_if_any();  // there is no document to say more about
  RobotFile file;
  InputProblems ignored;
  if (const YamlNode* method = root.find("method")) read_choice({*method, "method", ignored}, file.method);
  file.agent = with_method(file.agent, file.method);
  read_parameters(root, file, problems);
  problems.throw_if_any();
  return file;
}

}  // namespace

RobotFile read_robot_file(const std::string& path) {
  if (path.empty()) {
    RobotFile file;
    file.agent = with_method(file.agent, file.method);
    return file;
  }
  InputProblems problems;
  const YamlNode root = read_yaml_file(path, problems);
  return read_document(root, std::move(problems));
}

RobotFile robot_file_from_text(const std::string& text, const std::string& name) {
  InputProblems problems;
  const YamlNode root = parse_yaml(text, name, problems);
  return read_document(root, std::move(problems));
}

std::string to_yaml_text(const RobotFile& file, bool explains) {
  return to_yaml(file, explains);
}

AgentParameters agent_parameters(const RobotFile& file) {
  AgentParameters parameters = file.agent;
  parameters.robot = file.robot;
  return parameters;
}

}  // namespace spf

#include "config/robot_file.hpp"

#include "config/yaml_reader.hpp"
#include "config/yaml_writer.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf {
namespace {

RobotFile read_document(const YamlNode& root, const MethodTable& methods, InputProblems problems) {
  if (root.kind == YamlKind::nothing) problems.throw_if_any();  // there is no document to say more about
  MethodChoice method{kDefaultMethod, methods};
  RobotParameters robot;
  InputProblems ignored;  // the whole is read again below
  if (const YamlNode* node = root.find("method")) read_choice({*node, "method", ignored}, method);
  if (const YamlNode* node = root.find("robot")) read_parameters(*node, robot, ignored);
  RobotFile file = default_robot_file(method, robot);
  read_parameters(root, file, problems);
  problems.throw_if_any();
  return file;
}

}  // namespace

RobotFile default_robot_file(const MethodChoice& method, const RobotParameters& robot) {
  RobotFile file;
  file.method = method;
  file.robot = robot;
  file.agent = with_method(defaults_for(robot), method.method());
  file.host = scaled(file.host, RobotScale{robot});
  return file;
}

RobotFile read_robot_file(const std::string& path, const MethodTable& methods) {
  if (path.empty()) return default_robot_file({kDefaultMethod, methods}, {});
  InputProblems problems;
  const YamlNode root = read_yaml_file(path, problems);
  return read_document(root, methods, std::move(problems));
}

RobotFile robot_file_from_text(const std::string& text, const std::string& name, const MethodTable& methods) {
  InputProblems problems;
  const YamlNode root = parse_yaml(text, name, problems);
  return read_document(root, methods, std::move(problems));
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

#include "config/robot_file.hpp"

#include <utility>

#include "config/contradiction_report.hpp"
#include "config/footprint_reader.hpp"
#include "config/removed_keys.hpp"
#include "config/renamed_keys.hpp"
#include "config/yaml_reader.hpp"
#include "config/yaml_writer.hpp"
#include "spf/robot/robot_scale.hpp"

namespace spf {
namespace {

RobotFile read_document(YamlNode root, const MethodTable& methods, InputProblems problems) {
  if (root.kind == YamlKind::nothing) problems.throw_if_any();  // there is no document to check further
  if (!require_map(root, problems)) problems.throw_if_any();
  rename_old_keys(root, OldKey::conflicts, problems);
  refuse_removed_keys(root, problems);
  RobotFile head;
  head.method = MethodChoice{kDefaultMethod, methods};
  const std::vector<std::string> keys = keys_of(head);
  FieldReader reader{root, "", keys, problems};
  RobotFile::visit_head(head, reader);
  settle_footprint(root.find("robot"), "robot", head.robot, problems);
  RobotFile file = default_robot_file(head.method, head.robot);
  RobotFile::visit_parameters(file, reader);
  reader.finish();
  // A refused value has been replaced by a default, which contradicts nothing that was meant.
  if (problems.empty())
    report_contradictions(root, host::contradictions(agent_parameters(file), file.host), problems,
                          file.warnings);
  problems.throw_if_any();
  return file;
}

}  // namespace

RobotFile default_robot_file(const MethodChoice& method, const RobotParameters& robot) {
  RobotFile file;
  file.method = method;
  file.robot = robot;
  file.agent = with_method(defaults_for(robot), method.method());
  file.agent.perception.enabled = true;
  file.host = scaled(file.host, RobotScale{robot});
  return file;
}

RobotFile read_robot_file(const std::string& path, const MethodTable& methods) {
  if (path.empty()) return default_robot_file({kDefaultMethod, methods}, {});
  InputProblems problems;
  YamlNode root = read_yaml_file(path, problems);
  return read_document(std::move(root), methods, std::move(problems));
}

RobotFile robot_file_from_text(const std::string& text, const std::string& name, const MethodTable& methods) {
  InputProblems problems;
  YamlNode root = parse_yaml(text, name, problems);
  return read_document(std::move(root), methods, std::move(problems));
}

std::string to_yaml_text(const RobotFile& file, bool explains) {
  return to_yaml(file, explains);
}

AgentParameters agent_parameters(const RobotFile& file) {
  AgentParameters parameters = file.agent;
  parameters.robot = file.robot;
  if (parameters.perception.enabled) {
    parameters.perception.map_scans = true;
    parameters.perception.moving_alone = file.host.relies_on_obstacles;
  }
  return parameters;
}

}  // namespace spf

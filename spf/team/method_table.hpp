// The table of methods: everything that a robot's `method` can be. A method is an entry: its name, what it
// changes in the agent's parameters, and the planner that it makes. The paper's method, its baselines and
// ablations, our own and a reactive yardstick are built in; whoever hosts agents may add more
// (docs/add_a_method.md).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "spf/team/agent_parameters.hpp"

namespace spf {

struct Method {
  std::string name;                                   ///< as files and command lines write it
  std::string what;                                   ///< one line about it
  PlannerFactory make_planner;                        ///< required
  std::function<void(AgentParameters&)> change = {};  ///< what it sets besides the planner; may be empty
};

/// A value: copies are cheap, and adding to one changes no other.
class MethodTable {
 public:
  /// The methods that are built in.
  MethodTable();

  /// Throws std::invalid_argument when the name is empty or taken, or the factory is missing.
  void add(Method method);

  [[nodiscard]] const std::vector<Method>& all() const& { return *methods_; }
  const std::vector<Method>& all() const&& = delete;  // it would not outlive the table
  /// Null when there is none of this name.
  [[nodiscard]] const Method* find(std::string_view name) const;
  /// Throws std::invalid_argument with all names when there is none of this name.
  [[nodiscard]] const Method& at(std::string_view name) const;

 private:
  std::shared_ptr<const std::vector<Method>> methods_;
};

/// The method of those who name none.
inline constexpr const char* kDefaultMethod = "space_time";

/// The same robot with another method: changes only what the method names.
[[nodiscard]] AgentParameters with_method(AgentParameters parameters, const Method& method);
/// Likewise with a method that is built in. Throws std::invalid_argument on any other name.
[[nodiscard]] AgentParameters with_method(AgentParameters parameters, std::string_view built_in);

}  // namespace spf

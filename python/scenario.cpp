#include "python/scenario.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "config/closest_name.hpp"
#include "config/parameter_table.hpp"
#include "config/yaml_reader.hpp"
#include "python/values.hpp"

namespace spf::python {
namespace {

std::string text_of_number(double value) {
  return to_text(value);
}

/// A text in quotation marks, unless it reads like a word or a number.
std::string text_of_word(const std::string& word) {
  return word.find_first_of(":#,[]{}\"'\n&*!|>%@`") == std::string::npos && !word.empty() ? word
                                                                                          : to_text(word);
}

std::string text_of_list(py::handle list) {
  std::string text;
  for (const py::handle item : list) text += (text.empty() ? "" : ", ") + value_text(item);
  return "[" + text + "]";
}

std::string text_of_map(const py::dict& map) {
  std::string text;
  for (const auto& [key, value] : map)
    text += (text.empty() ? "" : ", ") + std::string{py::str(key)} + ": " + value_text(value);
  return "{" + text + "}";
}

void add_settings(const std::string& prefix, const py::dict& map, std::vector<Setting>& settings) {
  for (const auto& [key, value] : map) {
    const std::string path = prefix + std::string{py::str(key)};
    if (py::isinstance<py::dict>(value))
      add_settings(path + ".", py::reinterpret_borrow<py::dict>(value), settings);
    else
      settings.push_back({path + "=" + value_text(value), "settings"});
  }
}

/// The values of a struct as a dict, its groups as dicts in it.
class ValueCollector {
 public:
  template <class Value, class... Rest>
  void operator()(const char* name, const Value& value, const Rest&...) {
    values_[name] = to_python(value);
  }
  template <class Nested>
  void group(const char* name, const Nested& nested) {
    values_[name] = values_of(nested);
  }
  template <class Nested>
  void optional_group(const char* name, const std::optional<Nested>& nested, const char*) {
    if (nested)
      values_[name] = values_of(*nested);
    else
      values_[name] = py::none();
  }
  template <class Entry>
  void list(const char* name, const std::vector<Entry>& entries, const char*) {
    py::list items;
    for (const Entry& entry : entries) items.append(values_of(entry));
    values_[name] = items;
  }
  template <class Value, class... Rest>
  void values(const char* name, const std::vector<Value>& values, const Rest&...) {
    py::list items;
    for (const Value& value : values) items.append(to_python(value));
    values_[name] = items;
  }
  void required(const char*) {}

  template <class Parameters>
  [[nodiscard]] static py::dict values_of(const Parameters& parameters) {
    ValueCollector collector;
    Parameters::visit_fields(parameters, collector);
    return collector.values_;
  }

 private:
  py::dict values_;
};

py::object value_at(const RunConfiguration& config, const std::string& key) {
  py::object value = ValueCollector::values_of(config);
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const py::str part{key.substr(begin, end - begin)};
    if (!py::isinstance<py::dict>(value) || !value.contains(part)) {
      const std::optional<std::string> meant = closest_name(key, keys_of(config));
      throw py::key_error(key + " is no key of this scenario" +
                          (meant ? "; did you mean " + *meant + "?" : ""));
    }
    value = py::object{value[part]};
    begin = end + 1;
  }
  return value;
}

py::list to_list(const std::vector<InputProblem>& problems) {
  py::list sentences;
  for (const InputProblem& problem : problems)
    sentences.append(to_string(problem.location) + ": " + problem.sentence);
  return sentences;
}

/// What there is to read of a scenario without a key.
void bind_names(py::class_<ScenarioFile>& type) {
  type.def_property_readonly("name", &ScenarioFile::name, "The file, as messages name it.")
      .def_property_readonly(
          "family", [](const ScenarioFile& self) { return to_text(self.config().family); },
          "Family of scenes.")
      .def_property_readonly(
          "method", [](const ScenarioFile& self) { return self.config().method.name(); },
          "How robots plan and track.")
      .def_property_readonly(
          "seed", [](const ScenarioFile& self) { return self.config().seed; }, "Seed of everything random.")
      .def_property_readonly(
          "warnings", [](const ScenarioFile& self) { return to_list(self.config().warnings); },
          "Settings that contradict each other and can be studied all the same, as sentences.")
      .def_property_readonly(
          "agent", [](const ScenarioFile& self) { return agent_parameters(self.config()); },
          "A copy of the parameters of every robot.")
      .def_property_readonly(
          "trial_count", [](const ScenarioFile& self) { return trial_count(self.config()); },
          "How many trials there are; None: as many as are asked for.")
      .def("__repr__", [](const ScenarioFile& self) {
        return "<spf.Scenario " + self.name() + ": family " + to_text(self.config().family) + ", method " +
               self.config().method.name() + ">";
      });
}

}  // namespace

std::string value_text(py::handle value) {
  if (value.is_none()) return "none";
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::str>(value)) return text_of_word(value.cast<std::string>());
  if (py::isinstance<py::int_>(value)) return py::str(value);
  if (py::isinstance<py::dict>(value)) return text_of_map(py::reinterpret_borrow<py::dict>(value));
  if (py::hasattr(value, "tolist")) return value_text(py::object{value.attr("tolist")()});  // numpy's
  if (py::isinstance<py::sequence>(value)) return text_of_list(value);
  if (PyFloat_Check(value.ptr())) return text_of_number(value.cast<double>());
  if (py::hasattr(value, "__fspath__")) return text_of_word(py::str(value.attr("__fspath__")()));
  refuse("settings", value, "must hold numbers, texts, lists and dicts");
}

std::vector<Setting> settings_from(const py::dict& settings) {
  std::vector<Setting> all;
  add_settings("", settings, all);
  return all;
}

ScenarioFile ScenarioFile::load(const std::string& path, const std::vector<Setting>& settings,
                                const MethodTable& methods) {
  ScenarioFile file;
  file.name_ = path;
  file.settings_ = settings;
  file.methods_ = methods;
  file.read();
  return file;
}

ScenarioFile ScenarioFile::from_text(const std::string& text, const std::string& name,
                                     const std::vector<Setting>& settings, const MethodTable& methods) {
  ScenarioFile file;
  file.name_ = name;
  file.text_ = text;
  file.is_text_ = true;
  file.settings_ = settings;
  file.methods_ = methods;
  file.read();
  return file;
}

ScenarioFile ScenarioFile::changed(const std::vector<Setting>& settings) const {
  ScenarioFile file{*this};
  file.settings_.insert(file.settings_.end(), settings.begin(), settings.end());
  file.read();
  return file;
}

void ScenarioFile::read() {
  config_ = std::make_shared<const RunConfiguration>(
      is_text_ ? run_configuration_from_text(text_, name_, settings_, methods_)
               : read_run_configuration(name_, settings_, methods_));
}

void bind_scenario(py::module_& module) {
  py::class_<ScenarioFile> type(module, "Scenario",
                                "A scenario file with its defaults: what determines every trial. Immutable.");
  type.def_static(
          "load",
          [](const py::object& path, const py::dict& settings, const MethodTable& methods) {
            return ScenarioFile::load(py::str(path), settings_from(settings), methods);
          },
          py::arg("path"), py::arg("settings") = py::dict(), py::arg("methods") = MethodTable{},
          "Reads a file and writes `settings` over it, as {\"noise.level\": 1}. `methods` are those that it\n"
          "may name. Raises InputError with every problem: file, line, key, value and limit.")
      .def_static(
          "from_text",
          [](const std::string& text, const py::dict& settings, const MethodTable& methods) {
            return ScenarioFile::from_text(text, "text", settings_from(settings), methods);
          },
          py::arg("text"), py::arg("settings") = py::dict(), py::arg("methods") = MethodTable{},
          "The same of the text of a file; paths in it start in the working directory.")
      .def_static(
          "from_dict",
          [](const py::dict& values, const MethodTable& methods) {
            return ScenarioFile::from_text(text_of_map(values), "dict", {}, methods);
          },
          py::arg("values"), py::arg("methods") = MethodTable{},
          "The same of keys and values, nested like the file; numpy arrays count as lists. What to_dict()\n"
          "gives, read back.")
      .def(
          "changed",
          [](const ScenarioFile& self, const py::dict& settings) {
            return self.changed(settings_from(settings));
          },
          py::arg("settings"), "The scenario with these settings, too. Defaults that depend on them follow.")
      .def(
          "__getitem__",
          [](const ScenarioFile& self, const std::string& key) { return value_at(self.config(), key); },
          py::arg("key"), "The value at a path of keys, as scenario[\"robot.max_speed\"].")
      .def(
          "to_dict", [](const ScenarioFile& self) { return ValueCollector::values_of(self.config()); },
          "Every key with its value, nested like the file.")
      .def(
          "to_yaml",
          [](const ScenarioFile& self, bool explains) { return to_yaml_text(self.config(), explains); },
          py::arg("explains") = false,
          "The text of a file with every key; with `explains` each has a comment.")
      .def(
          "parameters", [](const ScenarioFile& self) { return parameter_rows(self.config()); },
          "Every key with value, unit, limits and meaning.");
  bind_names(type);
}

}  // namespace spf::python

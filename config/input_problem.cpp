#include "config/input_problem.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace spf {

std::string to_string(const SourceLocation& location) {
  std::string text = location.source;
  if (location.line > 0) text += ":" + std::to_string(location.line);
  if (location.line > 0 && location.column > 0) text += ":" + std::to_string(location.column);
  return text;
}

namespace {

/// Whether the path `inner` is the path `outer` or lies below it.
bool lies_within(std::string_view inner, std::string_view outer) {
  if (inner.substr(0, outer.size()) != outer) return false;
  return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

}  // namespace

void InputProblems::add(const SourceLocation& location, std::string sentence, std::string key) {
  if (full())
    ++left_out_;
  else
    kept_.push_back({location, std::move(sentence), std::move(key)});
}

bool InputProblems::refuses(std::string_view key) const {
  return std::any_of(kept_.begin(), kept_.end(), [key](const InputProblem& problem) {
    return !problem.key.empty() && (lies_within(key, problem.key) || lies_within(problem.key, key));
  });
}

std::string InputProblems::to_text() const {
  std::vector<InputProblem> sorted = kept_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const InputProblem& a, const InputProblem& b) {
    return std::tie(a.location.source, a.location.line, a.location.column) <
           std::tie(b.location.source, b.location.line, b.location.column);
  });
  std::string text;
  for (const InputProblem& problem : sorted)
    text += (text.empty() ? "" : "\n") + to_string(problem.location) + ": " + problem.sentence;
  if (left_out_ > 0) text += "\n(and " + std::to_string(left_out_) + " more)";
  return text;
}

void InputProblems::throw_if_any() const {
  if (!empty()) throw InputError{*this};
}

namespace {
InputProblems one_problem(const SourceLocation& location, std::string sentence) {
  InputProblems problems;
  problems.add(location, std::move(sentence));
  return problems;
}
}  // namespace

InputError::InputError(const SourceLocation& location, std::string sentence)
    : InputError{one_problem(location, std::move(sentence))} {}

}  // namespace spf

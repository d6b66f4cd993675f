#include "config/input_problem.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace spf {

std::string to_string(const SourcePlace& place) {
  std::string text = place.source;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  if (place.line > 0 && place.column > 0) text += ":" + std::to_string(place.column);
  return text;
}

namespace {

/// Is the path `inner` the path `outer`, or a part of it?
bool lies_within(std::string_view inner, std::string_view outer) {
  if (inner.substr(0, outer.size()) != outer) return false;
  return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

}  // namespace

void InputProblems::add(const SourcePlace& place, std::string sentence, std::string key) {
  if (full())
    ++left_out_;
  else
    kept_.push_back({place, std::move(sentence), std::move(key)});
}

bool InputProblems::refuses(std::string_view key) const {
  return std::any_of(kept_.begin(), kept_.end(), [key](const InputProblem& problem) {
    return !problem.key.empty() && (lies_within(key, problem.key) || lies_within(problem.key, key));
  });
}

std::string InputProblems::to_text() const {
  std::vector<InputProblem> sorted = kept_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const InputProblem& a, const InputProblem& b) {
    return std::tie(a.place.source, a.place.line, a.place.column) <
           std::tie(b.place.source, b.place.line, b.place.column);
  });
  std::string text;
  for (const InputProblem& problem : sorted)
    text += (text.empty() ? "" : "\n") + to_string(problem.place) + ": " + problem.sentence;
  if (left_out_ > 0) text += "\n(and " + std::to_string(left_out_) + " more)";
  return text;
}

void InputProblems::throw_if_any() const {
  if (!empty()) throw InputError{*this};
}

namespace {
InputProblems one_problem(const SourcePlace& place, std::string sentence) {
  InputProblems problems;
  problems.add(place, std::move(sentence));
  return problems;
}
}  // namespace

InputError::InputError(const SourcePlace& place, std::string sentence)
    : InputError{one_problem(place, std::move(sentence))} {}

}  // namespace spf

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "config/utf8.hpp"
#include "config/yaml_tree.hpp"

namespace spf {
namespace {

/// Ends the parse at once; yaml-cpp passes exceptions of its handlers on.
struct DocumentRefused {
  SourceLocation location;
  std::string sentence;
};

/// Builds the tree from the parser's events. Nothing is expanded: an alias is an error, so a small file stays
/// small.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string source, const YamlLimits& limits, InputProblems& problems)
      : source_{std::move(source)}, limits_{limits}, problems_{problems} {}

  [[nodiscard]] YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    leaf(YamlKind::nothing, mark, "", anchor, "");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    problems_.add(location(mark), "aliases (*name) are not supported: write the value out");
    leaf(YamlKind::nothing, mark, "", 0, "");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    leaf(YamlKind::scalar, mark, tag, anchor, value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlKind::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlKind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or map that is being read.
  struct Level {
    YamlNode node;
    std::optional<std::pair<std::string, SourceLocation>> key;  ///< read, its value not yet
    bool skips_value = false;                                   ///< the key was refused, and so is its value
    std::map<std::string, int, std::less<>> lines;  ///< of the keys so far, to find duplicates fast
  };

  [[nodiscard]] SourceLocation location(const YAML::Mark& mark) const {
    return {source_, mark.line + 1, mark.column + 1};
  }

  YamlNode node(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (++nodes_ > limits_.nodes)
      throw DocumentRefused{location(mark), "holds more than " + std::to_string(limits_.nodes) + " values"};
    if (anchor != 0) problems_.add(location(mark), "anchors (&name) are not supported");
    if (!tag.empty() && tag != "?" && tag != "!")
      problems_.add(location(mark), "tags (" + tag + ") are not supported");
    YamlNode made;
    made.kind = kind;
    made.location = location(mark);
    made.quoted = tag == "!";
    return made;
  }
  void leaf(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            const std::string& text) {
    YamlNode made = node(kind, mark, tag, anchor);
    made.text = text;
    place_in_parent(std::move(made));
  }
  void open(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (levels_.size() >= limits_.depth)
      throw DocumentRefused{location(mark),
                            "is nested deeper than " + std::to_string(limits_.depth) + " levels"};
    levels_.push_back({node(kind, mark, tag, anchor), {}, false, {}});
  }
  void close() {
    YamlNode made = std::move(levels_.back().node);
    levels_.pop_back();
    place_in_parent(std::move(made));
  }

  void place_in_parent(YamlNode made) {
    if (levels_.empty()) {
      root_ = std::move(made);
      return;
    }
    Level& parent = levels_.back();
    if (parent.node.kind == YamlKind::list) {
      parent.node.items.push_back(std::move(made));
    } else if (std::exchange(parent.skips_value, false)) {
      return;
    } else if (parent.key) {
      parent.node.entries.push_back(
          {std::move(parent.key->first), std::move(parent.key->second), std::move(made)});
      parent.key.reset();
    } else {
      take_key(parent, std::move(made));
    }
  }
  void take_key(Level& parent, YamlNode made) {
    if (made.kind != YamlKind::scalar) {
      problems_.add(made.location, "a key must be a plain name, not " + shown(made));
      parent.skips_value = true;
    } else if (const auto [first, is_new] = parent.lines.emplace(made.text, made.location.line); !is_new) {
      problems_.add(made.location, "key " + shown(made) + " stands twice (first in line " +
                                       std::to_string(first->second) + ")");
      parent.skips_value = true;
    } else {
      parent.key.emplace(made.text, made.location);
    }
  }

  std::string source_;
  YamlLimits limits_;
  InputProblems& problems_;
  YamlNode root_;
  std::vector<Level> levels_;
  std::size_t nodes_ = 0;
};

SourceLocation location_of_byte(std::string_view text, std::size_t offset, const std::string& source) {
  SourceLocation location{source, 1, 1};
  for (std::size_t i = 0; i < offset; ++i) {
    if (text[i] == '\n') {
      ++location.line;
      location.column = 0;
    }
    ++location.column;
  }
  return location;
}

}  // namespace

YamlNode parse_yaml(std::string_view text, const std::string& source, InputProblems& problems,
                    const YamlLimits& limits) {
  const SourceLocation whole{source, 0, 0};
  YamlNode nothing;
  nothing.location = whole;
  if (text.size() > limits.bytes) {
    problems.add(whole, "is larger than " + std::to_string(limits.bytes >> 20) + " MiB");
    return nothing;
  }
  if (const std::optional<std::size_t> bad = first_bad_byte(text)) {
    std::ostringstream sentence;
    sentence << "byte 0x" << std::hex << static_cast<int>(static_cast<unsigned char>(text[*bad]))
             << " is not UTF-8 text";
    problems.add(location_of_byte(text, *bad, source), sentence.str());
    return nothing;
  }
  TreeBuilder builder{source, limits, problems};
  try {
    std::istringstream stream{std::string{text}};
    YAML::Parser parser{stream};
    if (!parser.HandleNextDocument(builder)) {
      problems.add(whole, "is empty: must be a map of keys and values");
      return nothing;
    }
    YamlNode root = builder.take();
    TreeBuilder second{source, limits, problems};
    if (parser.HandleNextDocument(second))
      problems.add(second.take().location, "must hold one YAML document, not several");
    return root;
  } catch (const DocumentRefused& refused) {
    problems.add(refused.location, refused.sentence);
  } catch (const YAML::Exception& error) {
    const bool known = error.mark.line >= 0;
    problems.add(known ? SourceLocation{source, error.mark.line + 1, error.mark.column + 1} : whole,
                 "is not YAML: " + error.msg);
  }
  return nothing;
}

}  // namespace spf

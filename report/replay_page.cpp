#include "report/replay_page.hpp"

#include <stdexcept>

#include "report/html_text.hpp"
#include "report/palette.hpp"
#include "report/replay_assets.hpp"
#include "report/replay_charts.hpp"
#include "report/replay_json.hpp"

namespace spf {
namespace {

/// Appends the template up to the mark and then the text, and moves the template behind the mark. The
/// inserted text is never searched, so no run can smuggle a mark in.
void append_at_mark(std::string& page, std::string_view& rest, std::string_view mark, std::string_view text) {
  const std::size_t found = rest.find(mark);
  if (found == std::string_view::npos)
    throw std::logic_error("replay page lacks the mark " + std::string{mark});
  page.append(rest.substr(0, found)).append(text);
  rest.remove_prefix(found + mark.size());
}

}  // namespace

std::string render_replay(const ReplayData& data) {
  std::string page;
  std::string_view rest = kReplayHtml;
  append_at_mark(page, rest, "@TITLE@", escape_html(data.title));
  append_at_mark(page, rest, "@STYLE@", palette_css() + std::string{kReplayStyle});
  append_at_mark(page, rest, "@CHARTS@", replay_charts(data));
  append_at_mark(page, rest, "@DATA@", replay_json(data));
  append_at_mark(page, rest, "@SCRIPT@", kReplayScript);
  return page.append(rest);
}

}  // namespace spf

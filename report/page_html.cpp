#include "report/page_html.hpp"

#include <algorithm>
#include <string_view>

#include "report/html_text.hpp"
#include "report/palette.hpp"

namespace spf {
namespace {

constexpr std::string_view kStyle = R"css(
*, *::before, *::after { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--page); color: var(--text);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif; font-variant-numeric: tabular-nums; }
h1, h2, h3 { line-height: 1.3; font-weight: 650; overflow-wrap: anywhere; }
h1 { font-size: 22px; margin: 0; } h2 { font-size: 18px; margin: 0 0 8px; } h3 { font-size: 15px; margin: 18px 0 6px; }
p { margin: 6px 0; max-width: 90ch; overflow-wrap: anywhere; }
a { color: var(--accent); }
.skip { position: absolute; left: 8px; top: -60px; padding: 8px 12px; background: var(--accent); color: var(--on-accent); border-radius: 6px; z-index: 5; }
.skip:focus { top: 8px; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
header { display: flex; flex-wrap: wrap; gap: 8px 20px; align-items: start; justify-content: space-between; padding: 14px 18px; background: var(--panel); border-bottom: 1px solid var(--line); }
header > div { min-width: 0; flex: 1; }
button { font: inherit; color: var(--text); background: var(--raised); border: 1px solid var(--control); border-radius: 6px; padding: 4px 12px; min-height: 36px; cursor: pointer; }
button:hover { border-color: var(--text); }
nav { padding: 8px 18px; } nav ul { display: flex; flex-wrap: wrap; gap: 4px 18px; list-style: none; margin: 0; padding: 0; }
nav a { display: inline-block; padding: 4px 0; }
main { display: grid; grid-template-columns: minmax(0, 1fr); gap: 14px; padding: 6px 14px 40px; max-width: 1500px; margin: 0 auto; }
section { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 14px 16px; min-width: 0; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 400px), 1fr)); gap: 16px; margin: 10px 0; align-items: start; }
.charts svg { display: block; width: 100%; max-width: 640px; height: auto; }
.frames { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 300px), 1fr)); gap: 10px; }
.frames svg { display: block; width: 100%; height: auto; border: 1px solid var(--line); }
.scroll { overflow-x: auto; margin: 8px 0; }
table { border-collapse: collapse; font-size: 14px; }
caption { text-align: left; font-weight: 650; padding: 4px 0; }
th, td { padding: 4px 10px; text-align: right; vertical-align: top; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { font-weight: 600; color: var(--muted); } tbody th { color: var(--text); }
thead th { border-bottom: 2px solid var(--control); vertical-align: bottom; }
th:first-child, td:first-child, .left { text-align: left; }
td.words { text-align: left; white-space: normal; min-width: 16em; overflow-wrap: anywhere; }
tbody tr:hover { background: var(--raised); }
.sub { display: block; color: var(--muted); font-size: 12.5px; }
td b { font-weight: 700; }
details { margin: 8px 0; border: 1px solid var(--line); border-radius: 6px; }
summary { padding: 7px 12px; cursor: pointer; overflow-wrap: anywhere; }
details[open] > summary { border-bottom: 1px solid var(--line); }
details > div { padding: 4px 12px 8px; }
code { font: 12.5px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; background: var(--raised); padding: 1px 4px; border-radius: 4px; overflow-wrap: anywhere; }
figure { margin: 0; min-width: 0; } figcaption { color: var(--muted); font-size: 12.5px; overflow-wrap: anywhere; }
.muted { color: var(--muted); }
@media (max-width: 560px) { header, nav { padding-left: 12px; padding-right: 12px; } main { padding: 6px 6px 30px; } section { padding: 10px; } th, td { padding: 4px 7px; } }
@media print { button, nav, .skip { display: none; } details { border: 0; } }
)css";

constexpr std::string_view kScript = R"js(
const button = document.getElementById("theme"), themes = ["auto", "light", "dark"];
let theme = 0;
button.addEventListener("click", () => {
  theme = (theme + 1) % themes.length;
  if (themes[theme] === "auto") document.documentElement.removeAttribute("data-theme");
  else document.documentElement.dataset.theme = themes[theme];
  button.textContent = "Theme: " + themes[theme];
});
)js";

/// Sentences, which read from the left.
bool is_words(const PageCell& cell) {
  return !cell.header && cell.text.size() + cell.html.size() > 40;
}

std::string cell_html(const PageCell& cell) {
  std::string inner = cell.html + escape_html(cell.text);
  if (cell.strong) inner = "<b>" + inner + "</b>";
  if (!cell.sub.empty()) inner += "<span class=\"sub\">" + escape_html(cell.sub) + "</span>";
  if (cell.header) return "<th scope=\"row\">" + inner + "</th>";
  return (is_words(cell) ? "<td class=\"words\">" : "<td>") + inner + "</td>";
}

}  // namespace

std::string html_table(const PageTable& table) {
  std::string html = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" +
                     escape_html(table.caption.empty() ? "table" : table.caption) + "\"><table>";
  if (!table.caption.empty()) html += "<caption>" + escape_html(table.caption) + "</caption>";
  html += "<thead><tr>";
  for (std::size_t i = 0; i < table.headers.size(); ++i) {
    const bool left = std::any_of(table.rows.begin(), table.rows.end(),
                                  [i](const auto& row) { return i < row.size() && is_words(row[i]); });
    html += (left ? "<th scope=\"col\" class=\"left\">" : "<th scope=\"col\">") +
            escape_html(table.headers[i]) + "</th>";
  }
  html += "</tr></thead>\n<tbody>";
  for (const std::vector<PageCell>& row : table.rows) {
    html += "<tr>";
    for (const PageCell& cell : row) html += cell_html(cell);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string html_details(const std::string& summary, const std::string& body) {
  return "<details><summary>" + escape_html(summary) + "</summary><div>" + body + "</div></details>\n";
}

std::string html_page(const std::string& title, const std::string& lead,
                      const std::vector<PageSection>& sections) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>" +
      escape_html(title) + "</title>\n<style>" + palette_css() + std::string{kStyle} +
      "</style>\n</head>\n<body>\n<a class=\"skip\" href=\"#main\">To the results</a>\n"
      "<header><div><h1>" +
      escape_html(title) + "</h1>" + lead +
      "</div><button id=\"theme\" type=\"button\">Theme: auto</button></header>\n"
      "<nav aria-label=\"Sections\"><ul>";
  for (const PageSection& section : sections)
    html += "<li><a href=\"#" + section.id + "\">" + escape_html(section.heading) + "</a></li>";
  html += "</ul></nav>\n<main id=\"main\">\n";
  for (const PageSection& section : sections)
    html += "<section id=\"" + section.id + "\"><h2>" + escape_html(section.heading) + "</h2>\n" +
            section.body + "</section>\n";
  return html + "</main>\n<script>" + std::string{kScript} + "</script>\n</body>\n</html>\n";
}

}  // namespace spf

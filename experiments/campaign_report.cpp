#include "experiments/campaign_report.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/failure_cause.hpp"
#include "experiments/report_charts.hpp"
#include "experiments/report_tables.hpp"
#include "report/chart_svg.hpp"
#include "report/html_text.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

bool shows(const CampaignParts& parts, CampaignFigure figure) {
  const std::vector<CampaignFigure>& figures = parts.campaign.figures;
  return std::find(figures.begin(), figures.end(), figure) != figures.end();
}

std::string paragraph(const std::string& words) {
  return "<p>" + escape_html(words) + "</p>\n";
}

constexpr const char* kReading =
    "Success (SR): every robot arrived without any contact. OR: not arrived in time. CR: a contact. In "
    "brackets "
    "the Wilson 95 % interval. Distances, paths and times are mean | minimum | standard deviation over "
    "successful trials (paths and times over their robots); optimiser calls per robot, over all trials. Time "
    "ratio: over the obstacle-free rest-to-rest optimum; read a success rate only together with it, caution "
    "buys success.";
constexpr const char* kPaperDoubts =
    "The paper's figures are its own generator's, with speeds and sizes that it does not state; ratios "
    "compare, seconds do not. Two of its cells cannot be right: the distances shared by ES2 and ES2* at 2 "
    "Sigma, and the standard deviation 3.41 of ES2* at 1 Sigma.";
constexpr const char* kCrossingReading =
    "A crossing is one robot's passage through the scene; it is ok when the robot arrives within the allowed "
    "multiple of its obstacle-free time without a contact. Recorded people do not react: a contact with one "
    "who walks into a robot that has stood still for a second is counted apart. Windows of one recording "
    "overlap, so the trials are not independent and the intervals are too narrow.";
constexpr const char* kPairedReading =
    "Two methods on the same trials: scenes, obstacles' motion and sensor noise are equal. p: McNemar's "
    "exact test, two-sided, of the trials in which only one succeeded; bold below 0.05, not corrected for "
    "the number of comparisons.";

std::string charts_html(const std::vector<std::string>& charts) {
  std::string html;
  for (const std::string& chart : charts) html += "<div>" + chart + "</div>\n";
  return html.empty() ? "" : "<div class=\"charts\">\n" + html + "</div>\n";
}

std::string tables_html(const std::vector<PageTable>& tables) {
  std::string html;
  for (const PageTable& table : tables) html += html_table(table);
  return html;
}

std::string facts_html(const CampaignParts& parts) {
  std::string html;
  for (std::size_t i = 0; i < parts.folders.size(); ++i) {
    const nlohmann::json run = nlohmann::json::parse(parts.run_files[i], nullptr, false);
    std::string line = parts.folders[i].string();
    const auto add = [&](const char* key, const std::string& before, const std::string& after) {
      if (run.is_object() && run.contains(key))
        line += before + (run[key].is_string() ? run[key].get<std::string>() : run[key].dump()) + after;
    };
    add("date", ", ", "");
    add("commit", ", commit ", "");
    add("compiler", ", ", "");
    add("jobs", ", ", " jobs");
    add("wall_seconds", ", ", " s");
    html += paragraph(line);
  }
  return html_details("Where these trials come from (" + std::to_string(parts.folders.size()) + ")", html);
}

std::string tables_section(const CampaignParts& parts) {
  std::string html = paragraph(kReading);
  if (shows(parts, CampaignFigure::table2) || shows(parts, CampaignFigure::table3))
    html += paragraph(kPaperDoubts);
  if (shows(parts, CampaignFigure::table2)) html += tables_html(table2_tables(parts));
  if (shows(parts, CampaignFigure::table3)) html += tables_html(table3_tables(parts));
  const PageTable crossings = crossings_table(parts);
  if (!crossings.rows.empty()) html += html_table(crossings) + paragraph(kCrossingReading);
  const std::string rows = html_table(rows_table(parts));
  const bool paper_form = shows(parts, CampaignFigure::table2) || shows(parts, CampaignFigure::table3);
  html += paper_form ? html_details("All rows, all columns", rows) : rows;
  if (shows(parts, CampaignFigure::wheels)) html += html_table(wheel_table(parts));
  return html + facts_html(parts);
}

std::string pictures_section(const CampaignParts& parts) {
  std::string wheels, frames;
  for (const StoredPicture& picture : parts.pictures)
    (picture.name.starts_with("wheels") ? wheels : frames) +=
        "<figure>" + picture.svg + "<figcaption>" + escape_html(picture.name) + "</figcaption></figure>\n";
  return (frames.empty() ? "" : "<div class=\"frames\">" + frames + "</div>\n") +
         (wheels.empty() ? "" : "<div class=\"charts\">" + wheels + "</div>\n");
}

std::string paired_section(const CampaignParts& parts) {
  std::string html = paragraph(kPairedReading);
  for (const PageTable& table : paired_tables(parts)) {
    PageTable bare = table;
    bare.caption.clear();
    html += html_details(table.caption, html_table(bare));
  }
  return html;
}

PageTable failed_trials(const CampaignParts& parts, std::size_t cell, const ReplayLinks& replays) {
  PageTable table{"", {"trial", "outcome", "what happened", "what the robot was about", "see it"}, {}};
  for (const TrialRecord& record : parts.cells[cell]) {
    if (record.succeeded()) continue;
    PageCell number{std::to_string(record.key.trial)};
    number.header = true;
    PageCell see;
    const auto link = replays.find({cell, record.key.trial});
    if (link != replays.end()) see.html = "<a href=\"" + escape_html(link->second) + "\">replay</a> ";
    see.html += "<code>" + escape_html(replay_command(parts, cell, record.key.trial)) + "</code>";
    table.rows.push_back({number,
                          {enum_name(record.outcome)},
                          {record.failure},
                          {record.cause ? to_text(*record.cause) : "-"},
                          see});
  }
  return table;
}

std::string replays_text(const CampaignParts& parts, const ReplayLinks& replays) {
  std::size_t failed = 0;
  for (const CellTrials& cell : parts.cells)
    for (const TrialRecord& record : cell) failed += !record.succeeded() ? 1 : 0;
  std::string text = std::to_string(replays.size()) + " of " + std::to_string(failed) +
                     " failed trials have their replay here";
  if (replays.size() < failed) text += "; spf report --replays all adds the others";
  return text + ". The command beside a trial also makes its replay.";
}

std::string failures_section(const CampaignParts& parts, const ReplayLinks& replays) {
  std::string html = html_table(failure_table(parts));
  html += paragraph(replays_text(parts, replays));
  html += paragraph(
      "Standing: slower than 0.05 m/s at the contact. Last plan: the outcome of the robot's last planning "
      "call before it. Every failed trial, by row of the table:");
  for (std::size_t i = 0; i < parts.cells.size(); ++i) {
    const PageTable table = failed_trials(parts, i, replays);
    if (table.rows.empty()) continue;
    html += html_details(cell_text(parts.cells[i].front().key) + ": " + std::to_string(table.rows.size()) +
                             " of " + std::to_string(parts.cells[i].size()) + " failed",
                         html_table(table));
  }
  return html;
}

std::string markdown_of(const PageTable& table) {
  std::vector<TableColumn> columns;
  for (const std::string& header : table.headers)
    columns.push_back({header, columns.empty() ? Alignment::left : Alignment::right});
  Table out{columns};
  for (const std::vector<PageCell>& row : table.rows) {
    std::vector<std::string> cells;
    for (const PageCell& cell : row)
      cells.push_back((cell.strong ? "**" + cell.text + "**" : cell.text) +
                      (cell.sub.empty() ? "" : " (" + cell.sub + ")"));
    out.add_row(std::move(cells));
  }
  return (table.caption.empty() ? "" : "### " + table.caption + "\n\n") + out.to_markdown() + "\n";
}

}  // namespace

std::string replay_command(const CampaignParts& parts, std::size_t cell, int trial) {
  if (parts.scenarios[cell].empty()) return "";
  return "spf run " + parts.scenarios[cell].string() + " --first " + std::to_string(trial) +
         " --out replay_" + std::to_string(trial);
}

std::vector<PageSection> report_sections(const CampaignParts& parts, const ReplayLinks& replays) {
  const std::string& name = parts.campaign.name;
  std::vector<PageSection> sections;
  const auto add = [&](const std::string& id, const std::string& heading, std::string body) {
    std::string safe = name + "-" + id;
    std::replace(safe.begin(), safe.end(), '.', '-');
    if (!body.empty()) sections.push_back({safe, heading, std::move(body)});
  };
  add("tables", parts.campaign.title.empty() ? name : parts.campaign.title, tables_section(parts));
  if (!parts.pictures.empty())
    add("pictures", name + ": pictures of the first trial", pictures_section(parts));
  add("success", name + ": success against the level of noise", charts_html(success_charts(parts)));
  add("paired", name + ": methods compared on the same trials", paired_section(parts));
  add("failures", name + ": why did it fail", failures_section(parts, replays));
  add("travel", name + ": travel times",
      paragraph("Boxes: 25, 50 and 75 %; whiskers: 5 and 95 %. Robots of successful trials.") +
          charts_html(travel_charts(parts)));
  add("runtime", name + ": run time",
      charts_html(shows(parts, CampaignFigure::runtime) ? part_charts(parts) : std::vector<std::string>{}) +
          charts_html(time_charts(parts)) + html_table(runtime_table(parts)));
  return sections;
}

std::vector<StoredPicture> report_pictures(const CampaignParts& parts) {
  std::vector<StoredPicture> pictures;
  const auto add = [&](const char* kind, const std::vector<std::string>& charts) {
    for (std::size_t i = 0; i < charts.size(); ++i)
      pictures.push_back({kind + std::to_string(i + 1) + ".svg", standalone(charts[i])});
  };
  add("success", success_charts(parts));
  add("travel", travel_charts(parts));
  if (shows(parts, CampaignFigure::runtime)) add("parts", part_charts(parts));
  add("times", time_charts(parts));
  return pictures;
}

std::string report_markdown(const CampaignParts& parts) {
  std::string text = "# " + (parts.campaign.title.empty() ? parts.campaign.name : parts.campaign.title) +
                     "\n\n" + kReading + "\n\n";
  const bool table2 = shows(parts, CampaignFigure::table2), table3 = shows(parts, CampaignFigure::table3);
  if (table2 || table3) text += std::string{kPaperDoubts} + "\n\n";
  if (table2)
    for (const PageTable& table : table2_tables(parts)) text += markdown_of(table);
  if (table3)
    for (const PageTable& table : table3_tables(parts)) text += markdown_of(table);
  const PageTable crossings = crossings_table(parts);
  if (!crossings.rows.empty()) text += markdown_of(crossings) + std::string{kCrossingReading} + "\n\n";
  if (!table2 && !table3) text += markdown_of(rows_table(parts));
  if (shows(parts, CampaignFigure::wheels)) text += markdown_of(wheel_table(parts));
  text += "## Methods compared on the same trials\n\n" + std::string{kPairedReading} + "\n\n";
  for (const PageTable& table : paired_tables(parts)) text += markdown_of(table);
  text += "## Why did it fail\n\n" + markdown_of(failure_table(parts));
  text += "## Run time\n\n" + markdown_of(runtime_table(parts));
  return text;
}

}  // namespace spf

#include "apps/campaign_summary.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/run_summary.hpp"
#include "apps/version.hpp"
#include "config/parameter_text.hpp"
#include "parallel/worker_pool.hpp"
#include "report/table.hpp"

namespace spf {

using Json = nlohmann::ordered_json;

namespace {

/// Table of the rows among recorded people; empty when there are none.
std::string crossings_table(const std::vector<ResultRow>& rows) {
  Table table{{{"crossings", Alignment::left},
               {"condition", Alignment::left},
               {"method", Alignment::left},
               {"n"},
               {"ok %"},
               {"contacts"},
               {"a robot-minute"},
               {"hits while standing"},
               {"robot-minutes"}}};
  bool any = false;
  for (const ResultRow& row : rows) {
    if (row.crossings == 0) continue;
    any = true;
    table.add_row({row.family, row.condition, row.method, std::to_string(row.crossings),
                   fixed(100.0 * row.crossings_ok / row.crossings, 1), std::to_string(row.contacts_moving),
                   fixed(row.contacts_moving / std::max(row.robot_minutes, 1e-9), 3),
                   std::to_string(row.hits_while_standing), fixed(row.robot_minutes, 1)});
  }
  return any ? "\n" + table.to_text() : "";
}

}  // namespace

std::string campaign_table(const std::vector<ResultRow>& rows) {
  const bool conditions =
      std::any_of(rows.begin(), rows.end(), [](const ResultRow& row) { return !row.condition.empty(); });
  std::vector<TableColumn> columns{{"family", Alignment::left}};
  if (conditions) columns.push_back({"condition", Alignment::left});
  for (const TableColumn& column : std::vector<TableColumn>{{"noise", Alignment::left},
                                                            {"Sigma"},
                                                            {"tracking", Alignment::left},
                                                            {"method", Alignment::left},
                                                            {"n"},
                                                            {"SR %"},
                                                            {"95 % interval"},
                                                            {"OR %"},
                                                            {"time ratio"},
                                                            {"travel [s]"},
                                                            {"calls"},
                                                            {"plan [ms]"}})
    columns.push_back(column);
  Table table{columns};
  for (const ResultRow& row : rows) {
    std::vector<std::string> cells{row.family};
    if (conditions) cells.push_back(row.condition);
    for (const std::string& cell :
         {row.noise, to_text(row.level), row.tracking, row.method, std::to_string(row.trials),
          fixed(100.0 * row.success_rate, 1),
          fixed(100.0 * row.wilson_low, 1) + " - " + fixed(100.0 * row.wilson_high, 1),
          fixed(100.0 * row.timeout / std::max(row.trials, 1), 1), fixed(row.travel_time_ratio, 3),
          fixed(row.travel_time_mean, 2), fixed(row.optimiser_calls_per_robot, 1),
          fixed(row.plan_ms_median, 3)})
      cells.push_back(cell);
    table.add_row(std::move(cells));
  }
  return table.to_text() + crossings_table(rows);
}

std::string json_lines(const std::vector<ResultRow>& rows, const std::vector<PairedRow>& pairs) {
  std::string text;
  for (const ResultRow& row : rows) text += to_json_line(row) + "\n";
  for (const PairedRow& pair : pairs) text += to_json_line(pair) + "\n";
  return text;
}

std::string csv_text(const std::vector<ResultRow>& rows) {
  const auto with_condition = [](std::string line, const std::string& condition) {
    line.pop_back();
    return line + "," + condition + "\n";
  };
  std::string text = with_condition(csv_header(), "condition");
  for (const ResultRow& row : rows) {
    std::string condition = row.condition;
    std::replace(condition.begin(), condition.end(), '"', '\'');
    if (condition.find_first_of(",\n") != std::string::npos) condition.append(1, '"').insert(0, 1, '"');
    text += with_condition(to_csv_line(row), condition);
  }
  return text;
}

std::string campaign_json(const Campaign& campaign, const CampaignFacts& facts, const std::string& earlier) {
  std::vector<std::string> commits = commits_of(earlier);
  commits.erase(std::remove(commits.begin(), commits.end(), kCommit), commits.end());
  commits.emplace_back(kCommit);
  const Json json{{"program", "spf"},
                  {"version", version()},
                  {"commit", kCommit},
                  {"commits", commits},
                  {"compiler", compiler()},
                  {"date", today()},
                  {"command", facts.command},
                  {"campaign", campaign.name},
                  {"seed", campaign.seed},
                  {"first", campaign.first},
                  {"trials", campaign.trials},
                  {"shard", std::to_string(facts.shard.index) + "/" + std::to_string(facts.shard.count)},
                  {"asked", facts.asked},
                  {"finished", facts.finished},
                  {"jobs", facts.jobs},
                  {"processors", processor_count()},
                  {"wall_seconds", facts.wall_time}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> commits_of(const std::string& run_json) {
  const Json json = Json::parse(run_json, nullptr, false);
  std::vector<std::string> commits;
  if (!json.is_object()) return commits;
  if (json.contains("commits") && json["commits"].is_array()) {
    for (const Json& commit : json["commits"])
      if (commit.is_string()) commits.push_back(commit.get<std::string>());
  } else if (json.contains("commit") && json["commit"].is_string()) {
    commits.push_back(json["commit"].get<std::string>());
  }
  return commits;
}

}  // namespace spf

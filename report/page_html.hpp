// The frame of a report page: one HTML file with its style and its few lines of script, asking the network
// for nothing; light and dark, narrow and wide, by keyboard.
#pragma once

#include <string>
#include <vector>

namespace spf {

struct PageSection {
  std::string id;       ///< letters, digits, dashes
  std::string heading;  ///< text
  std::string body;     ///< HTML
};

/// The whole file. `lead` is HTML below the title.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& lead,
                                    const std::vector<PageSection>& sections);

/// A cell of a table: text is escaped; `sub` stands below it, quieter; `html` is taken as it is and comes
/// first.
struct PageCell {
  std::string text;
  std::string sub = {};
  std::string html = {};
  bool strong = false;
  bool header = false;  ///< names its row
};
struct PageTable {
  std::string caption;
  std::vector<std::string> headers;
  std::vector<std::vector<PageCell>> rows;
};
[[nodiscard]] std::string html_table(const PageTable& table);

/// Something that opens on demand.
[[nodiscard]] std::string html_details(const std::string& summary, const std::string& body);

}  // namespace spf

#include "report/replay_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/html_text.hpp"
#include "report/test/sample_replay.hpp"

namespace spf {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(ReplayPage, HoldsOneDataAndOneCodeScriptWhateverTheTextsSay) {
  ReplayData data = sample_replay();
  data.title = "</title></script><script>alert(1)</script>@SCRIPT@ @DATA@";
  const std::string page = render_replay(data);
  EXPECT_EQ(count(page, "<script"), 2U);
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_EQ(count(page, "</title>"), 1U);
  EXPECT_THAT(page, testing::HasSubstr("<title>&lt;/title&gt;&lt;/script&gt;"));
  EXPECT_THAT(page, testing::EndsWith("</html>\n"));
}

TEST(ReplayPage, NamesNoOtherAddress) {
  const std::string page = render_replay(sample_replay());
  for (const char* door :
       {"http:", "https:", "@import", "url(", "fetch(", "XMLHttpRequest", "WebSocket", "import("}) {
    EXPECT_THAT(page, testing::Not(testing::HasSubstr(door)));
  }
  EXPECT_THAT(page, testing::HasSubstr("default-src 'none'"));
}

TEST(ReplayPage, OneRunGivesOneText) {
  EXPECT_EQ(render_replay(sample_replay()), render_replay(sample_replay()));
}

TEST(ReplayPage, CodeAndStyleStaySmall) {
  EXPECT_LT(render_replay(ReplayData{}).size(), 120'000U);
}

TEST(HtmlText, SpellsOutWhatHtmlWouldRead) {
  EXPECT_EQ(escape_html("<a href=\"x\">'&'</a>\x01\n"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;\n");
  EXPECT_EQ(escape_html("\xC3\xA4"), "\xC3\xA4");
}

}  // namespace
}  // namespace spf

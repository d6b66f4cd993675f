#include "report/frame_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "report/palette.hpp"
#include "report/test/sample_replay.hpp"

namespace spf {
namespace {

/// Every element that opens also closes, in order, and every '<' belongs to an element.
bool is_balanced(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find_first_of("<>", at + 1);
    if (end == std::string::npos || svg[end] == '<') return false;
    const std::string tag = svg.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.front() == '/') {
      if (open.empty() || "/" + open.back() != name) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty();
}

TEST(FrameSvg, TheBalanceCheckSeesFaults) {
  EXPECT_TRUE(is_balanced("<svg><a b=\"c\"/><t>x</t></svg>"));
  EXPECT_FALSE(is_balanced("<svg><t></svg></t>"));
  EXPECT_FALSE(is_balanced("<svg>"));
  EXPECT_FALSE(is_balanced("<svg>a < b</svg>"));
}

ReplayData two_frames() {
  ReplayData data;
  data.frame_interval = 1.0;
  data.bounds = {{0.0, 0.0}, {10.0, 5.0}};
  ReplayRobot robot;
  robot.id = 4;
  robot.radius = 0.5;
  robot.frames.resize(2);
  robot.frames[0].pose = {1.0, 1.0, 0.0};
  robot.frames[1].pose = {3.0, 4.0, 0.0};
  robot.goal = {9.0, 4.0};
  data.robots = {robot};
  return data;
}

TEST(FrameSvg, PutsMetresWhereTheyBelongWithYUp) {
  const FrameSvgOptions options{
      .width = 1024.0, .dark = false, .plans = true, .trails = true};  // 100 px a metre, 12 px margin
  const std::string svg = render_frame_svg(two_frames(), 1.0, options);
  EXPECT_THAT(svg, testing::HasSubstr("<circle cx=\"312.0\" cy=\"112.0\" r=\"50.0\""));
  EXPECT_THAT(svg, testing::HasSubstr("<polyline points=\"112.0,412.0 312.0,112.0\""));
  EXPECT_THAT(svg, testing::HasSubstr(">4</text>"));
}

TEST(FrameSvg, HoldsTimesOutsideOfTheRun) {
  EXPECT_EQ(render_frame_svg(two_frames(), 99.0), render_frame_svg(two_frames(), 1.0));
  EXPECT_EQ(render_frame_svg(two_frames(), -3.0), render_frame_svg(two_frames(), 0.0));
}

TEST(FrameSvg, IsWellFormedWhateverTheTitleSays) {
  ReplayData data = sample_replay();
  data.title = "</title><script>\"&'";
  const std::string svg = render_frame_svg(data, 12.4);
  EXPECT_TRUE(is_balanced(svg));
  EXPECT_THAT(svg, testing::HasSubstr("&lt;/title&gt;&lt;script&gt;"));
}

TEST(FrameSvg, MarksAContactOnlyOnceItHasHappened) {
  ReplayData data = two_frames();
  data.events = {{0.8, 4, ReplayEventKind::contact, "", "border", ReplayPoint{2.0, 2.0}}};
  const std::string bad{palette_color("bad").light};
  EXPECT_THAT(render_frame_svg(data, 0.7), testing::Not(testing::HasSubstr(bad)));
  EXPECT_THAT(render_frame_svg(data, 0.9), testing::HasSubstr(bad));
}

TEST(FrameSvg, DrawsPolygonsAndMaps) {
  ReplayData data = two_frames();
  const auto polygons = [&data] {
    const std::string svg = render_frame_svg(data, 0.0);
    EXPECT_TRUE(is_balanced(svg));
    std::size_t count = 0;
    for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1))
      ++count;
    return count;
  };
  const std::size_t before = polygons();
  data.shapes.polygons = {{{0.0, 0.0}, {1.0, 0.0}, {0.5, 1.0}}};
  data.shapes.blocks = {{{{2.0, 2.0}, {3.0, 2.0}, {3.0, 2.1}, {2.0, 2.1}}}};
  EXPECT_EQ(polygons(), before + 2);
}

TEST(FrameSvg, LeavesOutWhatIsNotKnown) {
  ReplayData data = two_frames();
  data.robots[0].frames[1].pose.x = kUnknown;
  data.robots[0].goal.y = kUnknown;
  EXPECT_THAT(render_frame_svg(data, 1.0), testing::Not(testing::HasSubstr("nan")));
  EXPECT_NO_THROW((void)render_frame_svg(ReplayData{}, 0.0));
  data.frame_interval = 0.0;
  EXPECT_THROW((void)render_frame_svg(data, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace spf

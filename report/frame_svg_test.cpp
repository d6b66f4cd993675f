#include "report/frame_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <vector>

#include "report/palette.hpp"
#include "report/test/sample_replay.hpp"

namespace spf {
namespace {

/// A reader of well-formed XML without attributes' meaning: every element that opens also closes, in order.
bool is_balanced(const std::string& svg) {
  const std::regex tag{"<(/?)([a-z]+)((?:\\s+[a-zA-Z:-]+=\"[^\"<]*\")*)\\s*(/?)>"};
  std::vector<std::string> open;
  std::size_t tags = 0;
  for (std::sregex_iterator at{svg.begin(), svg.end(), tag}, end; at != end; ++at, ++tags) {
    if ((*at)[1] == "/") {
      if (open.empty() || open.back() != (*at)[2]) return false;
      open.pop_back();
    } else if ((*at)[4] != "/") {
      open.push_back((*at)[2]);
    }
  }
  return open.empty() && tags == static_cast<std::size_t>(std::count(svg.begin(), svg.end(), '<'));
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

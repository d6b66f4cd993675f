// Recordings in the public formats, and what is wrong with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/crowd_collector.hpp"
#include "study/crowd_file.hpp"

namespace spf {
namespace {

using testing::HasSubstr;

using Recording = std::shared_ptr<const sim::CrowdRecording>;

Recording read(const std::string& text, const CrowdSettings& settings = {}) {
  InputProblems problems;
  const Recording recording = crowd_from_text(text, "crowd", problems, settings);
  EXPECT_TRUE(recording) << problems.to_text();
  return recording;
}

std::string wrong_with(const std::string& text, const CrowdSettings& settings = {}) {
  InputProblems problems;
  EXPECT_FALSE(crowd_from_text(text, "crowd", problems, settings));
  return problems.to_text();
}

/// Person 7 walks along x at 1 m/s, sampled every 0.4 s three times; person 9 stands from 0.4 s on.
void expect_walk(const Recording& recording, double begin = 0.0) {
  ASSERT_TRUE(recording);
  const std::vector<sim::CrowdSample>& samples = recording->samples();
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_NEAR(recording->interval(), 0.4, 1e-6);
  for (const sim::CrowdSample& sample : samples) {
    const double time = sample.time - begin;
    if (sample.id == 7) {
      EXPECT_NEAR((sample.position_world - Eigen::Vector2d{2.0 + time, 3.0}).norm(), 0.0, 1e-6) << time;
    } else {
      EXPECT_EQ(sample.id, 9);
      EXPECT_EQ(sample.position_world, Eigen::Vector2d(-1.0, 4.5));
    }
  }
}

TEST(CrowdFormats, ReadsTrajnet) {
  expect_walk(
      read("{\"scene\": {\"id\": 266, \"p\": 7, \"s\": 0, \"e\": 20, \"fps\": 2.5, \"tag\": 2}}\n"
           "{\"track\": {\"f\": 0, \"p\": 7, \"x\": 2.0, \"y\": 3}}\n"
           "{\"track\": {\"f\": 10, \"p\": 7, \"x\": 2.4, \"y\": 3}}\n\n"
           "{\"track\": {\"f\": 10, \"p\": 9, \"x\": -1, \"y\": 4.5}}\r\n"
           "{\"track\": {\"f\": 20, \"p\": 7, \"x\": 2.8, \"y\": 3}}\n"
           "{\"track\": {\"f\": 20, \"p\": 9, \"x\": -1.0, \"y\": 4.5}}\n"
           "{\"track\": {\"f\": 20, \"p\": 9, \"x\": 3, \"y\": 1, \"prediction_number\": 0, "
           "\"scene_id\": 266}}\n"));
}

TEST(CrowdFormats, ReadsObsmat) {
  const std::string text =
      "  7.8000000e+02   7.0000000e+00   2.0000000e+00   0.0000000e+00   3.0000000e+00   1.0   0.0   0.0\n"
      "  7.8600000e+02   7.0000000e+00   2.4000000e+00   0.0000000e+00   3.0000000e+00   1.0   0.0   0.0\n"
      "  7.8600000e+02   9.0000000e+00  -1.0000000e+00   0.0000000e+00   4.5000000e+00   0.0   0.0   0.0\n"
      "  7.9200000e+02   7.0000000e+00   2.8000000e+00   0.0000000e+00   3.0000000e+00   1.0   0.0   0.0\n"
      "  7.9200000e+02   9.0000000e+00  -1.0000000e+00   0.0000000e+00   4.5000000e+00   0.0   0.0   0.0\n";
  expect_walk(read(text), 780.0 / 15.0);  // every sixth frame is 0.4 s later
  const Recording faster = read(text, CrowdSettings{30.0});
  EXPECT_NEAR(faster->interval(), 0.2, 1e-9);
}

TEST(CrowdFormats, ReadsFourColumnsOfNumbers) {
  expect_walk(
      read("0.0\t7.0\t2.0\t3.0\n10.0\t7.0\t2.4\t3.0\n10.0\t9.0\t-1.0\t4.5\n20.0\t7.0\t2.8\t3.0\n"
           "20.0\t9.0\t-1.0\t4.5\n"));
}

TEST(CrowdFormats, ReadsColumnsByOtherNamesAndInAnyOrderOfLines) {
  // Grouped by person, as tables are written.
  expect_walk(
      read("ID;Frame;Pos_X;Pos_Y;note\n7;0;2;3;a\n7;25;2.4;3;b\n7;50;2.8;3;c\n9;25;-1;4.5;d\n"
           "9;50;-1;4.5;e\n"));
  expect_walk(
      read("time,pedestrian_id,x,y\n0.8,9,-1,4.5\n0.4,9,-1,4.5\n0,7,2,3\n0.4,7,2.4,3\n0.8,7,2.8,3\n"));
}

TEST(CrowdFormats, TimesMayCountFromAnyEpoch) {
  const Recording seconds = read(
      "timestamp,id,x,y\n1356969600.0,7,2,3\n1356969600.4,7,2.4,3\n1356969600.4,9,-1,4.5\n"
      "1356969600.8,7,2.8,3\n1356969600.8,9,-1,4.5\n");
  expect_walk(seconds);
  EXPECT_EQ(seconds->begin(), 0.0);
  expect_walk(
      read("timestamp_ms,id,x,y\n1356969600000,7,2,3\n1356969600400,7,2.4,3\n1356969600400,9,-1,4.5\n"
           "1356969600800,7,2.8,3\n1356969600800,9,-1,4.5\n"));
}

TEST(CrowdFormats, LargeIdsAreNumberedAnew) {
  const Recording recording =
      read("t_s,agent_id,x_m,y_m\n0,9223372036854,1,1\n0,3,2,2\n0.4,9223372036854,1,1\n0.4,3,2,2\n");
  ASSERT_EQ(recording->samples().size(), 4u);
  EXPECT_EQ(recording->samples()[0].id, 1);
  EXPECT_EQ(recording->samples()[1].id, 2);
  EXPECT_EQ(recording->samples()[2].id, 1);
  EXPECT_EQ(read("t_s,agent_id,x_m,y_m\n0,999999,1,1\n")->samples()[0].id, 999999);
}

TEST(CrowdFormats, AbsenceIsNoMovement) {
  // Out of sight for 10 s, and back elsewhere: nobody is there meanwhile.
  const Recording recording =
      read("t_s,agent_id,x_m,y_m\n0,1,0,0\n0.4,1,0.4,0\n0.8,1,0.8,0\n10.8,1,9,0\n11.2,1,9.4,0\n");
  EXPECT_NEAR(recording->longest_gap(), 0.6, 1e-9);
}

TEST(CrowdFormats, SayWhatIsWrongAndWhere) {
  struct Bad {
    std::string text, expected;
  };
  const std::string track = "{\"track\": {\"f\": 0, \"p\": 7, \"x\": 2.0, \"y\": 3}}\n";
  const std::vector<Bad> table{
      {track + "{\"track\": {\"f\": 0, \"p\": 8, \"x\": \"a\", \"y\": 3}}\n",
       "crowd:2: x = \"a\" must be a number in [-100000.0, 100000.0]"},
      {track + "{\"track\": {\"f\": 0, \"p\": 8.5, \"x\": 1, \"y\": 3}}\n",
       "crowd:2: p = 8.5 must be a whole number of at least 0"},
      {track + "{\"track\": {\"f\": 0, \"p\": 8, \"x\": 1}}\n", "crowd:2: y is missing"},
      {track + "{\"track\": {\"f\": 0\n", "crowd:2: is no JSON object"},
      {track + "{\"tracks\": []}\n", "crowd:2: must hold a scene or a track"},
      {track + "{" + std::string(2000, '[') + "\n", "crowd:2: is longer than 1000 bytes"},
      {"{\"scene\": {\"id\": 1, \"fps\": 0}}\n" + track, "crowd:1: fps = 0.0 must be above 0"},
      {"{\"scene\": {\"id\": 1, \"fps\": 2.5}}\n", "crowd: holds nobody"},
      {track + track, "crowd:2: p = 7 stands twice at f = 0 (first in line 1)"},
      {"0 1 2 3\n1 1 2\n", "crowd:2: has 3 numbers: must have 8 (frame, id, x, z, y, vx, vz, vy) or 4"},
      {"0 1 2 3\n1 1 2 3 4 5 6 7\n", "crowd:2: has 8 numbers"},
      {"0 1 2 3\n1 one 2 3\n", "crowd:2: id = one must be a whole number in [0, 9007199254740992]"},
      {"0 1 2 0 3 0 0 0\n6 1 2 0 y 0 0 0\n", "crowd:2: y = y must be a number in m"},
      {"0 1 2 3\n1 1 2 30\n", "crowd:2: id = 1 moves 27 m in 0.4 s: must be at most 15 m/s"},
      {"t_s,agent_id,x_m,y_m\n1356969600000,1,2,3\n",
       "crowd:2: t_s = 1356969600000 must lie in [-1e+11, 1e+11] s"},
      {"t_s,agent_id,x_m,y_m\n0,1,2,3\n1356969600,1,2,3\n",
       "crowd:3: t_s is 1356969600 s after the first one, of line 2: a recording must last at most 1e+07 s"},
      {"t_s,agent_id,x_m,y_m\n0,10000000000000000,2,3\n",
       "agent_id = 10000000000000000 must be a whole number"},
      {"id,x,y\n1,2,3\n", "crowd:1: the column t_s is missing"}};
  for (const Bad& bad : table) EXPECT_THAT(wrong_with(bad.text), HasSubstr(bad.expected)) << bad.text;
}

TEST(CrowdFormats, MorePeopleThanTheSimulatorNumbersAreRefused) {
  std::string text = "t_s,agent_id,x_m,y_m\n";
  for (int person = 0; person <= 1'000'000; ++person) text += "0," + std::to_string(person) + ",1,1\n";
  EXPECT_THAT(wrong_with(text), HasSubstr("crowd: holds more than 999999 people"));
}

}  // namespace
}  // namespace spf

#include "study/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "study/scenario_file.hpp"

namespace spf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A folder of its own for each test.
class MapFiles : public testing::Test {
 protected:
  MapFiles()
      : folder_{testing::TempDir() + "spf_" + testing::UnitTest::GetInstance()->current_test_info()->name()} {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "maps");
  }
  ~MapFiles() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::ofstream{path, std::ios::binary} << text;
    return path.string();
  }

  /// The map, or what is wrong with it, without the folder's name.
  std::shared_ptr<const sim::StaticMap> read(const std::string& path, const MapSettings& settings = {}) {
    InputProblems problems;
    const auto map = read_map_file(path, settings, {"scene.yaml", 3, 6}, problems);
    wrong_ = problems.to_text();
    const std::string folder = folder_.string() + "/";
    for (std::size_t at = wrong_.find(folder); at != std::string::npos; at = wrong_.find(folder))
      wrong_.erase(at, folder.size());
    EXPECT_EQ(map == nullptr, !problems.empty());
    return map;
  }
  std::string wrong_with(const std::string& yaml) {
    read(write("map.yaml", yaml));
    return wrong_;
  }

  std::filesystem::path folder_;
  std::string wrong_;
};

// Black, dark, grey, light, white; below it white alone.
constexpr const char* kStrip = "P2 5 2 255\n0 80 128 220 255\n255 255 255 255 255\n";
const std::string kYaml = "image: strip.pgm\nresolution: 0.5\norigin: [1, 2, 0]\n";

std::vector<std::int8_t> upper_row(const sim::StaticMap& map) {
  const std::vector<std::int8_t>& values = *map.cells().values;
  return {values.begin() + 5, values.end()};  // the second row of a map is the upper one
}

TEST_F(MapFiles, AreReadAsMapServersDo) {
  write("strip.pgm", kStrip);
  const auto map = read(write("map.yaml", kYaml + "occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n"));
  ASSERT_TRUE(map) << wrong_;
  const host::CellMap cells = map->cells();
  EXPECT_EQ(cells.width, 5u);
  EXPECT_EQ(cells.height, 2u);
  EXPECT_EQ(cells.resolution, 0.5);
  EXPECT_EQ(cells.origin_world.position_world, Eigen::Vector2d(1.0, 2.0));
  EXPECT_THAT(upper_row(*map), ElementsAre(100, 100, -1, 0, 0));
  EXPECT_TRUE(map->occupied({1.2, 2.7}));   // the upper left pixel
  EXPECT_FALSE(map->occupied({1.2, 2.2}));  // the one below it
}

TEST_F(MapFiles, HaveThreeModesAndThresholds) {
  write("strip.pgm", kStrip);
  const auto row_with = [&](const std::string& more) {
    const auto map = read(write("map.yaml", kYaml + more));
    return map ? upper_row(*map) : std::vector<std::int8_t>{};
  };
  EXPECT_THAT(row_with(""), ElementsAre(100, 100, -1, 0, 0));
  EXPECT_THAT(row_with("negate: 1\n"), ElementsAre(0, -1, -1, 100, 100));
  EXPECT_THAT(row_with("negate: true\n"), ElementsAre(0, -1, -1, 100, 100));
  EXPECT_THAT(row_with("occupied_thresh: 0.7\nfree_thresh: 0.1\n"), ElementsAre(100, -1, -1, -1, 0));
  // (255 - 128) / 255 lies at 0.6655 of the way from 0.196 to 0.65.
  EXPECT_THAT(row_with("mode: scale\n"), ElementsAre(100, 100, 65, 0, 0));
  EXPECT_THAT(row_with("mode: raw\n"), ElementsAre(0, 80, -1, -1, -1));
}

TEST_F(MapFiles, MayBeTurned) {
  write("strip.pgm", kStrip);
  const auto map =
      read(write("map.yaml", "image: strip.pgm\nresolution: 1.0\norigin: [0, 0, 1.5707963267948966]\n"));
  ASSERT_TRUE(map) << wrong_;
  EXPECT_TRUE(map->occupied({-1.5, 0.5}));  // x points up, y to the left
  EXPECT_FALSE(map->occupied({-0.5, 0.5}));
  EXPECT_FALSE(map->occupied({-1.5, 4.5}));
}

TEST_F(MapFiles, UnknownCellsAreWhatTheScenarioSays) {
  write("strip.pgm", kStrip);
  const std::string path = write("map.yaml", kYaml);
  MapSettings settings;
  settings.unknown = UnknownCells::wall;
  const auto map = read(path, settings);
  ASSERT_TRUE(map) << wrong_;
  EXPECT_TRUE(map->occupied({2.2, 2.7}));
  EXPECT_FALSE(read(path)->occupied({2.2, 2.7}));
}

TEST_F(MapFiles, APictureMayStandAlone) {
  MapSettings settings;
  settings.image_resolution = 0.25;
  settings.image_origin = {-1.0, 4.0};
  settings.image_heading = 0.5;
  const auto map = read(write("strip.pgm", kStrip), settings);
  ASSERT_TRUE(map) << wrong_;
  EXPECT_EQ(map->cells().resolution, 0.25);
  EXPECT_EQ(map->cells().origin_world.heading, 0.5);
  EXPECT_EQ(map->cells().origin_world.position_world, Eigen::Vector2d(-1.0, 4.0));
  EXPECT_THAT(upper_row(*map), ElementsAre(100, 100, -1, 0, 0));
}

TEST_F(MapFiles, AreRefusedWithFileKeyValueAndLimit) {
  write("strip.pgm", kStrip);
  EXPECT_EQ(wrong_with("image: strip.pgm\n"),
            "map.yaml:1:1: resolution is missing\nmap.yaml:1:1: origin is missing");
  EXPECT_EQ(wrong_with("image: strip.pgm\nresolution: 0\norigin: [0, 0, 0]\n"),
            "map.yaml:2:13: resolution = 0 must lie in [0.001, 100] m");
  EXPECT_EQ(wrong_with("image: strip.pgm\nresolution: 1\norigin: [0, 0]\n"),
            "map.yaml:3:9: origin = [0, 0] must be x, y and heading: [0, 0, 0]");
  EXPECT_EQ(wrong_with("image: strip.pgm\nresolution: 1\norigin: [0, 0, 90]\n"),
            "map.yaml:3:9: origin = [0, 0, 90] must have a heading in [-6.3, 6.3] rad");
  EXPECT_EQ(wrong_with(kYaml + "mode: tri\n"),
            "map.yaml:4:7: mode = tri must be one of trinary, scale, raw; did you mean trinary?");
  EXPECT_EQ(wrong_with(kYaml + "negate: 2\n"),
            "map.yaml:4:9: negate = 2 must be one of 0, 1, false, true; did you mean 0?");
  EXPECT_EQ(wrong_with(kYaml + "free_thresh: 0.7\n"),
            "map.yaml:4:14: free_thresh = 0.7 contradicts: free_thresh must be less than occupied_thresh");
  EXPECT_EQ(wrong_with(kYaml + "occupied_tresh: 0.7\n"),
            "map.yaml:4:1: occupied_tresh = 0.7 is not a known key; did you mean occupied_thresh?");
  EXPECT_EQ(wrong_with("image: none.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n"),
            "map.yaml:1:8: image = none.pgm is no file: there is none of that name");
  write("bad.pgm", "P2 2 2 9\n1 2\n3 x\n");
  EXPECT_EQ(wrong_with("image: bad.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n"),
            "bad.pgm:3: a pixel = x must be a whole number in [0, 9]");
  EXPECT_FALSE(read(folder_.string()));
  EXPECT_THAT(wrong_, HasSubstr("scene.yaml:3:6: map = "));
  EXPECT_THAT(wrong_, HasSubstr("is not a regular file"));
}

TEST_F(MapFiles, LieBesideTheirScenarioAndBelongToIt) {
  write(
      "maps/strip.pgm", "P2 8 4 255\n" + [] {
        std::string white;
        for (int i = 0; i < 32; ++i) white += "255 ";
        return white;
      }());
  write("maps/hall.yaml", "image: strip.pgm\nresolution: 1.0\norigin: [0, 0, 0]\n");
  const std::string scene =
      write("scene.yaml", "family: explicit\nmap: maps/hall.yaml\nrobots: [{start: [1, 2], goal: [7, 2]}]\n");
  const RunConfiguration config = read_run_configuration(scene);
  ASSERT_TRUE(config.map);
  EXPECT_EQ(make_trial(config, 0).map, config.map);  // trials share it
  // Written out, it can be read from anywhere, and is the same study.
  const RunConfiguration again = run_configuration_from_text(to_yaml_text(config), "/elsewhere/again.yaml");
  EXPECT_EQ(identity_text(again), identity_text(config));
  write(
      "maps/strip.pgm", "P2 8 4 255\n" + [] {
        std::string picture = "0 ";
        for (int i = 0; i < 31; ++i) picture += "255 ";
        return picture;
      }());
  EXPECT_NE(identity_text(read_run_configuration(scene)), identity_text(config));
  try {
    static_cast<void>(read_run_configuration(write(
        "bad.yaml", "family: explicit\nmap: maps/hall.yaml\nrobots: [{start: [1, 2], goal: [9, 2]}]\n")));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("bad.yaml:3:32: robots[0].goal = [9, 2] is in an occupied cell of the "
                          "map, or beyond its edges"));
  }
}

TEST_F(MapFiles, SaysWhatAFileIsNotThatIsNeitherTextNorAPictureThatItReads) {
  for (const std::string& bytes : {std::string{}, std::string{"\xFF\xD8\xFF\xE0\0\x10JFIF", 10}}) {
    read(write("hall.jpg", bytes));
    EXPECT_THAT(wrong_,
                testing::EndsWith("map = hall.jpg is neither a map server's YAML file nor a picture of kind "
                                  "PGM or PNG"));
  }
}

}  // namespace
}  // namespace spf

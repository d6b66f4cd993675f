// What tests of the program share: a folder for each test, and the program run in it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "spf/testing/source_dir.hpp"

namespace spf {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// The spf program under test, as it was built.
[[nodiscard]] std::string program_path();

inline const std::string kSource = source_dir();

inline std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream{path, std::ios::binary}.rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const fs::path& path) {
  std::istringstream text{text_of(path)};
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// A trial's or a row's line without what depends on the speed of the machine.
inline nlohmann::ordered_json without_timings(const std::string& line) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(line);
  for (const char* timing :
       {"plan_time", "control_time", "wall_time", "new_plan_time", "optimiser_time", "plan_ms_median",
        "plan_ms_p99", "plan_ms_max", "control_us_median", "control_us_p99", "wall_seconds"})
    json.erase(timing);
  return json;
}

struct Finished {
  int status = -1;
  std::string out, error;
};

/// A folder for each test, and the program run in it.
class Program : public testing::Test {
 protected:
  Program() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("good.yaml", kGood);
  }
  ~Program() override { fs::remove_all(folder_); }

  /// One robot, a short path, nothing in it; the trial ends within a few simulated seconds.
  static constexpr const char* kGood =
      "family: explicit\n"
      "robots: [{start: [0, 0], goal: [2, 0]}]\n"
      "moving: [{position: [0, 5], velocity: [0.5, 0]}]\n"
      "border: {low: [-3, -8], high: [8, 8]}\n";

  void write(const std::string& name, const std::string& text) const {
    std::ofstream{folder_ / name} << text;
  }
  [[nodiscard]] std::string command(const std::string& arguments) const {
    return "cd '" + folder_.string() + "' && '" + program_path() + "' " + arguments;
  }
  [[nodiscard]] Finished run(const std::string& arguments) const {
    const fs::path out = folder_ / "stdout", error = folder_ / "stderr";
    const int status = std::system(
        (command(arguments) + " >'" + out.string() + "' 2>'" + error.string() + "' </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(error)};
  }

  fs::path folder_ =
      fs::path{testing::TempDir()} / ("spf_program_" + std::to_string(::getpid()) + "_" +
                                      testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace spf

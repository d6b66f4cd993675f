// Gathers the samples of a recording of people, line by line and of any format, and makes of them what the
// simulator takes: sorted by time, with small numbers for people. Frame: world of the recording, SI.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/input_problem.hpp"
#include "sim/scenario.hpp"

namespace spf {

/// How a recording tells times.
enum class CrowdClock {
  seconds,
  frames,  ///< numbers of frames, of which every so many hold samples
};

class CrowdCollector {
 public:
  static constexpr std::int64_t kLargestId = std::int64_t{1} << 53;
  static constexpr std::size_t kMostSamples = 5'000'000;
  /// Between two samples of a person where only frames are numbered [s]: that of the public recordings.
  static constexpr double kUsualInterval = 0.4;

  CrowdCollector(const std::string& name, InputProblems& problems) : name_{name}, problems_{problems} {}

  /// Counts lines: call it at the beginning of each.
  void next_line() { ++line_; }
  /// Adds a problem of the present line.
  void refuse(const std::string& sentence);
  [[nodiscard]] bool full() const { return problems_.full() || too_many_; }

  /// What messages call the columns.
  void name_columns(std::string time, std::string id) {
    time_name_ = std::move(time);
    id_name_ = std::move(id);
  }
  void set_clock(CrowdClock clock) { clock_ = clock; }
  /// How often people were sampled [1/s], where the recording says it.
  void set_sample_rate(double rate) { sample_rate_ = rate; }

  /// `when` by the clock.
  void add(double when, std::int64_t id, const Eigen::Vector2d& position_world);

  /// The samples; empty when there is a problem. `frame_rate` [1/s] of numbered frames, 0 = unknown.
  [[nodiscard]] std::vector<sim::CrowdSample> finish(double frame_rate);

  // Numbers of the present line; refused, with the column's name, when they are none or out of range.
  [[nodiscard]] bool read(std::string_view column, std::string_view text, const char* unit, double limit,
                          double& value);
  [[nodiscard]] bool read(std::string_view column, std::string_view text, std::int64_t& value);

 private:
  struct Line {
    double when;  // as the file has it
    double time;  // [s]
    std::int64_t id;
    Eigen::Vector2d position_world;
    int line;
  };
  [[nodiscard]] double median_step() const;
  void convert_frames(double frame_rate);
  void check_persons();
  [[nodiscard]] std::vector<sim::CrowdSample> numbered() const;

  const std::string& name_;
  InputProblems& problems_;
  std::string time_name_ = "t_s";
  std::string id_name_ = "agent_id";
  CrowdClock clock_ = CrowdClock::seconds;
  double sample_rate_ = 0.0;  // [1/s]
  int line_ = 0;
  bool too_many_ = false;
  std::vector<Line> lines_;
};

}  // namespace spf

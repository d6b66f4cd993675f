// Writes a made-up replay page, for the browser test and for looking at: spf_sample_replay FILE.html [robots
// [seconds]]
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>

#include "report/replay_page.hpp"
#include "report/test/sample_replay.hpp"

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::cerr << "usage: spf_sample_replay FILE.html [robots [seconds]]\n";
    return 2;
  }
  try {
    spf::SampleReplayRequest request;
    if (argc > 2) request.robots = std::atoi(argv[2]);
    if (argc > 3) request.duration = std::atof(argv[3]);
    std::ofstream file{argv[1], std::ios::binary};
    file << spf::render_replay(spf::sample_replay(request));
    file.close();
    if (!file) {
      std::cerr << "cannot write " << argv[1] << "\n";
      return 1;
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}

// The smallest program outside the project: find_package(spf), one header, one target.
#include <spf/math/angles.hpp>
#include <spf/math/random_stream.hpp>

#include <iostream>

int main() {
  spf::RandomStream random{spf::mix(20240501, 0)};
  for (int robot = 0; robot < 5; ++robot) {
    const double bearing = spf::wrap_angle(2.0 * spf::kPi / 5.0 * robot + random.uniform(-0.1, 0.1));
    std::cout << "robot " << robot << " starts at " << bearing << " rad\n";
  }
  return 0;
}

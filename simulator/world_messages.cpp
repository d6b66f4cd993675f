#include "simulator/world_messages.hpp"

#include <array>
#include <cstdio>

namespace spf::simulator {

std::string contact_text(const sim::Contact& contact) {
  const std::string other = contact.other >= 0 ? " " + std::to_string(contact.other) : "";
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "robot %d touched %s%s at %.2f s, at %.2f m/s (the other at %.2f m/s)", contact.robot,
                enum_name(contact.with), other.c_str(), contact.time, contact.robot_speed,
                contact.other_speed);
  return text.data();
}

}  // namespace spf::simulator

#include "apps/program_test.hpp"

namespace spf {

std::string program_path() {
  return SPF_PROGRAM;
}

}  // namespace spf

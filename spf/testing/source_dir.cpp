#include "spf/testing/source_dir.hpp"

namespace spf {

std::string source_dir() {
  return SPF_SOURCE_DIR;
}

}  // namespace spf

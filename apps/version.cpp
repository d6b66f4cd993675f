#include "apps/version.hpp"

namespace spf {

const char* version() {
  return SPF_VERSION;
}
const char* compiler() {
  return SPF_COMPILER;
}

}  // namespace spf

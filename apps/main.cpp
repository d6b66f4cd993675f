#include "apps/program.hpp"

int main(int argc, char** argv) {
  return spf::run_program(argc, argv);
}

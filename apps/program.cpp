// The spf program: verbs, exit statuses, and error messages.
#include "apps/program.hpp"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <new>
#include <vector>

#include "apps/command.hpp"
#include "apps/version.hpp"
#include "config/input_problem.hpp"
#include "experiments/results_folder.hpp"

namespace spf {
namespace {

int run_verb(int argc, char** argv, const MethodTable& methods) {
  CLI::App program{
      "spf: motion planning for robots in cluttered, dynamic, uncertain surroundings.\n"
      "Simulates scenarios, repeats them over trials, and shows them in a replay page."};
  program.name("spf");
  program.set_version_flag("--version",
                           "spf " + std::string{version()} + " (commit " + kCommit + ", " + compiler() + ")");
  program.require_subcommand(1);
  program.footer(
      "Examples:\n"
      "  spf run scenarios/f7.yaml --out results/f7\n"
      "  spf run scenarios/t2.yaml --trials 50 --noise walk --level 1 --jobs 2\n"
      "  spf experiment table2 --trials 50 --out results/table2\n"
      "  spf report results/table2\n"
      "  spf check scenarios/*.yaml\n"
      "  spf parameters | less\n"
      "Exit status: 0 done, 1 ran but failed what it checks, 2 bad usage or input, 130 interrupted.\n"
      "spf VERB --help explains each verb.");
  program.failure_message(CLI::FailureMessage::simple);
  const std::vector<Verb> verbs{add_run(program, methods),        add_experiment(program, methods),
                                add_report(program, methods),     add_check(program, methods),
                                add_parameters(program, methods), add_crowd(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kBadInput;
  }
  for (const Verb& verb : verbs)
    if (verb.app->parsed()) return verb.run({argv, argv + argc});
  return kBadInput;
}

}  // namespace

int run_program(int argc, char** argv, const MethodTable& methods) {
  try {
    const int status = run_verb(argc, argv, methods);
    std::cout.flush();
    if (std::cout) return status;
    std::cerr << "spf: the results could not be printed: standard output cannot be written\n";
  } catch (const InputError& error) {
    std::cerr << error.what() << "\n";
  } catch (const OutputError& error) {
    std::cerr << error.what() << "\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "spf: not enough memory for this scenario\n";
  } catch (const std::exception& error) {
    std::cerr << "spf: " << error.what() << "\n";
  }
  return kBadInput;
}

}  // namespace spf

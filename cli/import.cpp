#include "cli/import/subcommands.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {

void add_import(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("import", "What others recorded, as a match log: a referee box, hand labels");
  verb->require_subcommand(1);
  add_import_refbox(*verb, exit_code);
  add_import_kicks(*verb, exit_code);
}

}  // namespace trivela::cli

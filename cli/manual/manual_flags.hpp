#pragma once

#include <CLI/CLI.hpp>

namespace trivela::cli {

/// Adds `--man` and `--completion`, which print what `app` and all its verbs say of themselves and end the parsing
/// well. Packages are made with them, so that no verb is missing in a page.
void add_manual_flags(CLI::App& app);

}  // namespace trivela::cli

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace trivela::cli {

/// One flag or argument of a verb, as its help has it.
struct ManualFlag {
  std::vector<std::string> names;    ///< "--half", "-q"; of an argument its name
  std::string value;                 ///< what follows it, such as "TEXT"; empty: nothing
  std::vector<std::string> choices;  ///< the values that there are; empty: any
  std::string description;
};

/// A verb with all that is below it, in the order of its help.
struct ManualVerb {
  std::string path;   ///< "trivela calibrate run"
  std::string name;   ///< "run"
  std::string group;  ///< heading in the help of the verb above
  std::string description;
  std::string footer;
  std::vector<ManualFlag> flags;
  std::vector<ManualFlag> arguments;
  std::vector<ManualVerb> verbs;
};

/// Everything that `app` takes; `above` is the path of what it is a verb of. What help hides is left out.
ManualVerb verb_tree(const CLI::App& app, const std::string& above = "");

/// trivela(1) as roff: every verb with its flags.
std::string man_page(const ManualVerb& program);

/// trivela-nodes(8): the nodes, which all take the same flags, those of `node`.
std::string nodes_man_page(const std::vector<std::string>& nodes, const ManualVerb& node);

/// Text as roff shows it: nothing in it is a request or a font.
std::string roff(const std::string& text);

/// What a shell completes after `program`: verbs, flags, the values of flags that have few; else names of files.
std::string bash_completion(const ManualVerb& program);
std::string zsh_completion(const ManualVerb& program);
std::string fish_completion(const ManualVerb& program);

/// Adds `--man` and `--completion`, which print what `app` and all its verbs say of themselves and end the parsing
/// well. Packages are made with them, so that no verb is missing in a page.
void add_manual_flags(CLI::App& app);

}  // namespace trivela::cli

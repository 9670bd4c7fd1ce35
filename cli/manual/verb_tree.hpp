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

}  // namespace trivela::cli

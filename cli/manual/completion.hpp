#pragma once

#include <string>

#include "cli/manual/verb_tree.hpp"

namespace trivela::cli {

/// What a shell completes after `program`: verbs, flags, the values of flags that have few; else names of files.
std::string bash_completion(const ManualVerb& program);
std::string zsh_completion(const ManualVerb& program);
std::string fish_completion(const ManualVerb& program);

}  // namespace trivela::cli

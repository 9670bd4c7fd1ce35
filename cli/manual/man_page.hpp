#pragma once

#include <string>
#include <vector>

#include "cli/manual/verb_tree.hpp"

namespace trivela::cli {

/// trivela(1) as roff: every verb with its flags.
std::string man_page(const ManualVerb& program);

/// trivela-nodes(8): the nodes, which all take the same flags, those of `node`.
std::string nodes_man_page(const std::vector<std::string>& nodes, const ManualVerb& node);

/// Text as roff shows it: nothing in it is a request or a font.
std::string roff(const std::string& text);

}  // namespace trivela::cli

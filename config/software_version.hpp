#pragma once

#include <string>
#include <string_view>

namespace trivela::config {

/// Of the program: the version, and the commit that it was built from where that is known: "0.1.0-3f2a1b0".
const char* software_version();

/// What `--version` of a program says: its name, the version, and in a second line the folder of the shipped
/// configuration, with what is wrong with it.
std::string version_lines(std::string_view program);

}  // namespace trivela::config

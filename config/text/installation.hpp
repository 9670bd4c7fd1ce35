#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace trivela::config {

/// Of the program: the version, and the commit that it was built from where that is known: "0.1.0-3f2a1b0".
const char* software_version();

/// What `--version` of a program says: its name, the version, and in a second line the folder of the shipped
/// configuration, with what is wrong with it.
std::string version_lines(std::string_view program);

/// The folder of the shipped configuration (default.toml, robots/, scenarios/, arms/, policies/): what the
/// environment's TRIVELA_CONFIG names, or else the first of these that holds default.toml: `config` beside the program,
/// `share/trivela/config` in the prefix that it is installed in, one of the two in a folder above it (the source tree
/// of a build), the same of the `trivela` on the PATH, `of_machine`, where Debian's packages have it. Where none does,
/// that of the prefix, which whoever opens a file of it then finds missing. Of the Python module the module's own place
/// counts, not the interpreter's.
std::filesystem::path folder(const std::filesystem::path& of_machine = "/etc/trivela");

/// Why that folder holds no default.toml, as a clause for a message; empty: it holds one.
std::string trouble_with_folder();

/// A file or folder of it, such as "robots/cambada_1.toml".
inline std::filesystem::path shipped(const std::filesystem::path& name) { return folder() / name; }

}  // namespace trivela::config

#pragma once

#include <filesystem>
#include <string>

namespace trivela::config {

/// The folder of the shipped configuration (default.toml, robots/, scenarios/, arms/, policies/): what the
/// environment's TRIVELA_CONFIG names, or else the first of these that holds default.toml: `config` beside the program,
/// `share/trivela/config` in the prefix that it is installed in, `config` in a folder above it (the source tree of a
/// build). Where none does, that of the prefix, which whoever opens a file of it then finds missing.
std::filesystem::path folder();

/// Why that folder holds no default.toml, as a clause for a message; empty: it holds one.
std::string trouble_with_folder();

/// A file or folder of it, such as "robots/cambada_1.toml".
inline std::filesystem::path shipped(const std::filesystem::path& name) { return folder() / name; }

}  // namespace trivela::config

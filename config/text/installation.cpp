#include "config/text/installation.hpp"

#include <fmt/core.h>

#include <cstdlib>

namespace trivela::config {
namespace {

namespace fs = std::filesystem;

bool holds_settings(const fs::path& folder) {
  std::error_code unreadable;
  return fs::is_regular_file(folder / "default.toml", unreadable);
}

/// What TRIVELA_CONFIG names; empty: nothing.
fs::path named() {
  const char* folder = std::getenv("TRIVELA_CONFIG");
  return folder == nullptr ? "" : folder;
}

}  // namespace

fs::path folder(const fs::path& of_machine) {
  if (!named().empty()) return named();
  std::error_code unknown;
  const fs::path beside = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  fs::path installed = beside.parent_path() / "share/trivela/config";
  if (!holds_settings(beside / "config") && holds_settings(installed)) return installed;
  for (fs::path above = beside; above.has_relative_path(); above = above.parent_path()) {
    if (holds_settings(above / "config")) return above / "config";
  }
  return holds_settings(of_machine) ? of_machine : installed;
}

std::string trouble_with_folder() {
  if (holds_settings(folder())) return "";
  return named().empty()
             ? "the shipped configuration is neither near the program nor installed; TRIVELA_CONFIG may name its folder"
             : "TRIVELA_CONFIG names a folder without default.toml";
}

const char* software_version() { return TRIVELA_VERSION; }

std::string version_lines(std::string_view program) {
  const std::string trouble = trouble_with_folder();
  return fmt::format("{} {}\nconfiguration: {}{}", program, software_version(), folder().string(),
                     trouble.empty() ? "" : fmt::format(" ({})", trouble));
}

}  // namespace trivela::config

#include "config/text/installation.hpp"

#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdlib>
#include <sstream>

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

/// Where this code lies: the program, or a shared library that has it, such as the Python module.
fs::path own_file() {
  std::error_code unknown;
  Dl_info found{};
  if (dladdr(reinterpret_cast<const void*>(&holds_settings), &found) != 0 &&
      fs::path{found.dli_fname}.extension() == ".so")
    return fs::canonical(found.dli_fname, unknown);
  return fs::read_symlink("/proc/self/exe", unknown);
}

/// The settings near a program in this folder: of an installation, or of the sources of a build; empty: none.
fs::path near_to(const fs::path& beside) {
  fs::path installed = beside.parent_path() / "share/trivela/config";
  if (!holds_settings(beside / "config") && holds_settings(installed)) return installed;
  for (fs::path above = beside; above.has_relative_path(); above = above.parent_path()) {
    for (const char* const name : {"config", "share/trivela/config"})
      if (holds_settings(above / name)) return above / name;
  }
  return {};
}

/// The folder of the PATH that has `trivela`; empty: none.
fs::path of_trivela() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders{path == nullptr ? "" : path};
  std::error_code unreadable;
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!fs::path{folder}.is_absolute()) continue;
    if (fs::is_regular_file(fs::path{folder} / "trivela", unreadable)) return fs::canonical(folder, unreadable);
  }
  return {};
}

}  // namespace

fs::path folder(const fs::path& of_machine) {
  if (!named().empty()) return named();
  const fs::path beside = own_file().parent_path();
  for (const fs::path& near : {near_to(beside), near_to(of_trivela())})
    if (!near.empty()) return near;
  return holds_settings(of_machine) ? of_machine : beside.parent_path() / "share/trivela/config";
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

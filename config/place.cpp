#include "config/place.hpp"

#include <cstdlib>

namespace trivela::config {
namespace {

namespace fs = std::filesystem;

bool holds_settings(const fs::path& folder) {
  std::error_code unreadable;
  return fs::is_regular_file(folder / "default.toml", unreadable);
}

}  // namespace

fs::path folder() {
  if (const char* named = std::getenv("TRIVELA_CONFIG"); named != nullptr && *named != '\0') return named;
  std::error_code unknown;
  const fs::path beside = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  fs::path installed = beside.parent_path() / "share/trivela/config";
  if (!holds_settings(beside / "config") && holds_settings(installed)) return installed;
  for (fs::path above = beside; above.has_relative_path(); above = above.parent_path()) {
    if (holds_settings(above / "config")) return above / "config";
  }
  return installed;
}

}  // namespace trivela::config

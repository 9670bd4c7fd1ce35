#include "config/software_version.hpp"

#include <fmt/core.h>

#include "config/place.hpp"

namespace trivela::config {

const char* software_version() { return TRIVELA_VERSION; }

std::string version_lines(std::string_view program) {
  const std::string trouble = trouble_with_folder();
  return fmt::format("{} {}\nconfiguration: {}{}", program, software_version(), folder().string(),
                     trouble.empty() ? "" : fmt::format(" ({})", trouble));
}

}  // namespace trivela::config

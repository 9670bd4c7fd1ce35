#include "config/software_version.hpp"

namespace trivela::config {

const char* software_version() { return TRIVELA_VERSION; }

}  // namespace trivela::config

#pragma once

namespace trivela::config {

/// Of the program: the version, and the commit that it was built from where that is known: "0.1.0-3f2a1b0".
const char* software_version();

}  // namespace trivela::config

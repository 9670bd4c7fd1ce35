#pragma once

#include "cli/verbs.hpp"

namespace trivela::cli {

/// The verbs of trivela-emulate.
AddVerb add_ioboard, add_rekick, add_cia402, add_mti, add_refbox;

}  // namespace trivela::cli

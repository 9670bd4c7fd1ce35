#pragma once

#include <string>

#include "monitor/bus_picture.hpp"

namespace trivela::cli {

/// The bus as tables: topics, then processes. What nobody writes and nobody said is left out but for a line that names
/// it.
std::string top_table(const monitor::BusPicture& picture);

/// The whole picture as one line of JSON; a number that is not known is null.
std::string top_json(const monitor::BusPicture& picture, unsigned domain_id);

}  // namespace trivela::cli

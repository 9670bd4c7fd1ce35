#pragma once

#include <string>

#include "pages/serve/page.hpp"

namespace trivela::pages {

/// The page of `trivela monitor` and `trivela match --watch`: files and events, no command. `token`: needed for
/// everything; empty: for nothing.
Page monitor_page(std::string token = "");

}  // namespace trivela::pages

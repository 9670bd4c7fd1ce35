#include "pages/lob/listen_address.hpp"

#include <fmt/core.h>

#include "cli/verbs.hpp"
#include "pages/lob/same_site.hpp"

namespace trivela::pages {

ListenAddress parse_listen(const std::string& text, int default_port) {
  ListenAddress address{.host = host_of(text), .port = default_port};
  const auto bracket = text.find(']');
  const auto colon = text.find(':', bracket == std::string::npos ? 0 : bracket);
  if (colon == std::string::npos) return address;
  const std::string port = text.substr(colon + 1);
  if (!CLI::detail::lexical_cast(port, address.port) || address.port < 0 || address.port > 65535) {
    throw cli::UsageError{fmt::format("--listen {}: '{}' is no port", text, port)};
  }
  return address;
}

}  // namespace trivela::pages

#include "pages/lob/listen_address.hpp"

#include <fmt/core.h>

#include "config/error.hpp"
#include "config/parse_number.hpp"
#include "pages/lob/same_site.hpp"

namespace trivela::pages {

ListenAddress parse_listen(const std::string& text, int default_port, const std::string& called) {
  ListenAddress address{.host = host_of(text), .port = default_port};
  const auto bracket = text.find(']');
  const auto colon = text.find(':', bracket == std::string::npos ? 0 : bracket);
  if (colon == std::string::npos) return address;
  const std::string port = text.substr(colon + 1);
  const auto number = config::parse_integer(port);
  if (!number || *number < 0 || *number > 65535)
    throw config::BadArgument{fmt::format("{} {}: '{}' is no port", called, text, port)};
  address.port = static_cast<int>(*number);
  return address;
}

}  // namespace trivela::pages

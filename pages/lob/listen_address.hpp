#pragma once

#include <string>

namespace trivela::pages {

/// Where the page is served: an IP address or a host's name, and a port; 0: any free one.
struct ListenAddress {
  std::string host = "127.0.0.1";
  int port = 0;
};

/// "ADDRESS", "ADDRESS:PORT", "[IPV6]:PORT". Throws config::BadArgument naming a port that is none, and the
/// address as `called`.
ListenAddress parse_listen(const std::string& text, int default_port, const std::string& called = "address");

}  // namespace trivela::pages

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

/// The host of a Host header or of an Origin without its scheme, without the port and brackets.
std::string host_of(const std::string& authority);

/// The Host header names this machine in a way that no outsider's name server can: by an IP address, as localhost, or
/// by `own_name`, alone or as own_name.local.
bool names_this_machine(const std::string& host_header, const std::string& own_name);

/// No Origin (not sent by a page of another site), or that of the page itself.
bool same_origin(const std::string& origin_header, const std::string& host_header);

}  // namespace trivela::pages

#include "pages/serve/site.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>

#include "config/text/error.hpp"
#include "config/text/parse_number.hpp"

namespace trivela::pages {
namespace {

std::string lower(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

}  // namespace

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

std::string host_of(const std::string& authority) {
  if (authority.starts_with('[')) return authority.substr(1, authority.find(']') - 1);
  return authority.substr(0, authority.find(':'));
}

bool names_this_machine(const std::string& host_header, const std::string& own_name) {
  const std::string host = lower(host_of(host_header));
  const std::string own = lower(own_name);
  unsigned char address[sizeof(in6_addr)];
  if (inet_pton(AF_INET, host.c_str(), address) == 1 || inet_pton(AF_INET6, host.c_str(), address) == 1) return true;
  return host == "localhost" || host == own || host == own + ".local" || host == own.substr(0, own.find('.'));
}

bool same_origin(const std::string& origin_header, const std::string& host_header) {
  return origin_header.empty() || origin_header == "http://" + host_header;
}

}  // namespace trivela::pages

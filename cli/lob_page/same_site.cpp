#include "cli/lob_page/same_site.hpp"

#include <arpa/inet.h>

namespace trivela::cli::lob_page {

std::string host_of(const std::string& authority) {
  if (authority.starts_with('[')) return authority.substr(1, authority.find(']') - 1);
  return authority.substr(0, authority.find(':'));
}

bool names_this_machine(const std::string& host_header, const std::string& own_name) {
  const std::string host = host_of(host_header);
  unsigned char address[sizeof(in6_addr)];
  if (inet_pton(AF_INET, host.c_str(), address) == 1 || inet_pton(AF_INET6, host.c_str(), address) == 1) return true;
  return host == "localhost" || host == own_name || host == own_name + ".local";
}

bool same_origin(const std::string& origin_header, const std::string& host_header) {
  return origin_header.empty() || origin_header == "http://" + host_header;
}

}  // namespace trivela::cli::lob_page

#include "pages/lob/same_site.hpp"

#include <arpa/inet.h>

namespace trivela::pages {
namespace {

std::string lower(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

}  // namespace

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

#include "pages/serve/site.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>

#include <algorithm>
#include <fstream>

#include "config/text/error.hpp"
#include "config/text/parse_number.hpp"
#include "log/schema/digest.hpp"

namespace trivela::pages {
namespace {

std::string lower(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

constexpr std::size_t kShortestToken = 16;
constexpr std::size_t kLongestToken = 128;

bool may_be_in_a_token(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
}

/// The host of a Host header or of an Origin without its scheme, without the port and brackets.
std::string host_of(const std::string& authority) {
  if (authority.starts_with('[')) return authority.substr(1, authority.find(']') - 1);
  return authority.substr(0, authority.find(':'));
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

std::string draw_token() {
  std::string token = log::make_uuid();
  std::erase(token, '-');
  return token;
}

std::string token_of_file(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::ifstream in(file);
  std::string token;
  if (!std::getline(in, token))
    throw config::BadArgument{fmt::format("{}: no token can be read from it", file.string())};
  if ((fs::status(file).permissions() & (fs::perms::group_all | fs::perms::others_all)) != fs::perms::none)
    throw config::BadArgument{fmt::format("{}: somebody else than its owner may read it: chmod 600", file.string())};
  if (token.size() < kShortestToken || token.size() > kLongestToken || !std::ranges::all_of(token, may_be_in_a_token))
    throw config::BadArgument{fmt::format("{}: a token is a line of {} to {} letters, digits, '-' and '_'",
                                          file.string(), kShortestToken, kLongestToken)};
  return token;
}

bool same_token(const std::string& given, const std::string& token) {
  unsigned char different = given.size() == token.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i)
    different |= static_cast<unsigned char>(token[i] ^ (i < given.size() ? given[i] : '\0'));
  return different == 0;
}

std::string cookie_of(const std::string& header, const std::string& name) {
  for (std::size_t begin = 0; begin < header.size();) {
    begin = header.find_first_not_of("; ", begin);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(header.find(';', begin), header.size());
    const std::string pair = header.substr(begin, end - begin);
    if (pair.starts_with(name + "=")) return pair.substr(name.size() + 1);
    begin = end;
  }
  return {};
}

}  // namespace trivela::pages

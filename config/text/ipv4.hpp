#pragma once

#include <arpa/inet.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trivela::config {

/// An IPv4 address in the order of its digits, 172.16.0.1 = 0xAC100001; none: the text is none.
inline std::optional<std::uint32_t> ipv4(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return ntohl(address.s_addr);
}

/// The addresses of one network, written 172.16.39.0/24.
struct Network {
  std::uint32_t first = 0;
  std::uint32_t mask = 0;

  bool contains(std::uint32_t address) const { return (address & mask) == first; }
  /// One that a machine may have: neither the network's own nor its broadcast.
  bool has_machine(std::uint32_t address) const {
    return contains(address) && address != first && address != (first | ~mask);
  }
};

/// None: the text is no network of 1 to 30 bits, or has bits beyond them.
inline std::optional<Network> network(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto first = ipv4(std::string{text.substr(0, slash)});
  unsigned bits = 0;
  const auto read = std::from_chars(text.data() + slash + 1, text.data() + text.size(), bits);
  if (!first || read.ec != std::errc{} || read.ptr != text.data() + text.size() || bits < 1 || bits > 30)
    return std::nullopt;
  const Network all{*first, ~std::uint32_t{0} << (32 - bits)};
  return all.contains(*first) ? std::optional{all} : std::nullopt;
}

}  // namespace trivela::config

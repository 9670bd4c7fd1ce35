#include "hal/open_range_finder.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "hal/scip/line.hpp"
#include "hal/scip/scip_range_finder.hpp"

namespace trivela::hal {
namespace {

constexpr std::string_view kTcp = "tcp://";

[[noreturn]] void malformed(const std::string& address) {
  throw std::runtime_error{fmt::format(
      "range finder '{}': an address is tcp://HOST:PORT (Hokuyo's port is 10940) or the path of a device", address)};
}

// "HOST:PORT"; an IPv6 address stands in brackets.
std::pair<std::string, std::uint16_t> split(std::string_view text, const std::string& address) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) malformed(address);
  const std::string_view digits = text.substr(colon + 1);
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc{} || end != digits.data() + digits.size() || port == 0) malformed(address);
  std::string_view host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    malformed(address);
  }
  if (host.empty() || host.find_first_of("/[] ") != std::string_view::npos) malformed(address);
  return {std::string{host}, port};
}

}  // namespace

std::unique_ptr<RangeFinder> open_range_finder(const std::string& address) {
  std::unique_ptr<scip::Line> line;
  if (address.starts_with(kTcp)) {
    const auto [host, port] = split(std::string_view{address}.substr(kTcp.size()), address);
    line = scip::tcp_line(host, port);
  } else if (!address.empty() && address.find("://") == std::string::npos) {
    line = scip::serial_line(address);
  } else {
    malformed(address);
  }
  return std::make_unique<scip::ScipRangeFinder>(std::move(line));
}

}  // namespace trivela::hal

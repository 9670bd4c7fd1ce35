#include "config/devices.hpp"

#include <charconv>

namespace trivela::config {
namespace {

constexpr std::string_view kTcp = "tcp://";

/// "HOST:PORT"; an IPv6 address stands in brackets.
bool split(std::string_view text, ScipDevice& scanner) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return false;
  const std::string_view digits = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), scanner.port);
  if (error != std::errc{} || end != digits.data() + digits.size() || scanner.port == 0) return false;
  std::string_view host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return false;
  }
  scanner.host = host;
  return !host.empty() && host.find_first_of("/[] ") == std::string_view::npos;
}

}  // namespace

template <>
std::optional<ScipDevice> backend_of(std::string_view text) {
  ScipDevice scanner{.address = std::string{text}, .host = {}, .port = 0};
  const bool known = text.starts_with(kTcp) ? split(text.substr(kTcp.size()), scanner)
                                            : !text.empty() && text.find("://") == std::string_view::npos;
  return known ? std::optional{std::move(scanner)} : std::nullopt;
}

}  // namespace trivela::config

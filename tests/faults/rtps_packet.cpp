#include "tests/faults/rtps_packet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

namespace trivela::faults {
namespace {

constexpr std::size_t kSubmessageHeader = 4;
constexpr std::uint8_t kLittleEndian = 0x01;
constexpr std::uint8_t kBuiltin = 0xc0;  // the two upper bits of an entity kind

constexpr std::array<std::pair<std::uint8_t, const char*>, 13> kNames{{{0x01, "PAD"},
                                                                       {0x06, "ACKNACK"},
                                                                       {0x07, "HEARTBEAT"},
                                                                       {0x08, "GAP"},
                                                                       {0x09, "INFO_TS"},
                                                                       {0x0c, "INFO_SRC"},
                                                                       {0x0d, "INFO_REPLY_IP4"},
                                                                       {0x0e, "INFO_DST"},
                                                                       {0x0f, "INFO_REPLY"},
                                                                       {0x12, "NACK_FRAG"},
                                                                       {0x13, "HEARTBEAT_FRAG"},
                                                                       {0x15, "DATA"},
                                                                       {0x16, "DATA_FRAG"}}};

/// Where the writer's entity id begins behind the submessage's header.
std::optional<std::size_t> writer_id_offset(std::uint8_t id) {
  switch (id) {
    case 0x06:
    case 0x07:
    case 0x08:
    case 0x12:
    case 0x13:
      return 4;
    case 0x15:
    case 0x16:
      return 8;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::vector<Submessage> submessages_of(std::span<const std::uint8_t> packet) {
  std::vector<Submessage> found;
  if (packet.size() < kRtpsHeader || std::memcmp(packet.data(), "RTPS", 4) != 0) return found;
  for (std::size_t at = kRtpsHeader; at + kSubmessageHeader <= packet.size();) {
    const auto* header = packet.data() + at;
    const bool little = (header[1] & kLittleEndian) != 0;
    const std::size_t length = little ? header[2] + 256u * header[3] : header[3] + 256u * header[2];
    // Length 0: it goes on to the end of the packet.
    const std::size_t end = length == 0 ? packet.size() : std::min(packet.size(), at + kSubmessageHeader + length);
    Submessage part{.id = header[0], .begin = at, .end = end, .discovery = false};
    if (const auto offset = writer_id_offset(part.id); offset && at + kSubmessageHeader + *offset + 4 <= end)
      part.discovery = (header[kSubmessageHeader + *offset + 3] & kBuiltin) == kBuiltin;
    found.push_back(part);
    at = end;
  }
  return found;
}

std::string name_of_submessage(std::uint8_t id) {
  const auto* known = std::find_if(kNames.begin(), kNames.end(), [&](const auto& name) { return name.first == id; });
  return known != kNames.end() ? known->second : fmt::format("{:#04x}", id);
}

std::uint8_t submessage_named(const std::string& name) {
  const auto* known = std::find_if(kNames.begin(), kNames.end(), [&](const auto& n) { return n.second == name; });
  if (known == kNames.end()) throw std::invalid_argument{fmt::format("no submessage is called {}", name)};
  return known->first;
}

}  // namespace trivela::faults

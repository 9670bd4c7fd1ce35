#include "tests/faults/air_meter.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tests/faults/frame.hpp"
#include "tests/faults/rtps_packet.hpp"

namespace trivela::faults {
namespace {

constexpr std::uint8_t kData = 0x15, kEncrypted = 0x33;  // SRTPS_PREFIX: the whole message is encrypted
constexpr double kEthernetHeader = 14;
constexpr std::size_t kLongestReferee = 132;  // of the data's submessage: referee has 60 bytes of data, team_state 200

// Nothing of an encrypted message is known but its length, and those of the two topics have one each.
constexpr std::size_t kEncryptedState = 336, kEncryptedReferee = 236;

AirKind kind_of_encrypted(std::size_t message_size) {
  if (message_size == kEncryptedState) return AirKind::kTeamState;
  return message_size == kEncryptedReferee ? AirKind::kReferee : AirKind::kAcknowledgement;
}

AirKind kind_of(std::span<std::uint8_t> frame) {
  const auto message = udp_payload(frame);
  const auto parts = submessages_of(message);
  if (parts.empty()) return AirKind::kOther;
  if (parts.front().id == kEncrypted) return kind_of_encrypted(message.size());
  if (std::ranges::any_of(parts, &Submessage::discovery)) return AirKind::kDiscovery;
  for (const Submessage& part : parts)
    if (part.id == kData) return part.end - part.begin > kLongestReferee ? AirKind::kTeamState : AirKind::kReferee;
  return AirKind::kAcknowledgement;
}

}  // namespace

void AirMeter::count(std::span<std::uint8_t> frame) {
  Count& kind = counts[static_cast<std::size_t>(kind_of(frame))];
  ++kind.frames;
  kind.bytes += static_cast<double>(frame.size()) - kEthernetHeader;
  longest = std::max(longest, frame.size());
}

double AirMeter::bytes() const {
  double sum = 0;
  for (const Count& count : counts) sum += count.bytes;
  return sum;
}

double AirMeter::frames() const {
  double sum = 0;
  for (const Count& count : counts) sum += count.frames;
  return sum;
}

double AirMeter::ethernet_bytes() const { return bytes() + frames() * kEthernetHeader; }

AirMeter AirMeter::operator-(const AirMeter& before) const {
  AirMeter rest = *this;
  for (std::size_t kind = 0; kind < kAirKinds; ++kind) {
    rest.counts[kind].frames -= before.counts[kind].frames;
    rest.counts[kind].bytes -= before.counts[kind].bytes;
  }
  return rest;
}

std::string air_table(const AirMeter& meter, double length_s) {
  constexpr std::array<const char*, kAirKinds> kNames{"team_state", "referee", "acknowledgements", "discovery",
                                                      "ARP, IGMP"};
  std::string text = fmt::format("{:<18}{:>10}{:>10}\n", "topic", "frames/s", "kbit/s");
  const auto line = [&](const char* name, double frames, double bytes) {
    text += fmt::format("{:<18}{:>10.1f}{:>10.1f}\n", name, frames / length_s, bytes * 8e-3 / length_s);
  };
  for (std::size_t kind = 0; kind < kAirKinds; ++kind)
    line(kNames[kind], meter.counts[kind].frames, meter.counts[kind].bytes);
  line("sum", meter.frames(), meter.bytes());
  line("with Ethernet", meter.frames(), meter.ethernet_bytes());
  return text;
}

}  // namespace trivela::faults

#include "tests/faults/forged_orders.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace trivela::faults {
namespace {

constexpr std::int64_t kOnTheWay_ns = 1'000'000'000;

}  // namespace

bool forged_by_the_wire(const Finding& finding, const std::vector<GarbledFrame>& garbled) {
  if (finding.offence != Offence::kNoOrder) return false;
  std::array<std::uint8_t, sizeof finding.fire.kick_id> id{};
  std::memcpy(id.data(), &finding.fire.kick_id, id.size());
  return std::any_of(garbled.begin(), garbled.end(), [&](const GarbledFrame& frame) {
    const std::int64_t before_ns = finding.fire.arrival_ns - frame.arrival_ns;
    return before_ns >= 0 && before_ns <= kOnTheWay_ns &&
           std::search(frame.bytes.begin(), frame.bytes.end(), id.begin(), id.end()) != frame.bytes.end();
  });
}

std::vector<Finding> take_forged(std::vector<Finding>& findings, const std::vector<GarbledFrame>& garbled) {
  const auto forged = std::stable_partition(
      findings.begin(), findings.end(), [&](const Finding& finding) { return !forged_by_the_wire(finding, garbled); });
  std::vector<Finding> taken{forged, findings.end()};
  findings.erase(forged, findings.end());
  return taken;
}

}  // namespace trivela::faults

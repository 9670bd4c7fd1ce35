#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>

#include "bus/reader.hpp"
#include "idl/messages.hpp"
#include "tests/faults/network_host.hpp"

namespace trivela::faults {

/// Hears on a robot's own bus what its simulator says was kicked, beside recorders and their logs.
class KickWitness {
 public:
  /// `robot`: 1 to 9. A member of the robots' domain with this tag, on this host.
  KickWitness(const NetworkHost& host, std::uint32_t robot, const std::string& tag);

  /// Every kick_id since its making.
  const std::set<std::int64_t>& kicks();

 private:
  std::unique_ptr<bus::Reader<msg::KickTruth>> truths_;
  std::set<std::int64_t> kicks_;
};

}  // namespace trivela::faults

#pragma once

#include <memory>
#include <vector>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::hal {

inline constexpr std::chrono::seconds kPlenty{10};
inline constexpr std::uint8_t kRobot = 3;

/// A bridge's end of a device's two topics, over sockets as from another process.
template <class Sample, class Command>
struct BusWorld {
  bus::WirePair domains = bus::fresh_wire_pair();
  bus::Participant there{domains.a};
  bus::Participant here{domains.b};
  bus::Writer<Sample> samples{there};
  bus::Reader<Command> commands{there, {.period = {}, .keep_all = true, .on_liveliness = {}}};

  /// The next n commands that arrive, fewer if they do not come.
  std::vector<Command> received(std::size_t n) {
    std::vector<Command> got;
    while (got.size() < n && commands.wait(kPlenty)) {
      commands.take([&](const Command& command) { got.push_back(command); });
    }
    return got;
  }
};

}  // namespace trivela::hal

// Prints what the robots decide, cycle by cycle: listen_to_decisions [DOMAIN [TAG]], those of config/default.toml.
#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "bus/reader.hpp"
#include "idl/messages.hpp"

namespace bus = trivela::bus;
namespace msg = trivela::msg;

int main(int argc, char** argv) {
  const auto domain = static_cast<std::uint32_t>(argc > 1 ? std::stoul(argv[1]) : 42);
  const bus::Participant participant{bus::loopback(domain, argc > 2 ? argv[2] : "trivela")};
  bus::Reader<msg::KickDecision> decisions{participant};
  const auto print = [](const msg::KickDecision& decision) {
    fmt::print("robot {}, {:.2f} s, {}: {} ({}), power {:.2f}, {:.2f} m\n", decision.robot_id,
               1e-9 * static_cast<double>(decision.t_ns), msg::policy_name(decision), decision.fire ? "fire" : "hold",
               msg::label(decision.reason), decision.power, decision.distance_m);
  };
  while (decisions.wait(std::chrono::minutes{5})) {  // Ctrl-C ends it before
    decisions.take(print);
    std::fflush(stdout);
  }
}

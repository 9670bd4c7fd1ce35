#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/faults/hub.hpp"

namespace trivela::faults {

/// The nodes under test, in the order in which they are started. The referee is fault_referee, on links alone.
inline constexpr std::array<std::string_view, 8> kNodes{
    "recorder", "odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer", "referee", "simulator"};

/// Place of a node in kNodes.
std::size_t node_index(std::string_view name);

/// Who has something to say to whom, by place in kNodes.
std::vector<std::pair<std::size_t, std::size_t>> links();

enum class FaultKind {
  kKill,     ///< SIGKILL, and started again after a while
  kStop,     ///< SIGSTOP, and SIGCONT after a while
  kRestart,  ///< SIGTERM, and started again
  kTwin,     ///< a second one is started: it must refuse
  kSilence,  ///< of the referee: it is there and says nothing
  kDelay,    ///< frames come late and overtake each other
  kCut,      ///< no frame comes through
  kGarble,   ///< bits are turned over
};

const char* name(FaultKind kind);
bool on_link(FaultKind kind);

/// Who orders beside kick_decision, all the while and with more strength.
enum class Insists { kNobody, kInItsName, kUnauthorised };

/// One thing that goes wrong.
struct Fault {
  FaultKind kind = FaultKind::kKill;
  std::size_t node = 0;              ///< by place in kNodes
  std::optional<std::size_t> other;  ///< of a link: its other end; none: everything that the node says and hears
  double waits_s = 0.0;              ///< from the whole chain to the fault, so that it comes anywhere in a kick
  double lasts_s = 0.0;
  Insists insists = Insists::kNobody;  ///< what fault_client does from before the fault on; unauthorised to its end
  Way way;                             ///< what a link does meanwhile
};

/// "cut kick_decision-kicker_driver 0.42 s".
std::string text(const Fault& fault);

/// `count` faults: each kind as often as the others, each node or link of a kind as often as the others of it, all in
/// an order that is the seed's. Without `with_links` the kinds that need one are left out.
std::vector<Fault> draw_faults(std::size_t count, std::uint64_t seed, bool with_links);

/// Each node in turn is stopped for 0.5 to 2 s, `rounds` times.
std::vector<Fault> draw_stalls(std::size_t rounds, std::uint64_t seed);

/// The referee is killed, deleted, paused, silent and cut off - from all, from the driver, from the world's model - for
/// 1.5 to 4 s while it lets play, `rounds` times.
std::vector<Fault> draw_referee_losses(std::size_t rounds, std::uint64_t seed);

}  // namespace trivela::faults

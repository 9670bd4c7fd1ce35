#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "emulators/refbox/box_act.hpp"
#include "hal/refbox/words.hpp"

namespace trivela::hal::refbox {

/// What an emulated box is.
struct BoxConfig {
  std::uint16_t port = 0;   ///< 0: any
  bool on_network = false;  ///< listens on every interface, not on the loopback alone
  Protocol protocol = Protocol::kJson;
  /// Multicast groups of the left and the right team.
  std::array<std::string, 2> groups{"224.16.32.39", "224.16.32.63"};
};

/// What a team has sent.
struct TeamReport {
  bool connected = false;
  std::uint64_t objects = 0;   ///< those of type "worldstate" as the league wants them
  std::uint64_t problems = 0;  ///< others
  std::string last;            ///< the last object
  std::string last_problem;    ///< a clause; empty: there was none
  double rate_hz = 0.0;        ///< of the objects, over the time between the first and the last one; 0: fewer than two
};

/// The referee box of a match, in a thread of its own, as RoboCup-MSL/RefBox is (mslrb2015/{Comms,Team}.pde): what it
/// says goes to every client, objects with a targetTeam. A client is of the team whose group ends in N when the third
/// number of its address is N (172.16.N.*, here 127.0.N.*, too), of the first free one otherwise, and gets WELCOME,
/// with "emulated":true in the JSON protocol (the one of letters has no place for it); one whose team is there already,
/// or for whom there is no place, gets RESET and is closed. For any thread.
class EmulatedBox {
 public:
  /// Throws std::runtime_error naming the port where it cannot be had.
  explicit EmulatedBox(const BoxConfig& config);
  ~EmulatedBox();
  EmulatedBox(const EmulatedBox&) = delete;
  EmulatedBox& operator=(const EmulatedBox&) = delete;

  std::uint16_t port() const;

  /// Says a command, or does what a real box does to its clients.
  void act(const BoxAct& act);

  /// Sends bytes as they are to every client.
  void send(std::string_view bytes);

  TeamReport report(std::size_t team) const;

  /// Waits until so many teams are connected; false: not in time.
  bool wait_for_teams(std::size_t n, std::chrono::nanoseconds timeout) const;
  /// The same for a team's objects of type "worldstate".
  bool wait_for_objects(std::size_t team, std::uint64_t n, std::chrono::nanoseconds timeout) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What the league's box would not log of an object, as a clause; none: it is fine (mslrb2015/Comms.pde).
std::optional<std::string> worldstate_problem(std::string_view object);

/// A command as the box writes it on the wire, with its NUL; by letters, with none. Empty: the old protocol has no word
/// for it.
std::string wire_text(const BoxCommand& said, const BoxConfig& config);

}  // namespace trivela::hal::refbox

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/program.hpp"
#include "tests/faults/device_rounds.hpp"
#include "tests/faults/kicker_timeline.hpp"
#include "tests/support/folder.hpp"

namespace trivela::faults {

/// The kicker's driver and the recorder as they run, on a bus of their own, with a troubled board at the driver's line.
/// This is the decision node: it says `drive`, and orders each 50 ms at the latest, every other order one that nobody
/// may fire. Where `referees` it is the referee, too.
class KickerRig {
 public:
  /// Throws std::runtime_error where they do not start, with what they said.
  KickerRig(std::unique_ptr<TroubledBoard> board, config::Settings settings, bool referees);

  /// Lets the match go on until then, or `done`; where the machine stands still, for so much longer.
  void play(
      std::int64_t until_ns, const std::function<bool()>& done = [] { return false; });

  /// What the referee says from now on.
  void let_play(bool playing) { playing_ = playing; }

  /// Somebody with more strength than the decision node, who alone is heard meanwhile.
  void unauthorised_orders();

  /// Something befalls board or driver for so long, after which all is well again.
  void suffer(Trouble what, std::int64_t for_ns);

  /// Whether a lawful order is fired within `within_ns`.
  bool fires(std::int64_t within_ns = kRecovery_ns);

  /// Ends driver and recorder by SIGTERM. Gives what was wrong with that; empty: nothing.
  std::string end();

  TroubledBoard& board() { return *board_; }
  const bus::Participant& participant() const { return participant_; }
  const tests::Folder& folder() const { return folder_; }
  std::filesystem::path log() const { return folder_ / "match.db"; }
  std::string driver_errors() const { return driver_->errors(); }

  /// All that happened, with the pulses so far.
  const KickerTimeline& timeline() {
    timeline_.pulses = board_->pulses();
    return timeline_;
  }
  /// The game is on, or stands, by somebody else's word.
  void note_word(std::int64_t t_ns, bool playing) { timeline_.playing[t_ns] = playing; }

 private:
  void start_driver();
  void say();
  void order();
  void write_order(bus::Writer<msg::KickOrder>& writer, OrderKind kind, std::int64_t ahead_ns = 0);
  void signal_amid_a_kick(int signal);

  std::unique_ptr<TroubledBoard> board_;
  tests::Folder folder_;
  config::Settings settings_;
  bus::Participant participant_;
  std::optional<bus::Writer<msg::Referee>> referee_;
  bus::Writer<msg::DriveCommand> drive_;
  bus::Writer<msg::KickOrder> decision_;
  std::optional<e2e::Program> recorder_, driver_;
  std::mt19937_64 random_ = device_draws();
  KickerTimeline timeline_;
  std::uint64_t ids_ = 0, words_ = 0;
  bool playing_ = true;
};

}  // namespace trivela::faults

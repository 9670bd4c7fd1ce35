#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::log {

/// How the configuration of an imported session begins; sentences on what was imported follow up to an empty line.
inline constexpr std::string_view kImportMark = "### import\n";

/// The policy in charge of a robot's kicks in one half: "stopped", "moving" or a test drive such as "turn_drive".
struct HalfPolicy {
  int half = 1;  ///< 1, 2
  std::string policy;
  int robot_id = 0;  ///< 0: every robot that has no entry of its own
};

/// How many orders a kicker's driver had handled and refused where a session ends.
struct DriverCount {
  int robot_id = 0;
  std::int64_t orders_handled = 0;
  std::int64_t orders_refused = 0;
};

/// The world of a simulated match.
struct Simulation {
  std::optional<std::int64_t> seed;
  std::string scenario;               ///< its name
  bool paired_halves = false;         ///< halves with the same possessions
  std::optional<double> planned_s{};  ///< of the whole match
};

/// What a recording says about itself; becomes the row of table `sessions`.
struct Session {
  std::string uuid;                     ///< version 4; empty: the writer makes one
  std::optional<int> robot_id;          ///< robot that records; none: several
  std::int64_t started_t_ns = 0;        ///< start of the recording, in the session's clock
  bool simulated_clock = false;         ///< t_ns come from the simulator, otherwise from the steady clock
  std::int64_t realtime_offset_ns = 0;  ///< UTC since 1970 minus the session's clock
  std::string config_toml;              ///< whole configuration as used; the writer adds its SHA-256
  std::optional<std::int64_t> seed;     ///< of the simulation
  std::string software_version;
  std::string scenario;                          ///< name of the scenario or of the match
  bool simulated = false;                        ///< a simulated match
  std::string idl;                               ///< text of the messages' definition
  std::vector<HalfPolicy> policies;              ///< none where it is drawn at random
  std::optional<std::string> arm{};              ///< of an experiment
  std::optional<std::string> kicker_table{};     ///< of the arm: "new" or "old"
  std::optional<std::int64_t> match_id{};        ///< where it is the same, possessions are the same situations
  std::string continues_uuid{};                  ///< session that this one goes on from; empty: none
  std::string replays_uuid{};                    ///< session whose samples are played again; empty: none
  bool paired_halves = false;                    ///< simulated halves with the same possessions
  std::optional<double> planned_s{};             ///< of the whole recording, by its clock
  std::optional<std::int64_t> calibration_id{};  ///< of the experiment: the calibration whose robots played
  std::vector<DriverCount> continued{};          ///< where that one ends, by robot
};

enum class LossKind {
  kLost,        ///< the bus reported lost samples
  kGaps,        ///< sequence numbers that never arrived
  kOverflow,    ///< the log's queue was full
  kNanRefused,  ///< NaN, infinity or NULL where a number must be
  kRejected,    ///< against the schema: unknown label, wrong type, same key twice
  kOutOfOrder   ///< older than its predecessor; nothing is missing
};

/// Counters of one stream; row of table `losses`.
struct Loss {
  std::string stream;  ///< name of the table that the samples were for
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t gaps = 0;
  std::int64_t overflow = 0;
  std::int64_t nan_refused = 0;
  std::int64_t rejected = 0;
  std::int64_t out_of_order = 0;

  /// Samples that are not in the log. What the bus reports as lost shows as a gap too, so the larger of the two counts.
  std::int64_t missing() const { return (lost > gaps ? lost : gaps) + overflow + nan_refused + rejected; }

  Loss& operator+=(const Loss& other);
};

/// Its counters in the order of LossKind.
inline constexpr std::array kLossCounters{&Loss::lost,        &Loss::gaps,     &Loss::overflow,
                                          &Loss::nan_refused, &Loss::rejected, &Loss::out_of_order};
static_assert(kLossCounters.size() == static_cast<std::size_t>(LossKind::kOutOfOrder) + 1);

inline Loss& Loss::operator+=(const Loss& other) {
  received += other.received;
  for (const auto counter : kLossCounters) this->*counter += other.*counter;
  return *this;
}

/// A stream of one robot that said nothing for too long; row of table `losses` with counters of 0.
struct Silence {
  std::string stream;  ///< name of the table that the samples are for
  int robot_id = 0;
  std::int64_t from_t_ns = 0;             ///< last sample before it
  std::optional<std::int64_t> to_t_ns{};  ///< first sample after it; none: it lasts
};

}  // namespace trivela::log

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluator/compare/log_differences.hpp"
#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/drift_report/log_drift.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "evaluator/table2/table2.hpp"
#include "evaluator/timeline/decided_again.hpp"
#include "evaluator/timeline/kick_timeline.hpp"

namespace trivela::evaluator::page {

/// Above so many kicks figures show bins, and there is no list of them.
inline constexpr std::size_t kMostKicks = 5000;
/// Above so many the list has no replays, which would make the file too large to open at ease.
inline constexpr std::size_t kMostReplays = 1000;

/// A log that the page is made of.
struct PageLog {
  std::string name;    ///< of the file, without its folder
  std::string sha256;  ///< of the file
};

/// A kick, and which log it is from.
struct PageKick {
  std::size_t log = 0;
  KickTimeline timeline;
};

/// A possession in which nobody kicked, where the robot last held.
struct HeldChance {
  std::string policy;
  double x_m = 0.0, y_m = 0.0;  ///< of the robot, in F
  bool shadow_would = false;    ///< a policy that rides along would have kicked
  /// The most that such a policy predicted for its kick when it would have kicked; none: it predicts nothing.
  std::optional<double> p_on_target{};
};

/// What a policy that rides along would have done while the one in charge held.
struct WouldKick {
  std::int64_t cycles = 0;   ///< in which it would have kicked
  std::int64_t chances = 0;  ///< possessions with such a cycle
};

/// Why a policy held.
struct HeldReason {
  std::string policy;
  std::string reason;
  std::int64_t cycles = 0;
  std::int64_t chances = 0;                ///< possessions with such a cycle
  std::map<std::string, WouldKick> would;  ///< by the shadow's policy, of those that would have kicked at all
};

/// What was predicted of a kick by the physical model, and what came.
struct PredictedChance {
  double p = 0.0;
  bool came = false;
};

/// What a robot measured of another participant's clock.
struct ClockRow {
  int robot_id = 0, other_robot_id = 0;
  std::int64_t measurements = 0;
  double least_ms = 0.0, most_ms = 0.0;  ///< the other's clock minus this one
  double error_ms = 0.0;                 ///< of the best measurement
};

/// How a session came to the axis of time of a merged log.
struct AlignedClock {
  std::string uuid;
  double error_ms = 0.0;  ///< the largest
  std::string reference_uuid;
};

/// What is not the same in two logs, one recorded after the other.
struct LogChange {
  std::size_t before = 0, after = 0;  ///< places among the logs
  std::vector<LogDifference> differences;
};

/// Everything that a page shows besides its report. What could not be read is empty, and `failures` says why.
struct PageData {
  std::vector<PageLog> logs;
  std::vector<PageKick> kicks;                        ///< by UTC
  std::map<std::string, std::int64_t> opportunities;  ///< by policy; empty: nobody counted them
  std::optional<PolicyComparison> comparison;         ///< none: `no_comparison` says why
  std::string no_comparison;
  std::vector<HeldReason> held;
  std::vector<HeldChance> held_chances;
  std::vector<std::string> shadows;              ///< policies that rode along
  std::vector<PredictedChance> predictions;      ///< of balls on target
  std::vector<PredictedChance> predicted_goals;  ///< past a tracked keeper, where it is known what came
  DriftReport drift;
  std::vector<LogChange> changes;   ///< one less than there are logs
  std::vector<DecidedAgain> again;  ///< replays, where what they replay is among the logs
  std::vector<ClockRow> clocks;
  std::vector<AlignedClock> aligned;
  std::vector<std::string> failures;

  bool binned() const { return kicks.size() > kMostKicks; }
};

/// Told before each part that is read: how many of all are done, and what comes.
using PageProgress = std::function<void(std::size_t done, std::size_t parts, const std::string& what)>;

/// Reads what a page needs of the logs, each stream once. A stream that cannot be read is a sentence in `failures`.
/// Throws std::runtime_error where a file cannot be opened as a log.
PageData read_page_data(const std::vector<std::filesystem::path>& logs, const PageProgress& progress = {});

/// What sections are made of.
struct PageView {
  const Report& report;
  const PageData& data;
  bool simulated = false;  ///< some of it
};

// Each section of the page below its title, as HTML. One whose stream is missing says so in a sentence.

/// The verdict on the policies, the design behind it and its caveat.
std::string verdict_section(const PageView& view);
/// Table 2, why the misses missed, and robots where there are several.
std::string table2_section(const PageView& view);
/// Efficiency of policies, robots and distance bands with intervals.
std::string forest_section(const PageView& view);
/// The goal mouth with every observed crossing and its uncertainty.
std::string goal_mouth_section(const PageView& view);
/// Where kicks were taken and where chances were held.
std::string pitch_section(const PageView& view);
/// Chances, kicks and shots on target a minute.
std::string rates_section(const PageView& view);
/// Height by set-point against its prediction, and probabilities against outcomes.
std::string prediction_section(const PageView& view);
/// By robot: whether its kicker changed, at which kick, by how much, and what to do.
std::string drift_section(const PageView& view);
/// What kicks have shown of each robot's kicker, kick by kick, and whether it may be believed.
std::string learning_section(const PageView& view);
/// What differs between each log and the one before it.
std::string changes_section(const PageView& view);
/// What a replay ordered, beside what was ordered.
std::string decided_again_section(const PageView& view);
/// Why policies held, and what those that ride along would have done.
std::string held_section(const PageView& view);
/// The list of kicks, filtered and replayed by page.js.
std::string kick_list_section(const PageView& view);
/// What is missing, doubtful or unknown, clocks, versions and hashes.
std::string quality_section(const PageView& view);

/// Place of a policy in Table 2: the number of its colour.
std::size_t colour_of(const PageView& view, const std::string& policy);

/// "2026-11-24 08:47:31.12" in UTC; "+73.20 s" of the session's clock where that is a simulator's.
std::string instant_text(const KickTimeline& timeline);

/// "2, 3:04.5": half, minutes and seconds since its first start of play; "2" where nobody said the time.
std::string match_time_text(const KickTimeline& timeline);

/// The page as one HTML file that asks for nothing from anywhere: its content-security policy allows its own script and
/// style by their hashes and no request. The same text for the same data.
std::string to_html(const Report& report, const PageData& data);

/// The same of logs that `report` was made of. Throws std::runtime_error where one cannot be read at all.
std::string report_page(const Report& report, const std::vector<std::filesystem::path>& logs,
                        const PageProgress& progress = {});

}  // namespace trivela::evaluator::page

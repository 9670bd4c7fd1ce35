#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluator/page/page_data.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "evaluator/table2/table2.hpp"
#include "evaluator/timeline/kick_timeline.hpp"

namespace trivela::evaluator::page {

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

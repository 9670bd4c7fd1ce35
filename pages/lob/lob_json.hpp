#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "kicking/lob/analyzer.hpp"
#include "log/write/scan_log.hpp"
#include "pages/lob/lob_session.hpp"

namespace trivela::pages {

/// What the page must know before it draws a scan. `mode`: "live" or "replay"; `file`: of the record.
nlohmann::json setup_json(const std::string& mode, const std::string& file, const log::ScanSession& session,
                          const kicking::lob::AnalyzerConfig& config);

/// One lob as the page shows it. "curve": {"x_m", "z_m", "k_per_m"} of z = z_m - k_per_m (x - x_m)^2 through its
/// centres, with the curvature k = 4 H / D^2 of the effective fit; null where there is none.
nlohmann::json lob_json(const kicking::lob::LobRecord& lob, std::int64_t start_t_ns);

/// A row for each power of accepted lobs, rising: {"power", "trials", "exit_speed_mps", "exit_speed_sd_mps",
/// "exit_angle_deg", "exit_angle_sd_deg"}, effective values; sd null for one trial.
nlohmann::json table_json(std::span<const kicking::lob::LobRecord> lobs);

/// {"trials", "powers": [{"power", "done"}, ...]}; null: no plan.
nlohmann::json plan_json(const CalibrationPlan& plan, std::span<const kicking::lob::LobRecord> lobs);

}  // namespace trivela::pages

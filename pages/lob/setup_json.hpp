#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "evaluator/log/scan_log.hpp"
#include "kicking/lob/analyzer.hpp"

namespace trivela::pages {

/// What the page must know before it draws a scan. `mode`: "live" or "replay"; `file`: of the record.
nlohmann::json setup_json(const std::string& mode, const std::string& file, const evaluator::log::ScanSession& session,
                          const kicking::lob::AnalyzerConfig& config);

}  // namespace trivela::pages

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>

#include "evaluator/log/reader.hpp"
#include "evaluator/report/log_opportunities.hpp"
#include "evaluator/report/session_setup.hpp"

namespace trivela::evaluator {

/// Places of sessions by their id.
using SessionPlaces = std::unordered_map<std::int64_t, std::uint32_t>;

/// Brings the sessions of several logs together.
class SessionBook {
 public:
  explicit SessionBook(LoggedOpportunities& logged) : logged_(logged) {}

  /// The sessions of a log that none before had, with remarks on the others.
  SessionPlaces add(const log::Reader& reader, const std::string& name);

  /// Gives each session the number of its match.
  void number_matches();

 private:
  void add_remarks(const log::Reader& reader, const std::string& name, std::int64_t again, std::int64_t replayed,
                   std::int64_t open);

  LoggedOpportunities& logged_;
  std::set<std::int64_t> known_;
  // Matches of experiments: seed, arm, configuration, table, calibration. Other flags of the run do not make other
  // kicks.
  std::set<std::tuple<std::int64_t, std::string, std::string, std::string, std::optional<std::int64_t>>> played_;
  SetupBook setups_;
};

}  // namespace trivela::evaluator

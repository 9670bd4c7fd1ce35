#pragma once

#include <optional>

#include "cli/launch/match_run.hpp"
#include "cli/launch/signal_inbox.hpp"
#include "cli/watch/watch_page.hpp"

namespace trivela::cli {

/// The live page of a match that this process plays.
class MatchWatch {
 public:
  /// Serves it and prints its address; `flags` nullptr: nobody watches. `settings`: of the run, with its domain. Throws
  /// what WatchPage does.
  MatchWatch(const WatchFlags* flags, const config::Settings& settings);

  /// A match that was played to its end stays to be looked at until somebody asks to stop.
  void stay_after(const MatchResult& result, SignalInbox& signals);

 private:
  std::optional<WatchPage> page_;
};

}  // namespace trivela::cli

#include "cli/watch/match_watch.hpp"

#include <poll.h>

#include <cstdlib>
#include <string>

#include "cli/options/output.hpp"
#include "nodes/runtime/node_flags.hpp"

namespace trivela::cli {

MatchWatch::MatchWatch(const WatchFlags* flags, const config::Settings& settings) {
  if (flags == nullptr) return;
  const char* const keys = std::getenv(nodes::kKeysVariable);  // as the nodes find them
  page_.emplace(*flags, settings, keys == nullptr ? "" : keys, scene_settings(settings));
}

void MatchWatch::stay_after(const MatchResult& result, SignalInbox& signals) {
  if (!page_ || !result.trouble.empty()) return;
  page_->note_over();
  say("the match is over; its page stays until Ctrl-C\n");
  std::fflush(stdout);
  for (pollfd inbox{signals.file_descriptor(), POLLIN, 0}; !signals.stop_requested();) poll(&inbox, 1, -1);
}

}  // namespace trivela::cli

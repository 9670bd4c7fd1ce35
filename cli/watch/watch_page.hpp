#pragma once

#include <string>

#include "cli/verbs.hpp"
#include "config/settings.hpp"
#include "pages/monitor/match_feed.hpp"
#include "pages/serve/page_server.hpp"

namespace trivela::cli {

/// Where the live page is served.
struct WatchFlags {
  std::string listen = "127.0.0.1";
  int port = 0;
  std::string token_file;
};

/// Adds `--listen`, `--port` and `--token-file`. Returns them, for what they need.
std::vector<CLI::Option*> add_watch_flags(CLI::App& verb, WatchFlags& flags);

/// What the page is told of the match: the team's name, the robot's, field and rules. Throws config::Error.
pages::SceneSettings scene_settings(const config::Settings& settings);

/// The live page of a domain, served while it lives. On this machine's own addresses alone without a token; on any
/// other with that of a file, or with one that is drawn again.
class WatchPage {
 public:
  /// Joins the domain and prints the address. Throws config::BadArgument for flags that make no sense,
  /// std::runtime_error where the address is refused, bus::Error where the domain is. `keys`: the folder of the team's,
  /// empty: in clear.
  WatchPage(const WatchFlags& flags, const config::Settings& settings, const std::string& keys,
            pages::SceneSettings scene);

  /// The match has ended as planned.
  void note_over() { feed_.note_over(); }

 private:
  pages::Broadcast broadcast_{pages::match_channels()};
  pages::MatchFeed feed_;
  pages::PageServer server_;
};

}  // namespace trivela::cli

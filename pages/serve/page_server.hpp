#pragma once

#include <memory>
#include <string>

#include "pages/serve/broadcast.hpp"
#include "pages/serve/page.hpp"
#include "pages/serve/site.hpp"

namespace trivela::pages {

/// Serves a page: its assets and resources, /api/events (server-sent events of the broadcast), and where it has
/// commands POST /api/COMMAND with JSON. A request that names another host than this one, or comes from another site's
/// page, is refused: somebody else's page must not read or work ours through a browser that can reach it. Where there
/// is a token it is asked of every request, as ?token=, as a bearer's, or as the cookie that the first answer sets.
/// Threads of its own; every viewer keeps one.
class PageServer {
 public:
  /// Listens. Throws std::runtime_error naming the address where that is refused. What the page refers to and the
  /// broadcast must outlive it.
  PageServer(Page page, Broadcast& broadcast, const ListenAddress& address);

  /// Closes the broadcast and hangs up; within a second, whatever the viewers do.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  int port() const;

  /// For a browser on this machine, or on another one where every address is listened on; with the token.
  std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::pages

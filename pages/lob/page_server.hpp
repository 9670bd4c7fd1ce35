#pragma once

#include <memory>
#include <string>

#include "pages/lob/broadcast.hpp"
#include "pages/lob/scene.hpp"
#include "pages/lob/site.hpp"

namespace trivela::pages {

/// Serves the page: /, /api/state, /api/events (server-sent events), /api/frame?i=N, /api/table.csv and POST
/// /api/COMMAND with JSON. A request that names another host than this one, or comes from another site's page, is
/// refused: somebody else's page must not work the calibration through a browser that can reach it. Threads of its own;
/// every viewer keeps one.
class PageServer {
 public:
  /// Listens. Throws std::runtime_error naming the address where that is refused. Both must outlive it.
  PageServer(Scene& scene, Broadcast& broadcast, const ListenAddress& address);

  /// Closes the broadcast and hangs up; within a second, whatever the viewers do.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  int port() const;

  /// For a browser on this machine, or on another one where every address is listened on.
  std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::pages

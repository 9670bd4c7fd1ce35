#pragma once

#include <memory>
#include <string>

#include "pages/labels/label_store.hpp"

namespace trivela::pages {

/// Serves the page that asks what became of kicks, on this machine alone (127.0.0.1): /, /api/kicks, /api/timeline?i=N
/// and POST /api/label with JSON. Refused is who names another host (a name server that somebody else rules could lead
/// a browser here), who comes from a page of another site, and who writes without the token of url(), which this server
/// made and no other program of the machine can guess. Threads of its own.
class LabelServer {
 public:
  /// Listens. `port` 0: any free one. Throws std::runtime_error naming the address where that is refused. The store
  /// must outlive it.
  LabelServer(LabelStore& store, int port);
  ~LabelServer();
  LabelServer(const LabelServer&) = delete;
  LabelServer& operator=(const LabelServer&) = delete;

  int port() const;
  const std::string& token() const;

  /// For a browser on this machine, with the token behind a '#', so that no request line carries it.
  std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::pages

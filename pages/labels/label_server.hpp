#pragma once

#include <memory>
#include <string>

#include "pages/labels/label_store.hpp"

namespace trivela::pages {

/// Serves the page that asks what became of kicks, on this machine alone (127.0.0.1): /, /api/kicks, /api/timeline?i=N
/// and POST /api/label with JSON. It has threads of its own. It refuses a request
/// - that names another host, since another's name server could lead a browser here
/// - that comes from a page of another site
/// - that writes without the token of url(), which it made and no other program can guess.
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

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluator/counting/named_kicks.hpp"
#include "log/write/additions.hpp"

namespace trivela::pages {

/// A command that makes no sense; the sentence is for who gave it.
struct LabelRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The kicks of a match log for a page that asks what became of them. Any thread may call.
class LabelStore {
 public:
  /// Throws std::runtime_error where the log cannot be read or added to.
  explicit LabelStore(std::filesystem::path log);

  /// `{log, outcomes, kicks: [{kick, session_id, kick_id, robot, uuid, at_s, utc_ms, policy, observed, by_hand,
  /// labelled_by}]}` by time; ids are texts, since JavaScript's numbers do not hold them.
  nlohmann::ordered_json state() const;

  /// What replay() of evaluator/timeline/replay.js plays of a kick of state(), by its place, as JSON: what robots
  /// saw, without a simulator's truth, which nobody on a field could label by. Throws LabelRefused where there is none.
  std::string timeline(std::size_t place) const;

  /// `{kick_id, session_id, robot, outcome, who, note}`, outcome null: the label is withdrawn. What is accepted is in
  /// the log when it returns. Throws LabelRefused where it makes no sense, std::runtime_error where the log refuses it.
  void add(const nlohmann::json& command, std::int64_t now_utc_ns);

 private:
  const std::filesystem::path log_;
  log::Additions additions_;
  mutable std::mutex mutex_;
  std::vector<evaluator::NamedKick> kicks_;
  std::vector<std::int64_t> utc_ms_;    // of each
  std::vector<std::string> timelines_;  // of each, as JSON
};

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

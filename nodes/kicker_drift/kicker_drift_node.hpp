#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "evaluator/drift/drift_watch.hpp"
#include "idl/messages.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// The kicks of one robot out of its messages, joined by kick_id in whatever order they come, as the log's view `kicks`
/// has them: the first decision that fired, the last receipt (one that says `double` last of all), the last outcome.
class KickSeries {
 public:
  static constexpr std::size_t kMostKicks = 10'000;  ///< later ones are passed over

  /// Each is true where a kick has become another one by it; what has an instant below 0 is passed over.
  bool receive(const msg::KickDecision& decision);
  bool receive(const msg::KickReceipt& receipt);
  bool receive(const msg::KickOutcome& outcome);

  /// Those that the driver accepted, by the instants of their decisions.
  std::vector<evaluator::WatchedKick> kicks() const;

 private:
  struct Texts {
    std::optional<msg::KickDecision> decision;
    std::optional<msg::KickReceipt> receipt;
    std::optional<msg::KickOutcome> outcome;
  };
  Texts* words_of(std::int64_t kick_id);
  static evaluator::WatchedKick watched(const Texts& words);

  std::map<std::int64_t, Texts> texts_;
};

/// Decisions, receipts and outcomes of a robot in, KickerDrift out once its kicker has changed, by the watch that
/// `trivela drift` has (evaluator/drift/drift_watch.hpp). It looks on: nobody waits for it.
class KickerDriftNode {
 public:
  /// Throws std::runtime_error beside another one of the robot.
  explicit KickerDriftNode(NodeContext& context);
  bus::Node& node() { return node_; }

 private:
  template <class T>
  void listen();
  void judge();
  void say(const msg::KickerDrift& drift);

  NodeContext& context_;
  std::mutex mutex_;  // of what the reactions share
  KickSeries series_;
  bus::Node node_;
  bus::Output<msg::KickerDrift> drift_out_;
  msg::KickerDrift said_{};  // the last word
};

}  // namespace trivela::nodes

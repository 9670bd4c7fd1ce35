#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace trivela::bus {

/// What a writer adds to its topic's profile.
struct WriterOptions {
  /// Nominal period; a state topic then promises a deadline of three of them.
  std::optional<std::chrono::nanoseconds> period = {};
  /// How long the writer counts as alive: of an order topic after its last write or assert_liveliness(), 100 ms where
  /// nothing is said; of all others after its process' last sign of life, a second. The shortest one decides how often
  /// the process gives one to each other process.
  std::optional<std::chrono::nanoseconds> lease = {};
  /// Order topics: of several live writers of one robot only the strongest is heard (hot standby).
  std::int32_t strength = 0;
  /// Who writes, e.g. "kicker_driver/1": other_writer_exists() looks for it, and readers are told it with each sample.
  std::string owner = {};
};

/// Live and lapsed writers that a reader is matched with.
struct Liveliness {
  std::uint32_t alive = 0;
  std::uint32_t lapsed = 0;
};

/// What a reader adds to its topic's profile.
struct ReaderOptions {
  /// Nominal period; a state topic then demands a deadline of three of them and matches only writers that promise it.
  std::optional<std::chrono::nanoseconds> period = {};
  /// Keep every sample until it is taken (the recorder), also while an executor stops; else as many as the profile
  /// says.
  bool keep_all = false;
  /// Looks on and is no part of the graph: best effort and volatile, so that no writer waits for it or keeps anything
  /// for it, without a demand of its own, and marked, so that wait_for_readers() and readers() do not count it.
  bool observer = false;
  /// An observer of a state topic that is given the last sample of each writer when it joins: reliable, so that this
  /// one is sent again where it was lost.
  bool with_the_last = false;
  /// Called on Cyclone's threads when a writer appears, lapses or returns; must not throw, block or write.
  std::function<void(const Liveliness&)> on_liveliness = {};
};

}  // namespace trivela::bus

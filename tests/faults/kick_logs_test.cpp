// Kicks that were fired and rows that logs hold. Times in ms.
#include "tests/faults/kick_logs.hpp"

#include <gtest/gtest.h>

namespace trivela::faults {
namespace {

constexpr std::int64_t kMs = 1'000'000;

FireSeen fire(std::int64_t kick_id, std::int64_t t_ms) { return {t_ms * kMs, t_ms * kMs, kick_id, false}; }

/// A row each 20 ms, whose counter rises with each fire.
void add_rows(KickRows& rows, std::int64_t from_ms, std::int64_t to_ms, const std::vector<FireSeen>& fires,
              std::int64_t driver_started_ms = 0) {
  for (std::int64_t t_ms = from_ms; t_ms <= to_ms; t_ms += 20) {
    AcceptedSoFar row{t_ms * kMs, 0};
    for (const FireSeen& done : fires) {
      if (done.arrival_ns >= driver_started_ms * kMs && done.arrival_ns <= row.t_ns) ++row.accepted;
    }
    rows.counters.push_back(row);
  }
}

TEST(KickLogs, AReceiptIsARow) {
  const std::vector fires{fire(1, 1000), fire(2, 2000)};
  KickRows rows;
  rows.accepted = {{1, true}, {2, false}};
  const LoggedKicks found = look_up(fires, rows, true);
  EXPECT_EQ(found.in_a_log, 1u);
  ASSERT_EQ(found.lost.size(), 1u) << "it was refused, says the log, and was fired";
  EXPECT_EQ(found.lost[0].kick_id, 2);
}

TEST(KickLogs, AKickWithoutARowIsCountedWhereTheDriversCountersRiseOverTheGap) {
  const std::vector fires{fire(1, 1000), fire(2, 2000), fire(3, 2600), fire(4, 4000)};
  KickRows rows;
  rows.accepted = {{1, true}, {4, true}};
  add_rows(rows, 0, 1500, fires);
  add_rows(rows, 3500, 5000, fires);
  const LoggedKicks found = look_up(fires, rows, true);
  EXPECT_EQ(found.in_a_log, 2u);
  EXPECT_EQ(found.counted, 2u);
  EXPECT_TRUE(found.lost.empty());
  EXPECT_EQ(look_up(fires, rows, false).lost.size(), 2u) << "rows of a foreign clock count nothing";
}

TEST(KickLogs, WhatADriverHadDoneBeforeItsRestartInTheGapIsLost) {
  const std::vector fires{fire(1, 1000), fire(2, 2000), fire(3, 2600)};
  KickRows rows;
  rows.accepted = {{1, true}};
  add_rows(rows, 0, 1500, fires);
  add_rows(rows, 3500, 5000, fires, 2300);
  EXPECT_EQ(look_up(fires, rows, true).lost.size(), 2u) << "one is counted, but nobody says which";
}

TEST(KickLogs, AfterTheLastLogNothingCounts) {
  const std::vector fires{fire(1, 1000), fire(2, 2000)};
  KickRows rows;
  rows.accepted = {{1, true}};
  add_rows(rows, 0, 1500, fires);
  EXPECT_EQ(look_up(fires, rows, true).lost.size(), 1u);
}

}  // namespace
}  // namespace trivela::faults

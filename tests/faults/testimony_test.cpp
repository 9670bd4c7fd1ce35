#include "tests/faults/testimony.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace trivela::faults {
namespace {

TEST(Testimony, TakesInWhatAWitnessSays) {
  Testimony seen;
  seen.note("1000 order 900 17 910 950");
  seen.note("1001 decision 901 18 911 951");
  seen.note("1002 fire 912 17 0");
  seen.note("1003 fire 0 17 1");
  seen.note("1004 referee 1");
  seen.note("1005 truth 970 17");
  seen.note("1006 outcome 17");
  seen.note("1007 outcome 17");
  seen.note("1008 sample device/drive");
  seen.note("1009 estimate 3 17 2 0.05 0.01");
  ASSERT_EQ(seen.orders.size(), 1u);
  EXPECT_EQ(seen.orders[0].arrival_ns, 1000);
  EXPECT_EQ(seen.orders[0].t_ns, 900);
  EXPECT_EQ(seen.orders[0].kick_id, 17);
  EXPECT_EQ(seen.orders[0].fire_t_ns, 910);
  EXPECT_EQ(seen.orders[0].valid_until_t_ns, 950);
  ASSERT_EQ(seen.decided.size(), 1u);
  EXPECT_EQ(seen.decided[0].kick_id, 18);
  ASSERT_EQ(seen.fires.size(), 2u);
  EXPECT_EQ(seen.fires[0].t_ns, 912);
  EXPECT_FALSE(seen.fires[0].withdrawn);
  EXPECT_TRUE(seen.fires[1].withdrawn);
  ASSERT_EQ(seen.words.size(), 1u);
  EXPECT_TRUE(seen.words[0].playing);
  EXPECT_EQ(seen.last_sample_ns.at("referee"), 1004) << "its rhythm counts, too";
  ASSERT_EQ(seen.truths.size(), 1u);
  EXPECT_EQ(seen.truths[0].release_t_ns, 970);
  EXPECT_EQ(seen.outcome_arrival_ns.at(17), 1006) << "the first one";
  EXPECT_EQ(seen.last_sample_ns.at("device/drive"), 1008);
  EXPECT_EQ(seen.last_sample_ns.at("kicker_estimate"), 1009);
}

TEST(Testimony, RefusesALineThatIsNone) {
  Testimony seen;
  for (const char* const line :
       {"", "order 1 2", "1000 gossip 1", "1000 order 1 2 3", "1000 fire 1 2 yes", "1000 sample"})
    EXPECT_THROW(seen.note(line), std::runtime_error) << line;
}

}  // namespace
}  // namespace trivela::faults

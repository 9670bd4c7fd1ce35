#include "kicking/kick_id.hpp"

#include <gtest/gtest.h>

#include <set>

namespace trivela::kicking {
namespace {

TEST(KickId, HoldsSessionRobotAndCounterInBitsOfTheirOwn) {
  EXPECT_EQ((KickId{5, 1, 1}.number()), (std::int64_t{5} << 48) + (std::int64_t{1} << 40) + 1);
  const KickId id = KickId::of(KickId{KickId::kLastSession, 255, (std::uint64_t{1} << 40) - 1}.number());
  EXPECT_EQ(id.session, KickId::kLastSession);
  EXPECT_EQ(id.robot_id, 255);
  EXPECT_EQ(id.counter, (std::uint64_t{1} << 40) - 1);
}

TEST(KickId, OfAnySessionIsAboveZero) {
  for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{0x7fff}, ~std::uint64_t{0}}) {
    const std::uint32_t session = kick_session(number);
    EXPECT_GE(session, 1u);
    EXPECT_LE(session, KickId::kLastSession);
    EXPECT_GT((KickId{session, 1, 1}.number()), 0);
  }
}

TEST(KickSession, NodesOfARobotThatStartWithinFourHoursHaveDifferentOnes) {
  for (const std::uint64_t start_s : {std::uint64_t{1'795'000'000}, std::uint64_t{1'795'000'000 + 32'760}}) {
    std::set<std::uint32_t> sessions;
    for (std::uint64_t s = 0; s < 16'383; ++s)
      for (const bool second : {false, true}) {
        const std::uint32_t session = kick_session_at(start_s + s, second);
        EXPECT_TRUE(session >= 1 && session <= KickId::kLastSession) << session;
        EXPECT_TRUE(sessions.insert(session).second) << s << " s after the first";
      }
  }
}

}  // namespace
}  // namespace trivela::kicking

// What somebody has who only listens on the team's network.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "tests/e2e/log_rows.hpp"
#include "tests/faults/air_test.hpp"
#include "tests/security/key_fixture.hpp"

namespace trivela::faults {
namespace {

class Capture : public AirTest {
 protected:
  /// Words of the base's referee, by their instants as its own log has them, that a capture of the air holds in clear.
  int referee_words_to_be_read(const std::filesystem::path& keys) {
    TeamPlan plan = this->plan();
    plan.robots = {Plays::kNothing};
    plan.keys = keys;
    TeamOnAir team{plan};
    team.start();
    EXPECT_TRUE(team.wait_for(kAirTimeout, [&] {
      return number_in(team.logs(1), "SELECT count(*) FROM referee WHERE playing = 1") > 50;
    })) << team.casualties();
    const auto capture = team.hub().overheard();
    EXPECT_GT(capture.size(), 100u);
    team.stop();
    int words = 0;
    const e2e::Reader log{team.logs(0).back()};
    for (const auto& row : e2e::rows_of(log, "SELECT t_ns FROM referee")) {
      std::array<std::uint8_t, sizeof(std::int64_t)> instant{};
      std::memcpy(instant.data(), &std::get<std::int64_t>(row[0]), instant.size());
      words += std::ranges::any_of(capture, [&](const auto& packet) {
        return std::search(packet.begin(), packet.end(), instant.begin(), instant.end()) != packet.end();
      });
    }
    return words;
  }
};

TEST_F(Capture, OfATeamWithoutKeysHoldsTheRefereesWords) { EXPECT_GT(referee_words_to_be_read({}), 10); }

TEST_F(Capture, OfATeamWithKeysHoldsNoneOfThem) {
  const security::TeamKeys keys;
  const auto week = security::days_from(security::this_second(), 9);
  for (const std::uint32_t machine : {0u, 1u}) keys.keys().issue(machine, security::usual_nodes(machine), week);
  EXPECT_EQ(referee_words_to_be_read(keys.keys().path()), 0);
}

}  // namespace
}  // namespace trivela::faults

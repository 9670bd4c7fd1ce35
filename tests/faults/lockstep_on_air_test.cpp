// A robot with its own referee, in lockstep, so that its rows depend on the seed alone: whatever becomes of the team's
// network and of its record, it decides the same to the bit.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <functional>
#include <map>

#include "tests/e2e/log_rows.hpp"
#include "tests/faults/air_test.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// What is done to a team on the air: once at its beginning, and again and again with the count of times.
struct Fault {
  const char* name;
  std::function<void(TeamOnAir&)> before;
  std::function<void(TeamOnAir&, int time)> again;
};

void nothing(TeamOnAir&) {}

/// Done at every even time, undone at every odd one.
auto in_turns(std::function<void(TeamOnAir&)> done, std::function<void(TeamOnAir&)> undone) {
  return [=](TeamOnAir& team, int time) { time % 2 == 0 ? done(team) : undone(team); };
}

const Way kHealthy{};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> kAll{
      {"Loss", [](TeamOnAir& team) { team.air({.jitter = milliseconds{20}, .drop = 0.3}); }, [](TeamOnAir&, int) {}},
      {"Outage", nothing,
       // Ten times a second: a second with all, two without anybody.
       [](TeamOnAir& team, int time) {
         if (time % 30 == 10) team.cut(1);
         if (time % 30 == 0) team.air(kHealthy);
       }},
      {"Address", nothing,
       in_turns([](TeamOnAir& team) { team.lose_address(1); }, [](TeamOnAir& team) { team.give_address(1); })},
      {"Interface", nothing,
       in_turns([](TeamOnAir& team) { team.lose_interface(1); }, [](TeamOnAir& team) { team.give_interface(1); })},
      {"LinkRestarted", nothing,
       [](TeamOnAir& team, int time) {
         if (time % 20 == 10) team.process(1, "trivela-team_link").signal(SIGKILL);
         if (time % 20 == 15) team.restart(1, "trivela-team_link");
       }},
  };
  return kAll;
}

/// A decision's row but for its session and the session's part of its kick_id.
std::string decision_of(const e2e::Row& row) {
  constexpr std::size_t kKickId = 4;
  std::string text;
  for (std::size_t column = 1; column < row.size(); ++column)
    std::visit(
        [&]<class T>(const T& cell) {
          if constexpr (std::is_same_v<T, std::string>) text += cell + "|";
          if constexpr (std::is_same_v<T, double>) text += fmt::format("{:a}|", cell);
          if constexpr (std::is_same_v<T, std::int64_t>)
            text += column == kKickId && cell > (std::int64_t{1} << 40) ? "kick|" : fmt::format("{}|", cell);
        },
        row[column]);
  return text;
}

class LockstepOnAir : public AirTest, public testing::WithParamInterface<Fault> {
 protected:
  /// The decisions of the one match there is, under a fault or none.
  std::vector<std::string> played(const Fault* fault) {
    const tests::Folder own;
    TeamPlan plan = this->plan();
    plan.folder = own.path();
    plan.robots = {Plays::kInLockstep};
    TeamOnAir team{plan};
    if (fault != nullptr) fault->before(team);
    team.start();
    int time = 0;
    EXPECT_TRUE(team.wait_for(seconds{300}, [&] {
      if (fault != nullptr) fault->again(team, time++);
      return team.process(1, "trivela-simulator").ended();
    })) << team.said(1, "trivela-simulator");
    EXPECT_EQ(team.process(1, "trivela-simulator").code(), 0) << team.said(1, "trivela-simulator");
    team.stop();
    std::vector<std::string> decisions;
    for (const fs::path& log : team.logs(1))
      for (const auto& row : e2e::rows_of(e2e::Reader{log}, "SELECT * FROM kick_decisions ORDER BY seq"))
        decisions.push_back(decision_of(row));
    return decisions;
  }
};

TEST_P(LockstepOnAir, DecidesTheSameToTheBitAsOnASoundNetwork) {
  static const std::vector<std::string> sound = played(nullptr);
  EXPECT_GT(sound.size(), 100u);
  EXPECT_EQ(played(&GetParam()), sound);
}

INSTANTIATE_TEST_SUITE_P(Under, LockstepOnAir, testing::ValuesIn(faults()),
                         [](const auto& test) { return std::string{test.param.name}; });

}  // namespace
}  // namespace trivela::faults

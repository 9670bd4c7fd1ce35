// What a program of somebody else hears of the learning of a kicker, beside what the recorder kept and what was so.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "bus/domain/domain.hpp"
#include "config/settings.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/running_match.hpp"

namespace trivela::e2e {
namespace {

constexpr double kFaster = 1.1, kLater_s = 0.06;  // than the robot's file says

struct HeardEstimate {
  std::int64_t seq = 0, kick_id = 0, kicks = 0;
  double speed_ln = 0.0, delay_s = 0.0;
};

/// What fault_witness said.
struct Received {
  std::vector<HeardEstimate> estimates;
  std::map<std::int64_t, double> release_late_s;  // by kick
  std::map<std::int64_t, std::int64_t> fires_t_ns, released_t_ns;

  explicit Received(const std::string& text) {
    std::istringstream lines{text};
    for (std::string line; std::getline(lines, line);) {
      std::istringstream in{line};
      std::int64_t arrival_ns = 0, t_ns = 0, kick_id = 0;
      std::string what, number;
      in >> arrival_ns >> what;
      if (HeardEstimate e; what == "estimate" && in >> e.seq >> e.kick_id >> e.kicks >> e.speed_ln >> e.delay_s)
        estimates.push_back(e);
      if (what == "outcome" && in >> kick_id >> number) release_late_s[kick_id] = std::strtod(number.c_str(), nullptr);
      if (what == "order" && in >> t_ns >> kick_id >> t_ns) fires_t_ns[kick_id] = t_ns;
      if (what == "truth" && in >> t_ns >> kick_id) released_t_ns[kick_id] = t_ns;
    }
  }
};

TEST(LearningWitness, HearsOnStockTypesWhatIsRecordedAndWhatIsSo) {
  const tests::Folder folder;
  std::ofstream{folder / "other.toml"} << fmt::format("[kicker]\nspeed_scale_ratio = {}\ndelay_s = {}\n", kFaster,
                                                      0.06 + kLater_s);
  RunningMatch match{{"--set", "self_calibration.mode='on'", "--set",
                      fmt::format("run.scenario='{}'", (folder / "other.toml").string())}};
  const config::Settings settings = config::load_settings(match.config());
  std::ofstream{folder / "bus.xml"} << bus::loopback(settings.domain.domain_id, settings.domain.tag).xml;
  Program witness{"tests/fault_witness", {std::to_string(settings.domain.domain_id)}, folder.path(), [&] {
                    setenv("CYCLONEDDS_URI", ("file://" + (folder / "bus.xml").string()).c_str(), 1);
                  }};
  ASSERT_TRUE(wait_for_change(folder.path(), witness.watch(), [&] {
    return Received{witness.output()}.estimates.size() >= 12;
  })) << witness.errors();
  match.program().signal(SIGINT);
  match.program().wait();
  const Reader log{match.log()};
  const std::int64_t last = number_of(log, "SELECT max(seq) FROM kicker_estimates");
  ASSERT_TRUE(wait_for_change(folder.path(), witness.watch(), [&] {
    return Received{witness.output()}.estimates.back().seq >= last;
  })) << "nothing is recorded that was not heard";
  const Received received{witness.output()};
  std::int64_t next = received.estimates.front().seq;
  for (const HeardEstimate& e : received.estimates) {
    EXPECT_EQ(e.seq, next++);
    const auto rows = rows_of(
        log, fmt::format("SELECT kick_id, kicks, speed_ln, delay_s FROM kicker_estimates WHERE seq = {}", e.seq));
    ASSERT_EQ(rows.size(), 1u) << e.seq;
    EXPECT_EQ(rows[0], (Row{e.kick_id, e.kicks, e.speed_ln, e.delay_s})) << e.seq;
  }
  EXPECT_EQ(next - 1, last);

  int compared = 0;
  for (const auto& [kick_id, late_s] : received.release_late_s) {
    if (std::isnan(late_s) || !received.fires_t_ns.contains(kick_id) || !received.released_t_ns.contains(kick_id))
      continue;
    const double true_s =
        1e-9 * static_cast<double>(received.released_t_ns.at(kick_id) - received.fires_t_ns.at(kick_id));
    EXPECT_NEAR(late_s, true_s - 0.06, 0.03) << kick_id;
    ++compared;
  }
  EXPECT_GE(compared, 8);
  EXPECT_NEAR(received.estimates.back().speed_ln, std::log(kFaster), 0.04);
  EXPECT_NEAR(received.estimates.back().delay_s, kLater_s, 0.02);
}

}  // namespace
}  // namespace trivela::e2e

#include "pages/lob/lob_session.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "kicking/geometry/angle.hpp"
#include "pages/lob/lob_page.hpp"

namespace trivela::pages {
namespace {

using kicking::lob::LobRecord;
using kicking::lob::Refusal;
using nlohmann::json;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A lob launched `second` s after the start: exit speed and angle as given, H and D those of its parabola.
LobRecord lob_at(int second, double speed_mps, double angle_deg = 36.78) {
  const double angle = kicking::radians(angle_deg);
  const double distance = speed_mps * speed_mps * std::sin(2.0 * angle) / kicking::kGravity_mps2;
  const double height = distance * std::tan(angle) / 4.0;
  LobRecord lob;
  lob.launch_t_ns = second * kSecond_ns;
  lob.effective = {.exit_angle_rad = {angle, 0.001},
                   .exit_speed_mps = {speed_mps, 0.01},
                   .height_m = {height, 0.001},
                   .distance_m = {distance, 0.01},
                   .residual_rms_m = 0.001};
  for (double x = 1.0; x < 5.0; x += 0.5) {
    const double z = 0.11 + height - 4.0 * height / (distance * distance) * std::pow(x - distance / 2.0, 2);
    lob.centres.push_back({.t_ns = lob.launch_t_ns, .x_m = x, .z_m = z, .returns = 9, .chord_ratio = 1.0});
  }
  return lob;
}

LobSession session_of_three() {
  LobSession lob_session({.powers = {15, 20}, .trials = 2},
                         {{.t_ns = 0, .power = 15}, {.t_ns = 25 * kSecond_ns, .power = 20}});
  lob_session.add(lob_at(10, 6.0), 100);
  lob_session.add(lob_at(20, 6.2), 200);
  lob_session.add(lob_at(30, 7.3), 300);
  return lob_session;
}

TEST(LobSession, ShowsTheLobsThatHadEndedByAScan) {
  const LobSession lob_session = session_of_three();
  EXPECT_EQ(lob_session.count(99), 0u);
  EXPECT_EQ(lob_session.count(100), 1u);
  EXPECT_EQ(lob_session.count(299), 2u);
  EXPECT_EQ(lob_session.count(1000), 3u);
  EXPECT_EQ(lob_session.to_json(1, 0)["lobs"].size(), 1u);
  EXPECT_EQ(lob_session.to_json(3, 0)["lobs"][2]["power"], 20.0);
  EXPECT_EQ(lob_session.to_json(3, 0)["lobs"][2]["end"], 300);
}

TEST(LobSession, KnowsThePowerOfAnInstant) {
  const LobSession lob_session = session_of_three();
  EXPECT_EQ(lob_session.power_at(-1), std::nullopt);
  EXPECT_EQ(lob_session.power_at(0), 15.0);
  EXPECT_EQ(lob_session.power_at(25 * kSecond_ns - 1), 15.0);
  EXPECT_EQ(lob_session.power_at(25 * kSecond_ns), 20.0);
}

TEST(LobSession, AveragesTheAcceptedLobsOfAPower) {
  const json table = session_of_three().to_json(3, 0)["table"];
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[0]["power"], 15.0);
  EXPECT_EQ(table[0]["trials"], 2);
  EXPECT_NEAR(table[0]["exit_speed_mps"], 6.1, 1e-12);
  EXPECT_NEAR(table[0]["exit_speed_sd_mps"], std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(table[0]["exit_angle_deg"], 36.78, 1e-9);
  EXPECT_NEAR(table[0]["exit_angle_sd_deg"], 0.0, 1e-9);
  EXPECT_TRUE(table[1]["exit_speed_sd_mps"].is_null()) << "one trial has no spread";
}

TEST(LobSession, ARejectedLobLeavesTableAndPlanAndMayComeBack) {
  LobSession lob_session = session_of_three();
  const auto verdict = lob_session.judge(1, false, "touched a foot");
  EXPECT_EQ(verdict.launch_t_ns, 20 * kSecond_ns);
  json now = lob_session.to_json(3, 0);
  EXPECT_EQ(now["lobs"][1]["accepted"], false);
  EXPECT_EQ(now["lobs"][1]["refusal"], "operator");
  EXPECT_EQ(now["lobs"][1]["why"], "rejected by the operator: touched a foot");
  EXPECT_EQ(now["table"][0]["trials"], 1);
  EXPECT_EQ(now["table"][0]["exit_speed_mps"], 6.0);
  EXPECT_EQ(now["plan"]["powers"][0]["done"], 1);
  lob_session.judge(1, true, "");
  now = lob_session.to_json(3, 0);
  EXPECT_EQ(now["lobs"][1]["accepted"], true);
  EXPECT_EQ(now["table"][0]["trials"], 2);
}

TEST(LobSession, ARefusedLobIsAcceptedOnlyWhereThereIsAFit) {
  LobSession lob_session({});
  LobRecord with_fit = lob_at(10, 6.0);
  with_fit.refusal = Refusal::kPlaneMisaligned;
  with_fit.why = "misaligned";
  LobRecord without = with_fit;
  without.launch_t_ns = 20 * kSecond_ns;
  without.effective.reset();
  lob_session.add(with_fit, 1);
  lob_session.add(without, 2);
  lob_session.judge(0, true, "");
  lob_session.judge(1, true, "");
  const json lobs = lob_session.to_json(2, 0)["lobs"];
  EXPECT_EQ(lobs[0]["accepted"], true);
  EXPECT_EQ(lobs[0]["why"], "");
  EXPECT_EQ(lobs[1]["accepted"], false);
  EXPECT_EQ(lobs[1]["why"], "misaligned");
}

TEST(LobSession, ThereIsNoVerdictOnALobThatIsNotThere) {
  EXPECT_THROW(session_of_three().judge(3, false, ""), std::out_of_range);
}

TEST(LobSession, TheCsvHoldsAcceptedLobsOfKnownPower) {
  LobSession lob_session = session_of_three();
  lob_session.judge(0, false, "");
  const std::string csv = lob_session.table_csv(3);
  EXPECT_THAT(csv, testing::StartsWith("power,height_m,distance_m\n15,"));
  EXPECT_THAT(csv, testing::HasSubstr("\n20,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

TEST(LobJson, TheCurveRunsThroughTheCentresOfAParabola) {
  const LobRecord lob = lob_at(10, 8.0);
  const json curve = lob_json(lob, 0)["curve"];
  for (const auto& centre : lob.centres) {
    const double x = centre.x_m - curve["x_m"].get<double>();
    EXPECT_NEAR(curve["z_m"].get<double>() - curve["k_per_m"].get<double>() * x * x, centre.z_m, 1e-9);
  }
  EXPECT_NEAR(curve["x_m"], lob.effective->distance_m.value / 2.0, 1e-9);
}

TEST(LobJson, WithoutAFitThereIsNoCurve) {
  LobRecord lob = lob_at(10, 8.0);
  lob.effective.reset();
  EXPECT_TRUE(lob_json(lob, 0)["curve"].is_null());
  EXPECT_TRUE(lob_json(lob, 0)["effective"].is_null());
  EXPECT_TRUE(lob_json(LobRecord{}, 0)["curve"].is_null());
}

}  // namespace
}  // namespace trivela::pages

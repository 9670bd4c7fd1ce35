#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "config/team/team.hpp"
#include "tests/faults/air_test.hpp"
#include "tests/faults/impostor.hpp"
#include "tests/security/key_fixture.hpp"

namespace trivela::faults {

/// A robot that plays with its own referee, with keys and without.
class Attackers : public AirTest {
 protected:
  /// `keys`: the robot's nodes and those of its simulated world have them.
  void kick_off(bool with_keys) {
    TeamPlan plan = this->plan();
    plan.robots = {Plays::kOwnReferee};
    if (with_keys) {
      const auto week = security::days_from(security::this_second(), 9);
      std::vector<std::string> nodes = security::usual_nodes(1);
      if (std::ranges::find(nodes, "simulator") == nodes.end()) nodes.emplace_back("simulator");
      keys.keys().issue(0, security::usual_nodes(0), week);
      keys.keys().issue(1, nodes, week);
      plan.keys = keys.keys().path();
    }
    team = std::make_unique<TeamOnAir>(plan);
    team->start();
    ASSERT_TRUE(team->wait_for(kAirTimeout, [&] { return cycles(team->logs(1), true, 0) > 100; }))
        << team->casualties() << team->said(1, "trivela-simulator");
  }

  /// A base with the referee's word and two robots, with keys or without, their links started by the launcher.
  void start_team(bool with_keys = true, std::vector<std::string> settings = {}) {
    const auto week = security::days_from(security::this_second(), 9);
    for (const std::uint32_t machine : {0u, 1u, 2u}) keys.keys().issue(machine, security::usual_nodes(machine), week);
    TeamPlan plan = this->plan();
    plan.robots = {Plays::kNothing, Plays::kNothing};
    if (with_keys) plan.keys = keys.keys().path();
    plan.link_launched = true;
    plan.settings = std::move(settings);
    team = std::make_unique<TeamOnAir>(plan);
    team->start();
    ASSERT_TRUE(team->wait_for(kAirTimeout, [&] { return rows("referee WHERE playing = 1") > 50; }))
        << team->casualties() << team->said(1, "team_link") << team->said(0, "team_link");
  }

  std::int64_t rows(const std::string& sql) const { return number_in(team->logs(1), "SELECT count(*) FROM " + sql); }

  /// Orders of the impostor's that any node of the robot took for orders, and answers to them.
  std::int64_t received() const {
    const auto forged = fmt::format("WHERE kick_id BETWEEN {} AND {}", kForgedKick, kForgedKick + kForgedKicks - 1);
    return rows("kick_orders " + forged) + rows("kick_receipts " + forged);
  }

  /// It plays on: cycles after now.
  bool plays_on() {
    const std::int64_t now = last_instant(team->logs(1));
    return team->wait_for(kAirTimeout, [&] { return cycles(team->logs(1), true, now) > 50; });
  }

  void send(const NetworkHost& host, const std::string& address, const Packets& packets) {
    send_to_domain(host, address, config::TeamDomains{}.robot, packets);
    team->pass(std::chrono::seconds{1});  // the recorder writes what it has every 200 ms
  }

  security::TeamKeys keys;
  std::unique_ptr<TeamOnAir> team;
};

}  // namespace trivela::faults

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "config/settings.hpp"
#include "log/schema/session.hpp"

namespace trivela::robot {

/// The whole configuration of a session: "### settings" without what differs from run to run and from machine to
/// machine, so that equal set-ups have equal hashes, "### robot", further ones as "### robot 2", ..., and "###
/// scenario" where one is given.
std::string session_config(const config::Settings& settings, const std::vector<config::Robot>& robots,
                           const std::string& scenario_toml = {});

/// The policies of so many halves, and of the robots that have one of their own; none where they are drawn at random.
std::vector<log::HalfPolicy> session_policies(const config::KickDecision& settings, std::size_t halves);

/// The definition of the messages.
const char* idl_text();

}  // namespace trivela::robot

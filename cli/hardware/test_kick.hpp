#pragma once

#include <string>

#include "cli/launch/person.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"
#include "hal/kicker.hpp"

namespace trivela::cli {

/// Why nobody is asked to lay a ball into this kicker, as a sentence that names the fault or the switch; empty: it
/// could fire. `status`: the kicker's.
std::string refused_at_once(const hal::KickerSample& sample, const config::KickerDevice& device,
                            const std::string& status);

/// One shot with the lowest set-point of the robot's table, after the person has typed the word. It passes the same
/// robot::OrderGate as every order of a match; what the referee would have to permit, the person does. The kicker is
/// safe afterwards, by whichever way this is left. Returns the exit code: kFailed where it was not confirmed, refused
/// or not carried out. Throws std::runtime_error where the kicker does not answer.
int fire_test_kick(hal::Kicker& kicker, const config::Settings& settings, const config::Robot& robot, Person& person,
                   SignalInbox& signals);

}  // namespace trivela::cli

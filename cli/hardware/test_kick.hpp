#pragma once

#include "cli/launch/person.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"
#include "hal/kicker.hpp"

namespace trivela::cli {

/// One shot with the lowest set-point of the robot's table, after the person has typed the word. It passes the same
/// robot::OrderGate as every order of a match; what the referee would have to permit, the person does. The kicker is
/// safe afterwards, by whichever way this is left. Returns the exit code: kFailed where it was not confirmed, refused
/// or not carried out. Throws std::runtime_error where the kicker does not answer.
int fire_test_kick(hal::Kicker& kicker, const config::Settings& settings, const config::Robot& robot, Person& person,
                   SignalInbox& signals);

}  // namespace trivela::cli

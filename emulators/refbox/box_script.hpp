#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulators/refbox/box_act.hpp"

namespace trivela::hal::refbox {

/// A script for an emulated box: a line an act, "SECONDS COMMAND [left|right [ROBOT]]" or "SECONDS fault NAME", in the
/// order of time; what follows a # is left out. `name` is the file's, for messages. Throws std::runtime_error with
/// file, line and value for a line that is none, and for a time before the one above it.
std::vector<BoxStep> read_box_script(std::string_view text, const std::string& name);

/// The commands in the text log of a real box, from its first on: "ms,time(run time),state,code,text" with a letter of
/// the old protocol, a command, or a command's JSON object as the code (RoboCup-MSL/RefBox, mslrb2015/Log.pde, and
/// logs of 2016 to 2018). Other lines are left out. An object's team is the left one when it is the first team named.
/// Throws std::runtime_error where there is no command at all.
std::vector<BoxStep> read_box_log(std::string_view text, const std::string& name);

}  // namespace trivela::hal::refbox

#pragma once

#include <string>
#include <vector>

#include "evaluator/log/session.hpp"

namespace trivela::cli {

/// The session of an imported match: no simulation, by UTC (realtime_offset_ns is when its clock was 0), with the
/// sentences on what was imported and the text that it was imported from in place of a configuration. Its uuid is made
/// of these, so that what is imported twice counts once.
evaluator::log::Session imported_session(const std::string& name, const std::vector<std::string>& sentences,
                                         const std::string& source, std::int64_t realtime_offset_ns);

}  // namespace trivela::cli

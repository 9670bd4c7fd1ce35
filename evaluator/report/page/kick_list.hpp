#pragma once

#include <string>

#include "evaluator/report/kick_story.hpp"

namespace trivela::evaluator::page {

/// "2026-11-24 08:47:31.12" in UTC; "+73.20 s" of the session's clock where that is a simulator's.
std::string instant_text(const KickStory& story);

/// "2, 3:04.5": half, minutes and seconds since its first start of play; "2" where nobody said the time.
std::string match_time_text(const KickStory& story);

}  // namespace trivela::evaluator::page

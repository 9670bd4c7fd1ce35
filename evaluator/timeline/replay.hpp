#pragma once

#include <string_view>

namespace trivela::evaluator {

/// `replay(container, timeline)` in plain JavaScript, without a library or a request: draws the timeline of a kick
/// (json_of() of evaluator/timeline/kick_timeline.hpp) from above and from the side and plays it. To be put into a page
/// as a script with replay_style() beside it; it sets no inline style and reads no text as HTML, so that a strict
/// content-security policy lets it work and texts of a log stay texts.
std::string_view replay_script();

/// Its style sheet: colours for light and dark readers as variables of .replay.
std::string_view replay_style();

}  // namespace trivela::evaluator

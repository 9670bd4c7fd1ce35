#pragma once

#include <string>

#include "pages/monitor/match_scene.hpp"

namespace trivela::pages {

/// What moves, as JSON: `now_ms` by the listener's clock, `robots` with pose in F, segments, why each fires or holds,
/// its kicker, `ball`s as each believes, `flight` as a goal camera sees the last kick. null where there is no such
/// number; places in metres and radians.
std::string pitch_json(const SceneState& state, std::int64_t now_ns);

/// The rest: title, field, referee, the last kicks, the running table, alarms, whether it is simulated and by whose
/// word. Bytes that are no UTF-8 become U+FFFD. The same text while nothing changes.
std::string match_json(const SceneState& state, std::int64_t now_ns);

}  // namespace trivela::pages

#include "evaluator/timeline/replay.hpp"

#include "evaluator/timeline/replay.css.hpp"
#include "evaluator/timeline/replay.js.hpp"

namespace trivela::evaluator {

std::string_view replay_script() { return kReplayJs; }

std::string_view replay_style() { return kReplayCss; }

}  // namespace trivela::evaluator

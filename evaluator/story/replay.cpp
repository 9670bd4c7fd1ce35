#include "evaluator/story/replay.hpp"

#include "evaluator/story/replay.css.hpp"
#include "evaluator/story/replay.js.hpp"

namespace trivela::evaluator {

std::string_view replay_script() { return kReplayJs; }

std::string_view replay_style() { return kReplayCss; }

}  // namespace trivela::evaluator

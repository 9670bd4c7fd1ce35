#include "evaluator/report/replay/replay.hpp"

#include "evaluator/report/replay/replay.css.hpp"
#include "evaluator/report/replay/replay.js.hpp"

namespace trivela::evaluator {

std::string_view replay_script() { return kReplayJs; }

std::string_view replay_style() { return kReplayCss; }

}  // namespace trivela::evaluator

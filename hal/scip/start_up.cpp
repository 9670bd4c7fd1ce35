#include "hal/scip/start_up.hpp"

namespace trivela::hal::scip {

std::string StartUp::request() const {
  switch (step_) {
    case Step::kQuit:
      return std::string{kQT};
    case Step::kReset:
      return std::string{kRS};
    case Step::kScip2:
      return std::string{kScip20};
    case Step::kVersion:
      return std::string{kVV};
    case Step::kParameters:
      return std::string{kPP};
    case Step::kState:
      return std::string{kII};
    case Step::kLaserOn:
      return std::string{kBM};
    default:
      return measure_request(whole_section(parameters_));
  }
}

StartUp::Progress StartUp::take(const Reply& reply) {
  // Scans of an earlier host's MD may still arrive.
  if (step_ == Step::kDone || reply.echo != request()) return Progress::kWaiting;
  return take_answer(reply);
}

StartUp::Progress StartUp::take_answer(const Reply& reply) {
  switch (step_) {
    case Step::kQuit:
      return reply.status == "00" ? go(Step::kScip2) : go(Step::kReset);
    case Step::kReset:
      return go(Step::kScip2);
    case Step::kScip2:  // whatever it says: one that speaks nothing else may not know the request
      return go(Step::kVersion);
    case Step::kVersion: {
      const auto identity = identity_of(reply);
      if (!identity) return fail("its answer to VV does not say who it is");
      identity_ = *identity;
      return go(Step::kParameters);
    }
    case Step::kParameters: {
      auto parameters = parameters_of(reply);
      if (!parameters) return fail("its answer to PP is not that of a scanner");
      parameters_ = std::move(*parameters);
      return go(Step::kState);
    }
    case Step::kState:
      if (const auto state = state_of(reply)) condition_ = state->condition;
      return go(Step::kLaserOn);
    case Step::kLaserOn:
      if (reply.status != "00" && reply.status != "02") return fail(meaning(kBM, reply.status));
      return go(asking_ == Asking::kContinuous ? Step::kMeasure : Step::kDone);
    default:
      if (reply.status != "00") return fail(meaning("MD", reply.status));
      return go(Step::kDone);
  }
}

StartUp::Progress StartUp::timed_out() {
  if (step_ == Step::kQuit) return go(Step::kReset);
  if (step_ == Step::kReset) return go(Step::kScip2);
  if (step_ == Step::kScip2) return go(Step::kVersion);
  if (step_ == Step::kState) return go(Step::kLaserOn);
  if (repeated_) return fail("no answer to " + request());
  repeated_ = true;
  return Progress::kNext;
}

StartUp::Progress StartUp::go(Step step) {
  step_ = step;
  repeated_ = false;
  return step == Step::kDone ? Progress::kDone : Progress::kNext;
}

StartUp::Progress StartUp::fail(const std::string& why) {
  why_ = condition_.empty() ? why : why + " (it says of itself: " + condition_ + ")";
  return Progress::kFailed;
}

}  // namespace trivela::hal::scip

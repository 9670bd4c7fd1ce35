// A policy of one's own: it kicks as `moving` does, but carries the ball on while the goal is far and no opponent near.
#include <trivela/policy.hpp>
#include <trivela/program.hpp>

namespace {

using namespace trivela;

class Patient final : public PolicyOf<MovingMemory> {
 public:
  Patient() : PolicyOf("patient") {}

  PolicyOutput evaluate(const PolicyConfig& config, const RobotModel& robot, const Goal& goal, const PolicyInput& input,
                        MovingMemory& memory) const override {
    PolicyOutput output = evaluate_moving(config, robot, goal, input, memory);
    const bool far = output.distance_m > near_m_.of(config);
    const bool alone = input.opponent_distance_m.value_or(100.0) > opponent_m_.of(config);
    if (output.reason == Reason::kFire && far && alone) output.reason = Reason::kWaiting;
    return output;
  }

 private:
  // In a file: [policy.own.patient], near_m = 4.0
  const Setting near_m_ = setting("near_m", 4.5, {0.0, 20.0});
  const Setting opponent_m_ = setting("opponent_m", 1.2, {0.0, 10.0});
};

}  // namespace

int main(int argc, char** argv) {
  register_policy<Patient>();
  return run(argc, argv);
}

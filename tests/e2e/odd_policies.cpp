// Policies that do what a rule should not.
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <trivela/policy.hpp>
#include <trivela/program.hpp>

namespace {

using namespace trivela;

class Odd final : public PolicyOf<PossessionMemory> {
 public:
  Odd(const std::string& name, void (*act)()) : PolicyOf(name), act_(act) {}

  PolicyOutput evaluate(const PolicyConfig&, const RobotModel&, const Goal&, const PolicyInput&,
                        PossessionMemory&) const override {
    act_();
    return {};
  }

 private:
  void (*act_)();
};

/// Fires in each cycle, with a power that no kicker has.
class Strong final : public PolicyOf<PossessionMemory> {
 public:
  Strong() : PolicyOf("strong") {}

  PolicyOutput evaluate(const PolicyConfig&, const RobotModel&, const Goal&, const PolicyInput&,
                        PossessionMemory&) const override {
    PolicyOutput output;
    output.reason = Reason::kFire;
    output.power = 1e6;
    return output;
  }
};

void fail() { throw std::runtime_error("an idea that was none"); }

/// Says by a file that it was asked, and never answers.
void hang() {
  std::ofstream{"hangs"} << "\n";
  for (;;) pause();
}

}  // namespace

int main(int argc, char** argv) {
  register_policy<Odd>("throws", fail);
  register_policy<Odd>("hangs", hang);
  register_policy<Strong>();
  if (argc == 2) register_policy<Odd>(argv[1], fail);
  return run(argc, argv);
}

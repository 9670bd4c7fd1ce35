// Sensor sample to order over three hops: the bus beside Cyclone alone and beside plain UDP sockets, in the same run.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "tests/bench/chain/goals.hpp"
#include "tests/bench/chain/run.hpp"

namespace {

// The rows called idle are only as idle as the machine.
void warn_if_busy() {
  double load = 0;
  if (getloadavg(&load, 1) == 1 && load > 0.5)
    fmt::print(stderr, "chain_bench: others use this machine (load {:.1f}): the idle rows are not idle\n", load);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Latency from sensor sample to order over three hops: on the bus, on Cyclone alone, over UDP"};
  trivela::bench::Plan plan;
  bool quick = false, goals = false, tries = false, protections = false;
  app.add_option("--samples", plan.samples, "samples a row")->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--rates", plan.rates_hz, "sensor rates in Hz")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_flag("--quick", quick, "60 samples a row unless --samples says otherwise");
  app.add_flag("--goals", goals,
               "exit 3 unless the medians are at most 1.1 x bare Cyclone and 1.5 x UDP, and what else goals.hpp says");
  auto* const try_flag =
      app.add_flag("--try", tries, "what might make the chain faster, each option alone and all together");
  app.add_flag("--protections", protections, "what DDS Security may protect, one way each, beside the plain chain")
      ->excludes(try_flag);
  try {
    app.parse(argc, argv);
    if (quick && app.count("--samples") == 0) plan.samples = 60;
    warn_if_busy();
    const auto rows = tries         ? trivela::bench::run_tries(plan)
                      : protections ? trivela::bench::run_protections(plan)
                                    : trivela::bench::run(plan);
    const auto missed = goals ? trivela::bench::missed_goals(rows) : std::vector<std::string>{};
    for (const std::string& sentence : missed) fmt::print(stderr, "chain_bench: {}\n", sentence);
    return missed.empty() ? 0 : 3;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "chain_bench: {}\n", error.what());
    return 1;
  }
}

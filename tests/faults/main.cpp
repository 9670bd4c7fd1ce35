// Faults at a running robot, judged by a witness outside of it.
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <stdexcept>

#include "cli/launch/progress_bar.hpp"
#include "cli/launch/signals.hpp"
#include "tests/faults/drivers_words.hpp"
#include "tests/faults/forged_orders.hpp"
#include "tests/faults/verdict.hpp"
#include "tests/support/folder.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;

constexpr int kSkipped = 77;  // SKIP_RETURN_CODE of the ctest entry

struct Arguments {
  std::size_t faults = 50;
  std::size_t stalls = 0;
  std::size_t referee_losses = 0;
  std::uint64_t seed = 1;
  fs::path log_dir;
  fs::path json;
  fs::path programs = TRIVELA_BINARY_DIR;
  double limit_s = 30.0;
  bool loopback = false;
  bool arrivals_only = false;
};

fs::path prepared(const fs::path& log_dir, const tests::Folder& temporary) {
  if (log_dir.empty()) return temporary.path();
  fs::create_directories(log_dir);
  if (!fs::is_empty(log_dir)) throw std::runtime_error{fmt::format("{} is not empty", log_dir.string())};
  return fs::absolute(log_dir);
}

/// The rows of orders and fires, for whoever looks into a finding.
void write_events(const fs::path& file, const Stack& stack) {
  std::ofstream out{file};
  for (const auto& [who, witness] : {std::pair{"device", &stack.device()}, std::pair{"wire", &stack.wire()}}) {
    for (const OrderSeen& order : witness->orders)
      out << fmt::format("{} {} order {} {} {} {}\n", who, order.arrival_ns, order.t_ns, order.kick_id, order.fire_t_ns,
                         order.valid_until_t_ns);
    for (const FireSeen& fire : witness->fires)
      out << fmt::format("{} {} fire {} {} {}\n", who, fire.arrival_ns, fire.t_ns, fire.kick_id, int{fire.withdrawn});
    for (const TruthSeen& truth : witness->truths)
      out << fmt::format("{} {} truth {} {}\n", who, truth.arrival_ns, truth.release_t_ns, truth.kick_id);
    for (std::size_t i = 0; i < witness->words.size(); ++i) {
      if (i > 0 && witness->words[i].playing == witness->words[i - 1].playing) continue;
      out << fmt::format("{} {} referee {}\n", who, witness->words[i].arrival_ns, int{witness->words[i].playing});
    }
  }
}

std::vector<Fault> faults_of(const Arguments& arguments, bool with_links) {
  if (arguments.stalls > 0) return draw_stalls(arguments.stalls, arguments.seed);
  if (arguments.referee_losses == 0) return draw_faults(arguments.faults, arguments.seed, with_links);
  if (!with_links) throw std::runtime_error{"the referee can be lost on a host of its own alone"};
  return draw_referee_losses(arguments.referee_losses, arguments.seed);
}

Verdict campaign(const Arguments& arguments, const fs::path& folder, bool with_links) {
  cli::SignalInbox inbox;
  cli::ProgressBar bar;
  StackPlan plan;
  plan.programs = arguments.programs;
  plan.own = fs::path{TRIVELA_BINARY_DIR} / "tests";
  plan.folder = folder;
  plan.with_links = with_links;
  plan.seed = arguments.seed;
  const std::vector<Fault> faults = faults_of(arguments, with_links);
  Watch watch;
  watch.limit_s = arguments.limit_s;
  watch.progress = [&](std::size_t done, const Fault& fault) {
    bar.show(static_cast<double>(done), static_cast<double>(faults.size()), "faults",
             fmt::format("{:<60}", text(fault)));
  };
  watch.look = [&] {
    if (inbox.stop_requested()) throw std::runtime_error{"interrupted"};
  };
  FireRules rules;
  rules.steady_t_ns = !arguments.arrivals_only;
  Verdict verdict;
  verdict.seed = arguments.seed;
  const auto began = std::chrono::steady_clock::now();
  Stack stack{plan};
  verdict.trials = run_campaign(stack, faults, watch);
  stack.stop_all();
  verdict.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  verdict.orders = stack.wire().orders.size();
  const Testimony device = with_drivers_words(stack.device(), stack.wire(), verdict.trials);
  verdict.fires = fires_carried_out(device, stack.wire(), rules);
  verdict.findings = judge(device, stack.wire(), rules);
  verdict.forged = take_forged(verdict.findings, stack.garbled_to_driver());
  const KickRows rows = read_kick_rows(stack.logs());
  verdict.logged = look_up(verdict.fires, rows, rules.steady_t_ns);
  verdict.unreadable = rows.unreadable;
  verdict.frames = stack.hub_counts();
  if (!arguments.log_dir.empty()) write_events(folder / "events.txt", stack);
  return verdict;
}

int run(const Arguments& arguments) {
  const std::string obstacle = arguments.loopback ? "--loopback" : NetworkHost::obstacle();
  if (!obstacle.empty()) fmt::print("faults of links are left out ({}): the nodes share the loopback\n", obstacle);
  const tests::Folder temporary;
  const Verdict verdict = campaign(arguments, prepared(arguments.log_dir, temporary), obstacle.empty());
  fmt::print("{}", text(verdict));
  if (!arguments.json.empty()) std::ofstream{arguments.json} << json(verdict).dump(2) << "\n";
  if (!verdict.clean()) return 1;
  return obstacle.empty() ? 0 : kSkipped;
}

}  // namespace
}  // namespace trivela::faults

int main(int argc, char** argv) {
  using namespace trivela::faults;
  CLI::App app{"Faults at a running robot, one after the other, judged by witnesses outside of it"};
  Arguments arguments;
  app.add_option("--faults", arguments.faults, "how many")->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--stalls", arguments.stalls, "instead: so many stalls of 0.5 to 2 s of each node in turn");
  app.add_option("--referee-losses", arguments.referee_losses,
                 "instead: so many rounds of seven ways to lose the referee while it lets play");
  app.add_option("--seed", arguments.seed, "of faults and matches")->capture_default_str();
  app.add_option("--log-dir", arguments.log_dir, "keep configuration, logs and what everybody said in this folder");
  app.add_option("--json", arguments.json, "write the table to this file, too");
  app.add_option("--programs", arguments.programs, "folder of the nodes' programs")->capture_default_str();
  app.add_option("--limit-s", arguments.limit_s, "to be whole again after a fault")->capture_default_str();
  app.add_flag("--loopback", arguments.loopback, "one network for all, no faults of links");
  app.add_flag("--arrivals-only", arguments.arrivals_only,
               "the stack's t_ns is not CLOCK_MONOTONIC: judge by arrivals");
  try {
    app.parse(argc, argv);
    return run(arguments);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "fault_campaign: {}\n", error.what());
    return 1;
  }
}

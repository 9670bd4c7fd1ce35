// How long a robot is without a decision when its first decision node is killed or hangs: from the signal until the
// first drive command of the second is heard, by a process that looks on.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/reader.hpp"
#include "idl/messages.hpp"
#include "nodes/runtime/node_main.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/faults/real_time_stack.hpp"

namespace {

using namespace trivela;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kTimeout{60};
constexpr const char* kFirst = "kick_decision";
constexpr const char* kSecond = "kick_decision_second";

/// Looks on at the robot's drive commands.
class Onlooker {
 public:
  explicit Onlooker(const config::Settings& settings)
      : drive_(bus::Participant{nodes::domain_of(settings.domain)}, {.observer = true}) {}

  /// Waits for a command of a node, and says when it came. Throws std::runtime_error where none comes.
  Clock::time_point receive(const std::string& node) {
    const std::string owner = node + "/1";
    for (const auto end = Clock::now() + kTimeout; Clock::now() < end;) {
      drive_.wait(std::chrono::milliseconds{10});
      bool received = false;
      drive_.take([&](const msg::DriveCommand&, const bus::SampleInfo& info) { received |= info.owner == owner; });
      if (received) return Clock::now();
    }
    throw std::runtime_error{"nothing is heard of " + node};
  }

  /// Waits until so much time goes by without a command of a node, while others speak.
  void wait_for_silence(const std::string& node, std::chrono::milliseconds length) {
    const std::string owner = node + "/1";
    const auto end = Clock::now() + kTimeout;
    for (auto last = Clock::now(); Clock::now() - last < length;) {
      if (Clock::now() > end) throw std::runtime_error{node + " does not give back"};
      drive_.wait(std::chrono::milliseconds{10});
      drive_.take([&](const msg::DriveCommand&, const bus::SampleInfo& info) {
        if (info.owner == owner) last = Clock::now();
      });
    }
  }

 private:
  bus::Reader<msg::DriveCommand> drive_;
};

/// Strikes the first with the signal, and brings it back; in ms.
double takeover_ms(faults::RealTimeStack& stack, Onlooker& onlooker, int signal) {
  onlooker.receive(kFirst);
  const auto struck = Clock::now();
  stack.signal(kFirst, signal);
  const double length_ms = std::chrono::duration<double, std::milli>(onlooker.receive(kSecond) - struck).count();
  if (signal == SIGKILL) {
    stack.restart(kFirst);
  } else {
    stack.signal(kFirst, SIGCONT);
  }
  onlooker.wait_for_silence(kSecond, std::chrono::milliseconds{300});
  return length_ms;
}

/// Prints them; whether all keep the goal.
bool report(const char* what, std::vector<double> lengths_ms, double goal_ms) {
  std::ranges::sort(lengths_ms);
  const auto late = std::ranges::count_if(lengths_ms, [&](double ms) { return ms > goal_ms; });
  std::printf("%-7s %3zu times: shortest %.1f ms, median %.1f ms, longest %.1f ms, over %.0f ms: %td\n", what,
              lengths_ms.size(), lengths_ms.front(), lengths_ms[lengths_ms.size() / 2], lengths_ms.back(), goal_ms,
              late);
  return late == 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"How long a robot is without a decision when its first decision node falls silent"};
  int times = 20;
  double goal_ms = 150.0;
  bool goals = false;
  app.add_option("--times", times, "kills, and as many hangs")->check(CLI::Range(1, 200))->capture_default_str();
  app.add_option("--goal-ms", goal_ms, "longest takeover")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_flag("--goals", goals, "end with 3 where one took longer");
  CLI11_PARSE(app, argc, argv);
  try {
    faults::RealTimeStack stack{1.0 + times * 2 * 8.0 / 60.0, {.standby = true}};
    Onlooker onlooker{stack.settings()};
    std::vector<double> kills_ms, hangs_ms;
    for (int i = 0; i < times; ++i) {
      kills_ms.push_back(takeover_ms(stack, onlooker, SIGKILL));
      hangs_ms.push_back(takeover_ms(stack, onlooker, SIGSTOP));
    }
    stack.stop();
    const bool kept = report("killed", kills_ms, goal_ms) & report("hung", hangs_ms, goal_ms);
    const e2e::Reader log{stack.log()};
    const auto number = [&](const char* sql) { return static_cast<long long>(e2e::number_of(log, sql)); };
    std::printf("%lld possessions, %lld ended with a kick; the driver fired %lld times\n",
                number("SELECT count(*) FROM possession_truths"),
                number("SELECT count(*) FROM possession_truths WHERE ending = 'kicked'"),
                number("SELECT count(*) FROM kick_receipts WHERE accepted = 1"));
    return goals && !kept ? 3 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "standby_bench: %s\n", error.what());
    return 1;
  }
}

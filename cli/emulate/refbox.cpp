#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cmath>

#include "cli/emulate/devices.hpp"
#include "cli/launch/signals.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "emulators/refbox/box_act.hpp"
#include "emulators/refbox/emulated_box.hpp"
#include "hal/refbox/refbox_client.hpp"

namespace trivela::cli {
namespace {

namespace box = hal::refbox;
using BoxClock = std::chrono::steady_clock;

struct RefboxFlags {
  std::string script;
  std::string replay;
  int port = box::kLeaguePort;
  bool letters = false;
  bool network = false;
  box::BoxConfig teams;
  int wait_for = 1;
  double speed = 1.0;
};

/// Keys come one by one while it lives, where standard input is a terminal.
class SingleKeys {
 public:
  SingleKeys() : terminal_(::isatty(STDIN_FILENO) != 0 && ::tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!terminal_) return;
    termios single = before_;
    single.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &single);
  }
  SingleKeys(const SingleKeys&) = delete;
  SingleKeys& operator=(const SingleKeys&) = delete;
  ~SingleKeys() {
    if (terminal_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }

 private:
  termios before_{};
  bool terminal_;
};

std::string in_words(const box::BoxAct& act) {
  if (const auto* const fault = std::get_if<box::BoxFault>(&act)) {
    for (const auto& known : box::kBoxFaults) {
      if (known.fault == *fault) return fmt::format("fault {}", known.name);
    }
  }
  const box::BoxCommand& said = std::get<box::BoxCommand>(act);
  std::string text(box::name(said.kind));
  if (said.team) text += *said.team == 0 ? " left" : " right";
  if (said.robot_id) text += fmt::format(" {}", *said.robot_id);
  return text;
}

/// A box with its prompt or its script.
class BoxSession {
 public:
  BoxSession(const box::BoxConfig& config, double speed) : box_(config), speed_(speed) {
    say(fmt::format("tcp://127.0.0.1:{}\n", box_.port()));
    std::fflush(stdout);
  }

  /// Until somebody asks to stop.
  void take_keys() {
    const SingleKeys keys;
    say(box::kKeyHelp);
    std::fflush(stdout);
    began_ = BoxClock::now();
    bool open = true;
    while (!signals_.stop_requested()) {
      pollfd sources[2]{{signals_.file_descriptor(), POLLIN, 0}, {open ? STDIN_FILENO : -1, POLLIN, 0}};
      ::poll(sources, 2, -1);
      char key = 0;
      if (sources[1].revents == 0) continue;
      open = ::read(STDIN_FILENO, &key, 1) == 1;
      if (key == '?') say(box::kKeyHelp);
      if (const auto act = open ? box::act_of_key(key) : std::nullopt) perform(*act);
    }
  }

  /// To the end of the steps, which begin when so many teams are there; false: somebody asked to stop.
  bool follow(const std::vector<box::BoxStep>& steps, int wait_for) {
    while (!box_.wait_for_teams(static_cast<std::size_t>(wait_for), std::chrono::milliseconds{100}))
      if (signals_.stop_requested()) return false;
    began_ = BoxClock::now();
    for (const box::BoxStep& step : steps) {
      const auto due = began_ + std::chrono::nanoseconds{std::llround(step.at_s / speed_ * 1e9)};
      for (auto now = BoxClock::now(); now < due; now = BoxClock::now()) {
        pollfd inbox{signals_.file_descriptor(), POLLIN, 0};
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(due - now);
        ::poll(&inbox, 1, static_cast<int>(std::min<std::int64_t>(left.count(), 1000)));
        if (signals_.stop_requested()) return false;
      }
      perform(step.act);
    }
    return true;
  }

  /// What the teams have sent.
  void report() const {
    for (const std::size_t team : {0U, 1U}) {
      const box::TeamReport sent = box_.report(team);
      const char* const name = team == 0 ? "left" : "right";
      if (sent.objects + sent.problems == 0) {
        say(fmt::format("{}: sent nothing\n", name));
        continue;
      }
      say(fmt::format("{}: {} worldstates, {:.1f} a second\n", name, sent.objects, sent.rate_hz));
      if (sent.problems > 0)
        say(fmt::format("{}: {} objects that the league's box would not log, the last since {}\n", name, sent.problems,
                        sent.last_problem));
    }
  }

 private:
  void perform(const box::BoxAct& act) {
    box_.act(act);
    say(fmt::format("{:8.2f} s  {}\n", std::chrono::duration<double>(BoxClock::now() - began_).count(), in_words(act)));
    std::fflush(stdout);
  }

  SignalInbox signals_;  // before the box's thread, which must not take them
  box::EmulatedBox box_;
  double speed_;
  BoxClock::time_point began_{};
};

int run_refbox(const RefboxFlags& flags) {
  box::BoxConfig config = flags.teams;
  config.port = static_cast<std::uint16_t>(flags.port);
  config.on_network = flags.network;
  if (flags.letters) config.protocol = box::Protocol::kLetters;
  std::vector<box::BoxStep> steps;
  if (!flags.script.empty()) steps = box::read_box_script(config::read_text_file(flags.script), flags.script);
  if (!flags.replay.empty()) steps = box::read_box_log(config::read_text_file(flags.replay), flags.replay);
  BoxSession session(config, flags.speed);
  if (flags.script.empty() && flags.replay.empty()) {
    session.take_keys();
  } else {
    session.follow(steps, flags.wait_for);
  }
  session.report();
  return kDone;
}

}  // namespace

void add_refbox(CLI::App& app, int& exit_code) {
  const auto [verb, flags] = add_verb(app, exit_code, "refbox", "The league's referee box for two teams", run_refbox);
  verb->footer("Prints the address to connect to. Without --script and --replay keys say what the box says:\n" +
               std::string(box::kKeyHelp));
  auto* script = verb->add_option("--script", flags->script,
                                  "say this: lines of SECONDS COMMAND [left|right [ROBOT]] or SECONDS fault NAME")
                     ->check(readable_file());
  verb->add_option("--replay", flags->replay, "say again what a box's text log has (TIME.msl)")
      ->check(readable_file())
      ->excludes(script);
  add_default(*verb, "--teams", flags->wait_for, "script, replay: begin when so many teams are connected",
              CLI::Range(0, 2));
  add_default(*verb, "--speed", flags->speed, "script, replay: so many times as fast", CLI::Range(0.01, 1000.0));
  add_default(*verb, "--port", flags->port, "0: any", CLI::Range(0, 65535));
  verb->add_flag("--network", flags->network, "listen on every interface, not on the loopback alone");
  verb->add_flag("--letters", flags->letters, "speak the protocol of one letter, to version 1.5.0");
  add_default(*verb, "--left", flags->teams.groups[0], "multicast group of the left team");
  add_default(*verb, "--right", flags->teams.groups[1], "multicast group of the right team");
}

}  // namespace trivela::cli

#include "tests/faults/campaign.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>

#include "kicking/geometry/time.hpp"
#include "tests/faults/drivers_words.hpp"

namespace trivela::faults {
namespace {

using kicking::seconds;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::array<const char*, 7> kPeriodic{"referee", "vision",        "odometry",    "world_state",
                                               "drive",   "kicker_status", "device/drive"};
constexpr double kStart_s = 90.0;    // for the whole chain, on a busy machine
constexpr double kRefusal_s = 20.0;  // for a twin
constexpr double kPlay_s = 5.0;      // longest stop, with what a busy machine adds
constexpr double kBeside_s = 2.0;
constexpr double kEnd_s = 10.0;                    // for a node after SIGTERM
constexpr std::int64_t kFresh_ns = 300'000'000;    // a periodic topic that lives was heard so lately
constexpr std::chrono::milliseconds kCommit{150};  // a recorder that lives writes within

std::int64_t now_ns() { return Clock::now().time_since_epoch().count(); }

std::chrono::nanoseconds nanoseconds(double time_s) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Seconds{time_s});
}

/// Whether the chain is whole, from what comes after an instant.
class Wholeness {
 public:
  Wholeness(Stack& stack, bool with_outcome)
      : stack_(stack),
        with_outcome_(with_outcome),
        since_ns_(now_ns()),
        since_file_(std::filesystem::file_time_type::clock::now()),
        fires_before_(stack.device().fires.size()) {}

  bool look() {
    look_at_streams();
    look_at_fires();
    return missing().empty();
  }

  std::int64_t since_ns() const { return since_ns_; }
  double streams_s() const { return seconds(since_ns_, *std::max_element(received_ns_.begin(), received_ns_.end())); }
  double kick_s() const { return seconds(since_ns_, fired_ns_); }

  /// What has not come yet.
  std::vector<std::string> missing() const {
    std::vector<std::string> out;
    const std::int64_t now = now_ns();
    for (std::size_t i = 0; i < kPeriodic.size(); ++i) {
      if (received_ns_[i] == 0 || now - last_ns(i) > kFresh_ns) out.emplace_back(kPeriodic[i]);
    }
    if (fired_ns_ == 0) out.emplace_back("a kick");
    if (with_outcome_ && !outcome_) out.emplace_back("an outcome");
    const auto written = stack_.log_changed();
    if (!written || *written < since_file_ + kCommit) out.emplace_back("rows of the recorder");
    return out;
  }

 private:
  std::int64_t last_ns(std::size_t stream) const {
    const auto found = stack_.wire().last_sample_ns.find(kPeriodic[stream]);
    return found == stack_.wire().last_sample_ns.end() ? 0 : found->second;
  }

  void look_at_streams() {
    for (std::size_t i = 0; i < kPeriodic.size(); ++i) {
      if (received_ns_[i] == 0 && last_ns(i) > since_ns_) received_ns_[i] = last_ns(i);
    }
  }

  void look_at_fires() {
    const auto& fires = stack_.device().fires;
    const auto& orders = stack_.wire().orders;
    for (std::size_t i = fires_before_; i < fires.size(); ++i) {
      if (fires[i].withdrawn) continue;
      const auto before = std::find_if(orders.rbegin(), orders.rend(),
                                       [&](const OrderSeen& order) { return order.arrival_ns <= since_ns_; });
      const bool ordered_since = std::any_of(orders.rbegin(), before,
                                             [&](const OrderSeen& order) { return order.kick_id == fires[i].kick_id; });
      if (!ordered_since) continue;
      if (fired_ns_ == 0) fired_ns_ = fires[i].arrival_ns;
      outcome_ = outcome_ || stack_.wire().outcome_arrival_ns.contains(fires[i].kick_id);
    }
  }

  Stack& stack_;
  bool with_outcome_;
  std::int64_t since_ns_;
  std::filesystem::file_time_type since_file_;
  std::size_t fires_before_;
  std::array<std::int64_t, kPeriodic.size()> received_ns_{};
  std::int64_t fired_ns_ = 0;
  bool outcome_ = false;
};

class Campaign {
 public:
  Campaign(Stack& stack, const Watch& watch) : stack_(stack), watch_(watch) {}

  void start() {
    stack_.start_all();
    Wholeness whole{stack_, true};
    const auto ready = [&] {
      for (std::size_t node = 0; node < kNodes.size(); ++node) {
        if (stack_.has(node) && !stack_.running(node))
          throw std::runtime_error{fmt::format("{} did not stay", kNodes[node])};
      }
      return whole.look();
    };
    if (!wait(kStart_s, ready))
      throw std::runtime_error{
          fmt::format("the chain is not whole after {} s: no {}", kStart_s, fmt::join(whole.missing(), ", "))};
  }

  /// Nothing is left to make faults at.
  bool over() const { return over_; }

  Trial suffer(const Fault& fault) {
    Trial trial;
    trial.fault = fault;
    stack_.insist(fault.insists);
    wait(fault.waits_s);
    if (kNodes[fault.node] == "referee") wait(kPlay_s, [&] { return lets_play(); });
    trial.began_ns = now_ns();
    if (on_link(fault.kind)) {
      stack_.disturb(fault);
      wait(fault.lasts_s);
      stack_.sound();
    } else {
      trouble_process(fault, trial);
    }
    // While an unauthorised writer is stronger nobody else is heard; from now on kick_decision has to be.
    if (fault.insists == Insists::kUnauthorised) stack_.insist(Insists::kNobody);
    recover(trial);
    stack_.insist(Insists::kNobody);
    trial.whole_ns = now_ns();
    if (garbles_driver(trial.fault)) stack_.renew_device_witness();
    return trial;
  }

 private:
  bool wait(
      double time_s, const std::function<bool()>& done = [] { return false; }) {
    return stack_.listen(nanoseconds(time_s), [&] {
      if (watch_.look) watch_.look();
      return done();
    });
  }

  bool lets_play() const { return !stack_.wire().words.empty() && stack_.wire().words.back().playing; }

  void trouble_process(const Fault& fault, Trial& trial) {
    NodeProcess& node = stack_.node(fault.node);
    switch (fault.kind) {
      case FaultKind::kKill:
        node.signal(SIGKILL);
        wait(kEnd_s, [&] { return node.ended(); });
        wait(fault.lasts_s);
        return stack_.start(fault.node);
      case FaultKind::kStop:
        node.signal(SIGSTOP);
        wait(fault.lasts_s);
        return node.signal(SIGCONT);
      case FaultKind::kRestart:
        node.signal(SIGTERM);
        if (!wait(kEnd_s, [&] { return node.ended(); }))
          trial.complaint = fmt::format("{} did not end within {} s of SIGTERM", kNodes[fault.node], kEnd_s);
        else if (node.code() != 0)
          trial.complaint = fmt::format("{} ended with {} after SIGTERM", kNodes[fault.node], *node.code());
        wait(fault.lasts_s);
        return stack_.start(fault.node);
      case FaultKind::kSilence:
        node.tell(1);
        wait(fault.lasts_s);
        return node.tell(0);
      default:
        return start_twin(fault, trial);
    }
  }

  void start_twin(const Fault& fault, Trial& trial) {
    const auto twin = stack_.twin(fault.node);
    if (kNodes[fault.node] == "recorder") return record_beside(*twin, trial);
    if (!wait(kRefusal_s, [&] { return twin->ended(); }))
      trial.complaint = fmt::format("a second {} did not refuse within {} s", kNodes[fault.node], kRefusal_s);
    else if (twin->code() != 1)
      trial.complaint = fmt::format("a second {} ended with {}", kNodes[fault.node], *twin->code());
  }

  /// A second recorder writes a file of its own, and so loses nothing.
  void record_beside(NodeProcess& twin, Trial& trial) {
    wait(kBeside_s, [&] { return twin.ended(); });
    twin.signal(SIGTERM);
    if (!wait(kEnd_s, [&] { return twin.ended(); }) || twin.code() != 0)
      trial.complaint = fmt::format("a second recorder ended with {}", twin.code().value_or(-1));
  }

  void recover(Trial& trial) {
    Wholeness whole{stack_, kNodes[trial.fault.node] == "shot_observer" ||
                                (trial.fault.other && kNodes[*trial.fault.other] == "shot_observer")};
    trial.ended_ns = whole.since_ns();
    std::vector<std::string> ended;
    trial.recovered = wait(watch_.limit_s, [&] {
      for (std::size_t node = 0; node < kNodes.size(); ++node) {
        if (!stack_.has(node) || stack_.running(node)) continue;
        const int code = stack_.node(node).code().value_or(-1);
        // Cyclone's parsers are not hardened: what a garbled packet may cost is the process, and who launches it starts
        // it again.
        const bool by_signal = code > 128 && trial.fault.kind == FaultKind::kGarble;
        (by_signal ? trial.crashed : ended).push_back(fmt::format("{} ended by itself with {}", kNodes[node], code));
        stack_.start(node);
      }
      return whole.look();
    });
    if (!ended.empty())
      trial.complaint =
          fmt::format("{}{}{}", trial.complaint, trial.complaint.empty() ? "" : "; ", fmt::join(ended, "; "));
    if (trial.recovered) {
      trial.streams_s = whole.streams_s();
      trial.kick_s = whole.kick_s();
      return;
    }
    trial.complaint =
        fmt::format("{}{}not whole after {} s: no {}", trial.complaint, trial.complaint.empty() ? "" : "; ",
                    watch_.limit_s, fmt::join(whole.missing(), ", "));
    stack_.stop_all();
    stack_.renew_device_witness();
    try {
      start();
    } catch (const std::runtime_error& error) {
      trial.complaint += fmt::format("; started again, {}", error.what());
      over_ = true;
    }
  }

  Stack& stack_;
  const Watch& watch_;
  bool over_ = false;
};

}  // namespace

std::vector<Trial> run_campaign(Stack& stack, const std::vector<Fault>& faults, const Watch& watch) {
  Campaign campaign{stack, watch};
  campaign.start();
  std::vector<Trial> trials;
  for (const Fault& fault : faults) {
    if (watch.progress) watch.progress(trials.size(), fault);
    trials.push_back(campaign.suffer(fault));
    if (campaign.over()) break;
  }
  return trials;
}

}  // namespace trivela::faults

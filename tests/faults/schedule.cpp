#include "tests/faults/schedule.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace trivela::faults {
namespace {

using Random = std::mt19937_64;

// std::shuffle and std's distributions may differ from library to library; a seed's campaign may not.
double uniform(Random& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Even on the scale of lengths: as many faults from 0.1 to 0.2 s as from 1 to 2 s.
double spread(Random& random, double from, double to) {
  return std::exp(uniform(random, std::log(from), std::log(to)));
}

/// Cards in an order of chance; all of them come before one comes again.
template <class T>
class Deck {
 public:
  explicit Deck(std::vector<T> cards) : cards_(std::move(cards)) {}
  T draw(Random& random) {
    if (next_ == 0) {
      for (std::size_t i = cards_.size(); i > 1; --i) std::swap(cards_[i - 1], cards_[random() % i]);
    }
    const T& card = cards_[next_];
    next_ = (next_ + 1) % cards_.size();
    return card;
  }

 private:
  std::vector<T> cards_;
  std::size_t next_ = 0;
};

struct Target {
  std::size_t node;
  std::optional<std::size_t> other;
};

/// In half of the faults that leave the way to an order alone; an unauthorised one in every other one of them.
Insists insists(const Fault& fault, Random& random, Insists before) {
  const bool drawn = random() % 2 == 0;
  for (const std::string_view name : {"odometry", "world_state", "kick_decision"}) {
    if (fault.node == node_index(name) || fault.other == node_index(name)) return Insists::kNobody;
  }
  if (!drawn) return Insists::kNobody;
  return before == Insists::kUnauthorised ? Insists::kInItsName : Insists::kUnauthorised;
}

std::vector<Target> targets_of(FaultKind kind, bool with_links) {
  std::vector<Target> targets;
  for (std::size_t node = 0; node < kNodes.size(); ++node) {
    if (with_links || node != node_index("referee")) targets.push_back({node, std::nullopt});
  }
  if (!on_link(kind)) return targets;
  for (const auto& [from, to] : links()) targets.push_back({from, to});
  return targets;
}

void set_way(Fault& fault, Random& random) {
  const auto ms = [](double value) { return std::chrono::microseconds{std::llround(value * 1000.0)}; };
  if (fault.kind == FaultKind::kCut) fault.way.drop = 1.0;
  if (fault.kind == FaultKind::kGarble) fault.way.garble = spread(random, 0.01, 0.3);
  if (fault.kind != FaultKind::kDelay) return;
  const double delay_ms = spread(random, 2.0, 300.0);
  fault.way.delay = ms(delay_ms);
  fault.way.jitter = ms(uniform(random, 0.0, delay_ms));
}

double length_s(FaultKind kind, Random& random) {
  constexpr double kLongCut = 0.1;  // share of cuts that outlast the participants' lease of 5 s
  switch (kind) {
    case FaultKind::kKill:
      return uniform(random, 0.0, 1.5);
    case FaultKind::kStop:
      return spread(random, 0.05, 2.0);
    case FaultKind::kRestart:
    case FaultKind::kTwin:
      return 0.0;
    case FaultKind::kSilence:
      return uniform(random, 0.5, 4.0);
    case FaultKind::kCut:
      return uniform(random, 0.0, 1.0) < kLongCut ? uniform(random, 5.5, 8.0) : spread(random, 0.05, 3.0);
    case FaultKind::kDelay:
    case FaultKind::kGarble:
      return uniform(random, 0.5, 3.0);
  }
  return 0.0;
}

}  // namespace

std::size_t node_index(std::string_view name) {
  const auto found = std::find(kNodes.begin(), kNodes.end(), name);
  if (found == kNodes.end()) throw std::invalid_argument{fmt::format("no node {}", name)};
  return static_cast<std::size_t>(found - kNodes.begin());
}

std::vector<std::pair<std::size_t, std::size_t>> links() {
  constexpr std::pair<std::string_view, std::string_view> kLinks[]{
      {"simulator", "odometry"},          {"simulator", "world_state"},     {"simulator", "kicker_driver"},
      {"simulator", "shot_observer"},     {"simulator", "recorder"},        {"odometry", "world_state"},
      {"odometry", "recorder"},           {"world_state", "kick_decision"}, {"world_state", "recorder"},
      {"kick_decision", "odometry"},      {"kick_decision", "recorder"},    {"kick_decision", "kicker_driver"},
      {"kicker_driver", "shot_observer"}, {"kicker_driver", "recorder"},    {"shot_observer", "kick_decision"},
      {"shot_observer", "recorder"},      {"simulator", "referee"},         {"referee", "world_state"},
      {"referee", "kicker_driver"},       {"referee", "shot_observer"},     {"referee", "recorder"}};
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const auto& [from, to] : kLinks) found.emplace_back(node_index(from), node_index(to));
  return found;
}

const char* name(FaultKind kind) {
  switch (kind) {
    case FaultKind::kKill:
      return "kill";
    case FaultKind::kStop:
      return "stop";
    case FaultKind::kRestart:
      return "restart";
    case FaultKind::kTwin:
      return "twin";
    case FaultKind::kSilence:
      return "silence";
    case FaultKind::kDelay:
      return "delay";
    case FaultKind::kCut:
      return "cut";
    case FaultKind::kGarble:
      return "garble";
  }
  return "";
}

bool on_link(FaultKind kind) {
  return kind == FaultKind::kDelay || kind == FaultKind::kCut || kind == FaultKind::kGarble;
}

std::string text(const Fault& fault) {
  std::string out = fmt::format("{} {}", name(fault.kind), kNodes[fault.node]);
  if (fault.other) out += fmt::format("-{}", kNodes[*fault.other]);
  if (fault.lasts_s > 0.0) out += fmt::format(" {:.2f} s", fault.lasts_s);
  const auto ms = [](std::chrono::microseconds time) { return static_cast<double>(time.count()) / 1000.0; };
  if (fault.kind == FaultKind::kDelay)
    out += fmt::format(", {:.0f} to {:.0f} ms", ms(fault.way.delay), ms(fault.way.delay + fault.way.jitter));
  if (fault.kind == FaultKind::kGarble) out += fmt::format(", {:.0f} % of the frames", 100.0 * fault.way.garble);
  if (fault.insists == Insists::kInItsName) out += ", insisting";
  if (fault.insists == Insists::kUnauthorised) out += ", an unauthorised client insisting";
  return out;
}

std::vector<Fault> draw_faults(std::size_t count, std::uint64_t seed, bool with_links) {
  Random random{seed};
  std::vector<FaultKind> kinds{FaultKind::kKill, FaultKind::kStop, FaultKind::kRestart, FaultKind::kTwin};
  if (with_links) kinds.insert(kinds.end(), {FaultKind::kDelay, FaultKind::kCut, FaultKind::kGarble});
  std::vector<Deck<Target>> targets;
  for (int kind = 0; kind <= static_cast<int>(FaultKind::kGarble); ++kind)
    targets.emplace_back(targets_of(static_cast<FaultKind>(kind), with_links));
  Deck<FaultKind> deck{kinds};
  std::vector<Fault> faults;
  Insists last = Insists::kUnauthorised;  // who insisted last
  while (faults.size() < count) {
    Fault fault;
    fault.kind = deck.draw(random);
    const Target target = targets[static_cast<std::size_t>(fault.kind)].draw(random);
    fault.node = target.node;
    fault.other = target.other;
    // A second referee would be heard like the first one.
    if (fault.kind == FaultKind::kTwin && fault.node == node_index("referee")) fault.kind = FaultKind::kSilence;
    fault.waits_s = uniform(random, 0.0, 1.0);
    fault.lasts_s = length_s(fault.kind, random);
    fault.insists = insists(fault, random, last);
    if (fault.insists != Insists::kNobody) last = fault.insists;
    set_way(fault, random);
    faults.push_back(fault);
  }
  return faults;
}

std::vector<Fault> draw_stalls(std::size_t rounds, std::uint64_t seed) {
  Random random{seed};
  std::vector<Fault> faults;
  Insists last = Insists::kUnauthorised;  // who insisted last
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t node = 0; node < kNodes.size(); ++node) {
      if (node == node_index("referee")) continue;
      Fault fault;
      fault.kind = FaultKind::kStop;
      fault.node = node;
      fault.waits_s = uniform(random, 0.0, 1.0);
      fault.lasts_s = uniform(random, 0.5, 2.0);
      fault.insists = insists(fault, random, last);
      if (fault.insists != Insists::kNobody) last = fault.insists;
      faults.push_back(fault);
    }
  }
  return faults;
}

std::vector<Fault> draw_referee_losses(std::size_t rounds, std::uint64_t seed) {
  Random random{seed};
  const std::size_t referee = node_index("referee");
  std::vector<Fault> faults;
  Insists insisting = Insists::kNobody;
  const auto add = [&](FaultKind kind, std::optional<std::size_t> other = std::nullopt) {
    Fault fault;
    fault.kind = kind;
    fault.node = referee;
    fault.other = other;
    fault.waits_s = uniform(random, 0.0, 1.0);
    fault.lasts_s = uniform(random, 1.5, 4.0);
    fault.insists = insisting;
    set_way(fault, random);
    faults.push_back(fault);
  };
  for (std::size_t round = 0; round < rounds; ++round) {
    insisting = round % 2 == 0 ? Insists::kInItsName : Insists::kNobody;
    for (const FaultKind kind :
         {FaultKind::kKill, FaultKind::kRestart, FaultKind::kStop, FaultKind::kSilence, FaultKind::kCut})
      add(kind);
    add(FaultKind::kCut, node_index("kicker_driver"));
    add(FaultKind::kCut, node_index("world_state"));
  }
  return faults;
}

}  // namespace trivela::faults

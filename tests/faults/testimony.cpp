#include "tests/faults/testimony.hpp"

#include <sstream>
#include <stdexcept>

namespace trivela::faults {

void Testimony::note(const std::string& line) {
  std::istringstream in{line};
  std::int64_t arrival_ns = 0;
  std::string what;
  in >> arrival_ns >> what;
  if (what == "sample") {
    std::string topic;
    in >> topic;
    last_sample_ns[topic] = arrival_ns;
  } else if (what == "referee") {
    bool playing = false;
    in >> playing;
    words.push_back({arrival_ns, playing});
    last_sample_ns["referee"] = arrival_ns;
  } else if (what == "order" || what == "decision") {
    OrderSeen order{arrival_ns};
    in >> order.t_ns >> order.kick_id >> order.fire_t_ns >> order.valid_until_t_ns;
    (what == "order" ? orders : decided).push_back(order);
  } else if (what == "fire") {
    FireSeen fire{arrival_ns};
    in >> fire.t_ns >> fire.kick_id >> fire.withdrawn;
    fires.push_back(fire);
  } else if (what == "truth") {
    TruthSeen truth{arrival_ns};
    in >> truth.release_t_ns >> truth.kick_id;
    truths.push_back(truth);
  } else if (what == "outcome") {
    std::int64_t kick_id = 0;
    in >> kick_id;
    outcome_arrival_ns.try_emplace(kick_id, arrival_ns);
  } else if (what == "estimate") {
    last_sample_ns["kicker_estimate"] = arrival_ns;
  } else {
    in.setstate(std::ios::failbit);
  }
  if (!in) throw std::runtime_error{"the witness says \"" + line + "\""};
}

}  // namespace trivela::faults

#include "tests/faults/stream_witness.hpp"

#include <map>

#include "bus/reader.hpp"
#include "idl/messages.hpp"

namespace trivela::faults {
namespace {

bus::ReaderOptions everything() { return {.period = {}, .keep_all = true, .on_liveliness = {}}; }

}  // namespace

struct StreamWitness::Subscribers {
  explicit Subscribers(const config::Settings& settings)
      : participant(bus::loopback(settings.domain.domain_id, settings.domain.tag)),
        wheels(participant, everything()),
        odometry(participant, everything()),
        world(participant, everything()),
        drive(participant, everything()),
        status(participant, everything()),
        decisions(participant, everything()) {}

  bus::Participant participant;
  bus::Reader<msg::DeviceWheels> wheels;
  bus::Reader<msg::Odometry> odometry;
  bus::Reader<msg::WorldState> world;
  bus::Reader<msg::DriveCommand> drive;
  bus::Reader<msg::KickerStatus> status;
  bus::Reader<msg::KickDecision> decisions;
};

StreamWitness::StreamWitness(const config::Settings& settings)
    : subscribers_(std::make_unique<Subscribers>(settings)) {}
StreamWitness::~StreamWitness() = default;

std::vector<std::string> StreamWitness::deaf_within(std::chrono::milliseconds span) {
  const auto until = std::chrono::steady_clock::now() + span;
  std::map<std::string, int> received{
      {"odometry hears device/wheels", 0},      {"world_state hears odometry", 0},
      {"world_state hears vision", 0},          {"kick_decision hears world_state", 0},
      {"kicker_driver hears device/kicker", 0}, {"kick_decision hears kicker_status", 0},
      {"the witness hears the simulator", 0}};
  int decided = 0;
  while (std::chrono::steady_clock::now() < until) {
    subscribers_->wheels.wait(std::chrono::milliseconds{50});
    subscribers_->wheels.take([&](const msg::DeviceWheels&) { ++received["the witness hears the simulator"]; });
    subscribers_->odometry.take([&](const msg::Odometry&) { ++received["odometry hears device/wheels"]; });
    subscribers_->world.take([&](const msg::WorldState& world) {
      ++received["world_state hears odometry"];
      if (world.ball_known && world.ball_age_s < 0.3) ++received["world_state hears vision"];
    });
    subscribers_->drive.take([&](const msg::DriveCommand&) { ++received["kick_decision hears world_state"]; });
    subscribers_->status.take([&](const msg::KickerStatus&) { ++received["kicker_driver hears device/kicker"]; });
    subscribers_->decisions.take([&](const msg::KickDecision& decision) {
      ++decided;
      if (decision.reason != msg::REASON_STALE_STATE) ++received["kick_decision hears kicker_status"];
    });
  }
  if (decided == 0) received.erase("kick_decision hears kicker_status");
  std::vector<std::string> deaf;
  for (const auto& [stream, samples] : received)
    if (samples < 10) deaf.push_back(stream);
  return deaf;
}

}  // namespace trivela::faults

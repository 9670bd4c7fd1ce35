#include "bus/domain/participant.hpp"

#include <dds/dds.h>
#include <fmt/core.h>

#include <map>
#include <mutex>
#include <set>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/process.hpp"
#include "bus/domain/reader_health.hpp"

namespace trivela::bus {

// One configured domain of this process.
struct Domain {
  DomainConfig config;
  Entity entity;
};

namespace {

/// Opens Cyclone's sockets. It binds those that receive to every address, also where its only interface is the
/// loopback: then anybody on the network could send to them, past the interface that was named.
Entity open_domain(const DomainConfig& config, const std::string& about) {
  const bool alone = loopback_alone(config.xml);
  const std::set<int> before = alone ? open_to_all() : std::set<int>{};
  Entity entity{checked(dds_create_domain(config.domain_id, config.xml.c_str()), "dds_create_domain", about)};
  if (!alone) return entity;
  for (const int socket : open_to_all())
    if (!before.contains(socket)) receive_loopback_only(socket);
  return entity;
}

std::shared_ptr<const Domain> join(const DomainConfig& config) {
  static std::mutex mutex;
  static std::map<std::uint32_t, std::weak_ptr<const Domain>> domains;
  const std::lock_guard lock(mutex);
  const std::string about = fmt::format("domain {}", config.domain_id);
  if (auto joined = domains[config.domain_id].lock()) {
    if (joined->config != config) throw Error("join", about, "this process is in it with another configuration");
    return joined;
  }
  auto domain = std::make_shared<Domain>();
  domain->config = config;
  if (!config.xml.empty()) domain->entity = open_domain(config, about);
  domains[config.domain_id] = domain;
  return domain;
}

}  // namespace

struct Participant::State {
  std::shared_ptr<const Domain> domain;  // outlives the participant
  std::unique_ptr<ReaderHealth> hearing;
  Entity entity;
  std::chrono::steady_clock::time_point joined = std::chrono::steady_clock::now();
};

Participant::Participant(const DomainConfig& config) : Participant(config, nullptr) {}

Participant::Participant(const DomainConfig& config, RealTime real_time)
    : Participant(config, std::make_unique<ReaderHealth>(std::move(real_time))) {}

Participant::Participant(const DomainConfig& config, std::unique_ptr<ReaderHealth> hearing) {
  require_resources();
  auto domain = join(config);
  const auto handle = checked(dds_create_participant(config.domain_id, nullptr, nullptr), "dds_create_participant",
                              fmt::format("domain {}", config.domain_id));
  state_ = std::make_shared<const State>(State{std::move(domain), std::move(hearing), Entity(handle)});
}

bool Participant::believes(std::int64_t t_ns) const {
  constexpr std::chrono::seconds kFarthestAhead{1};
  const auto latest = std::chrono::steady_clock::now().time_since_epoch() + kFarthestAhead;
  return !state_->hearing || (t_ns >= 0 && std::chrono::nanoseconds{t_ns} <= latest);
}

std::chrono::steady_clock::time_point Participant::joined() const { return state_->joined; }

ReaderHealth* Participant::hearing() const { return state_->hearing.get(); }

std::int32_t Participant::handle() const { return state_->entity.handle(); }

}  // namespace trivela::bus

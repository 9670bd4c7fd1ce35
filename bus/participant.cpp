#include "bus/participant.hpp"

#include <dds/dds.h>
#include <fmt/core.h>

#include <map>
#include <mutex>

#include "bus/entity.hpp"
#include "bus/error.hpp"
#include "bus/resources.hpp"

namespace trivela::bus {

// One configured domain of this process.
struct Domain {
  DomainConfig config;
  Entity entity;
};

namespace {

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
  if (!config.xml.empty())
    domain->entity =
        Entity(checked(dds_create_domain(config.domain_id, config.xml.c_str()), "dds_create_domain", about));
  domains[config.domain_id] = domain;
  return domain;
}

}  // namespace

struct Participant::State {
  std::shared_ptr<const Domain> domain;  // outlives the participant
  Entity entity;
};

Participant::Participant(const DomainConfig& config) {
  require_resources();
  auto domain = join(config);
  const auto handle = checked(dds_create_participant(config.domain_id, nullptr, nullptr), "dds_create_participant",
                              fmt::format("domain {}", config.domain_id));
  state_ = std::make_shared<const State>(State{std::move(domain), Entity(handle)});
}

std::int32_t Participant::handle() const { return state_->entity.handle(); }

}  // namespace trivela::bus

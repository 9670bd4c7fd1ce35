#include "tests/faults/kick_witness.hpp"

#include <fmt/core.h>

#include "config/team/team.hpp"

namespace trivela::faults {
namespace {

bus::ReaderOptions everything() {
  bus::ReaderOptions options;
  options.keep_all = true;
  options.observer = true;
  return options;
}

/// Of a process with robots' witnesses in it each is in a domain of another number; on the wire all are in the robots'.
bus::DomainConfig own_bus(std::uint32_t robot, const std::string& tag) {
  constexpr std::uint32_t kWitnesses = 90;
  const std::uint32_t domain = config::TeamDomains{}.robot;
  bus::DomainConfig own = bus::loopback(kWitnesses + robot, tag);
  const std::string opening = "<Discovery>";
  own.xml.insert(own.xml.find(opening) + opening.size(),
                 fmt::format("<ExternalDomainId>{}</ExternalDomainId>", domain));
  return own;
}

}  // namespace

KickWitness::KickWitness(const NetworkHost& host, std::uint32_t robot, const std::string& tag) {
  on_host(host, [&] {
    truths_ = std::make_unique<bus::Reader<msg::KickTruth>>(bus::Participant{own_bus(robot, tag)}, everything());
  });
}

const std::set<std::int64_t>& KickWitness::kicks() {
  truths_->take([this](const msg::KickTruth& truth) { kicks_.insert(truth.kick_id); });
  return kicks_;
}

}  // namespace trivela::faults

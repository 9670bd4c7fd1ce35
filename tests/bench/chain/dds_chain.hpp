#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bus/domain/domain.hpp"
#include "bus/executor.hpp"
#include "tests/bench/chain/contender.hpp"

namespace trivela::bench {

/// The domain as a node of that name enters it.
using DomainOf = std::function<bus::DomainConfig(const std::string& node)>;

/// The chain as four nodes on the bus, each in a process of its own.
std::vector<Contender::Process> dds_chain(const DomainOf& domain, bus::Executor::Kind kind);

/// What is done before each sample to find the path warm.
struct Rehearsal {
  /// A sample that counts for nothing goes through the same nodes 0.5 ms before: no way for a robot, whose driver would
  /// be sent an order.
  bool dry_sample = false;
  /// The same through nodes of a domain of its own in the same process: the same code, other memory.
  std::optional<bus::DomainConfig> twin = {};
  /// The sensor's thread does not sleep in the last millisecond.
  bool busy_wait = false;
};

/// The chain as four nodes in one process that runs to completion in the sensor's thread.
std::vector<Contender::Process> dds_chain_in_one_process(const bus::DomainConfig& domain,
                                                         const Rehearsal& rehearsal = {});

}  // namespace trivela::bench

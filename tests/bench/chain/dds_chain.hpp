#pragma once

#include <vector>

#include "bus/domain.hpp"
#include "bus/executor.hpp"
#include "tests/bench/chain/contender.hpp"

namespace trivela::bench {

/// The chain as four nodes on the bus, each in a process of its own.
std::vector<Contender::Process> dds_chain(const bus::DomainConfig& domain, bus::Executor::Kind kind);

/// The chain as four nodes in one process that runs to completion in the sensor's thread.
std::vector<Contender::Process> dds_chain_in_one_process(const bus::DomainConfig& domain);

}  // namespace trivela::bench

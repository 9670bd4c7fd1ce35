#pragma once

#include <vector>

#include "bus/domain/domain.hpp"
#include "tests/bench/chain/contender.hpp"

namespace trivela::bench {

/// The chain of bare_cyclone.h in four processes: what our bus costs beside it is the ratio to this.
std::vector<Contender::Process> bare_chain_in_processes(const bus::DomainConfig& domain);

/// The same in one process, which runs to completion in the sensor's thread.
std::vector<Contender::Process> bare_chain_in_one_process(const bus::DomainConfig& domain);

}  // namespace trivela::bench

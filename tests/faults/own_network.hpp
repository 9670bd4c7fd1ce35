#pragma once

namespace trivela::faults {

/// Moves this process, which must not have begun threads, and all that it starts later into a network of its own: a
/// loopback interface and nothing else. Throws std::runtime_error where that is not permitted (it takes CAP_SYS_ADMIN).
void enter_own_network();

}  // namespace trivela::faults

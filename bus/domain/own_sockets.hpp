#pragma once

#include <set>
#include <string_view>

namespace trivela::bus {

/// Whether Cyclone's configuration names the loopback interface and no other.
bool loopback_alone(std::string_view xml);

/// File descriptors of this process's UDP sockets on a port of DDS (domains 0 to 100) that hear every interface.
std::set<int> open_to_all();

/// From now on the socket hears the loopback interface alone, whatever address it is bound to (SO_BINDTODEVICE, which
/// takes no right since Linux 5.7). Throws Error where the kernel refuses.
void receive_loopback_only(int socket);

}  // namespace trivela::bus

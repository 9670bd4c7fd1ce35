#pragma once

#include <optional>
#include <string>

namespace trivela::nodes {

/// An interface's IPv4 address, such as 172.16.39.3, with the index by which the kernel knows it: "3 172.16.39.3".
/// None: there is no such interface, it is down, or it has no address.
std::optional<std::string> interface_address(const std::string& interface);

}  // namespace trivela::nodes

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/domain/domain.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// The main of every node: `--config FILE`, any number of `--set section.key=value`, `--realtime PRIORITY`,
/// `--processor N`, `--secure KEYS`. Joins the bus, runs `body` until it returns or SIGTERM or SIGINT requests the
/// stop, and turns exceptions into one line on standard error. Returns the exit code: 0 stopped, 1 failed, 2 bad usage.
int node_main(int argc, char** argv, const char* name, const std::function<void(NodeContext&)>& body);

/// Where the nodes of these settings meet.
bus::DomainConfig domain_of(const config::Domain& domain);

/// The folder of a machine's keys in that of all: "robot_3"; of the base "robot_0".
std::string key_folder_of(const config::Settings& settings);

/// The same for a node that has its identity in the folder of keys (security/key_folder.hpp), where that is not empty.
/// Throws bus::Error as bus::secured does.
bus::DomainConfig domain_of(const config::Settings& settings, const std::string& keys, std::string_view node);

/// Runs nodes of one process until the stop: in listeners where the settings allow it, in a waitset thread each in
/// lockstep, where reactions wait for the other inputs of a cycle. In real time an InputWatch each warns of inputs that
/// fall silent.
void run(NodeContext& context, const std::vector<bus::Node*>& nodes);
inline void run(NodeContext& context, bus::Node& node) { run(context, std::vector{&node}); }

}  // namespace trivela::nodes

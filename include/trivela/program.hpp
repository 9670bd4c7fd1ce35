#pragma once

namespace trivela {

/// The program `trivela` with the policies that were registered before:
/// - each verb of `trivela` as the first argument, such as simulate, match, study tune, compare,
/// - kick_decision, kick_decision_second or chain as the first argument: the node of that name.
/// `match` starts this program as its decision node; the other nodes are those beside it or on the PATH.
/// Returns the exit code: 0 done, 1 failed, 2 bad usage, 3 done but a gate missed or data was lost.
int run(int argc, char** argv);

/// The decision node of a robot, `trivela-kick_decision` with the policies that were registered before.
int run_decision_node(int argc, char** argv);

/// `trivela simulate` with the policies that were registered before: matches without DDS, in one process.
int run_simulate(int argc, char** argv);

}  // namespace trivela

#pragma once

#include <filesystem>
#include <memory>

#include "log/write/writer.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// A log that a recorder writes to, and where it is.
struct PlacedLog {
  std::filesystem::path path;
  std::unique_ptr<log::Writer> writer;
};

/// Opens the file that recorder.log names (robot/recording/log_family.hpp). In real time a match is going on that is
/// not to be lost: where that file holds anything already, the session goes on beside it, in NAME-r<robot>-<UTC>.db or,
/// where its name has the time, NAME-2.db; where the folder refuses (missing, read-only, full), in a service's
/// state folder ($STATE_DIRECTORY), without one in the temporary folder or /var/tmp, or in /dev/shm; the logger says
/// where, as an error. It goes on from the newest session of that name's logs. Throws std::runtime_error where none of
/// them can be written, in lockstep where the file itself cannot.
PlacedLog place_log(const NodeContext& context, const log::WriterOptions& options);

}  // namespace trivela::nodes

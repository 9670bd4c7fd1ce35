#pragma once

#include <filesystem>
#include <memory>

#include "evaluator/log/writer.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// A log that a recorder writes to, and where it is.
struct PlacedLog {
  std::filesystem::path path;
  std::unique_ptr<evaluator::log::Writer> writer;
};

/// Opens recorder.log. In real time a match is going on that is not to be lost: where that file holds anything already,
/// the session goes on from the one in it, in a file of its own beside it, NAME-r<robot>-<UTC>.db, and where the folder
/// refuses, in the temporary folder; the logger says where. Throws std::runtime_error where none of them can be
/// written, in lockstep where recorder.log cannot.
PlacedLog place_log(const NodeContext& context, const evaluator::log::WriterOptions& options);

}  // namespace trivela::nodes

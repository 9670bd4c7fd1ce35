#pragma once

#include <string>

namespace trivela::calibration {

/// What a calibration is made from.
enum class InputKind { kNumbers, kScanRecord, kMatchLog };

/// By the file's first bytes and tables; "-" and whatever is no SQLite file is a table of numbers.
/// Throws std::runtime_error naming a file that cannot be read.
InputKind input_kind(const std::string& file);

}  // namespace trivela::calibration

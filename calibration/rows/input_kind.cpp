#include "calibration/rows/input_kind.hpp"

#include <fstream>
#include <stdexcept>

#include "config/open_file.hpp"
#include "evaluator/log/scan_log.hpp"

namespace trivela::calibration {

InputKind input_kind(const std::string& file) {
  if (file == "-") return InputKind::kNumbers;
  std::ifstream in = config::open_file(file);
  const std::string magic = "SQLite format 3";
  std::string start(magic.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != magic) return InputKind::kNumbers;
  return evaluator::log::is_scan_log(file) ? InputKind::kScanRecord : InputKind::kMatchLog;
}

}  // namespace trivela::calibration

#include "bus/domain/library_log.hpp"

#include <dds/ddsrt/log.h>

#include <utility>

namespace trivela::bus {
namespace {

/// Without the end of the line, which the program's own log has; the time stands before it already.
std::string_view text_of(const dds_log_data_t& data) {
  std::string_view text(data.message, data.size);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.remove_suffix(1);
  return text;
}

}  // namespace

LibraryLog::LibraryLog(std::function<void(bool, std::string_view)> line) : line_(std::move(line)) {
  dds_set_log_sink(
      [](void* self, const dds_log_data_t* data) {
        const bool severe = (data->priority & (DDS_LC_ERROR | DDS_LC_FATAL)) != 0;
        static_cast<const LibraryLog*>(self)->line_(severe, text_of(*data));
      },
      this);
}

LibraryLog::~LibraryLog() { dds_set_log_sink(nullptr, nullptr); }

}  // namespace trivela::bus

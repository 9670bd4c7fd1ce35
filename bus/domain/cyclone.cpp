#include "bus/domain/cyclone.hpp"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>
#include <fmt/core.h>

#include <utility>

namespace trivela::bus {

Error::Error(std::string_view call, std::string_view about, std::string_view reason)
    : std::runtime_error(fmt::format("bus: {} ({}): {}", call, about, reason)) {}

void refuse(std::int32_t result, std::string_view call, std::string_view about) {
  throw Error(call, about, dds_strretcode(-result));
}

Entity& Entity::operator=(Entity&& other) noexcept {
  if (this != &other) {
    reset();
    handle_ = other.release();
  }
  return *this;
}

void Entity::reset() noexcept {
  if (handle_ != 0) dds_delete(release());
}

std::int32_t Entity::release() noexcept { return std::exchange(handle_, 0); }

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

#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <variant>
#include <vector>

#include "cli/launch/log_claim.hpp"
#include "log/schema/session.hpp"
#include "log/write/writer.hpp"
#include "robot/recording/message_row.hpp"

namespace trivela::cli {

/// A new match log that is whole when finish() has been called, and gone otherwise.
class RowWriting {
 public:
  /// Throws UsageError where the file exists, std::runtime_error where it cannot be made.
  RowWriting(const std::filesystem::path& out, const log::Session& session)
      : out_(out), claim_(out), writer_(std::make_unique<log::Writer>(out, session)) {}
  RowWriting(const RowWriting&) = delete;
  RowWriting& operator=(const RowWriting&) = delete;
  ~RowWriting() {
    if (finished_) return;
    writer_.reset();
    std::error_code ignored;
    for (const char* const beside : {"", "-wal", "-shm"}) std::filesystem::remove(out_.string() + beside, ignored);
  }

  /// A row of the message's table, with nothing in the columns of `without`.
  template <bus::Struct T>
  void write(const T& message, std::initializer_list<std::string_view> without = {}) {
    const auto place = tables_.find(typeid(T));
    const log::TableId table =
        place != tables_.end()
            ? place->second
            : tables_.emplace(typeid(T), writer_->table(robot::table_of<T>(), robot::columns_of<T>())).first->second;
    if (++rows_ % kGroup == 0) writer_->flush();  // nothing is lost to a full queue
    std::vector<log::Value> row = robot::row_of(message);
    for (const std::string_view column : without) {
      const auto columns = robot::columns_of<T>();
      row.at(static_cast<std::size_t>(std::ranges::find(columns, column) - columns.begin())) = std::monostate{};
    }
    writer_->push(table, std::move(row));
  }

  /// Throws std::runtime_error where the disk refuses, or a row is against the schema.
  void finish() {
    writer_->finalise();
    if (const auto missing = writer_->stats().rows_missing; missing > 0)
      throw std::runtime_error{fmt::format("{}: {} rows were refused by the log's schema", out_.string(), missing)};
    finished_ = true;
  }

 private:
  static constexpr std::int64_t kGroup = 16384;

  std::filesystem::path out_;
  LogClaim claim_;
  std::unique_ptr<log::Writer> writer_;
  std::map<std::type_index, log::TableId> tables_;
  std::int64_t rows_ = 0;
  bool finished_ = false;
};

/// The session of an imported match: no simulation, by UTC (realtime_offset_ns is when its clock was 0), with the
/// sentences on what was imported and the text that it was imported from in place of a configuration. Its uuid is made
/// of these, so that what is imported twice counts once.
log::Session imported_session(const std::string& name, const std::vector<std::string>& sentences,
                              const std::string& source, std::int64_t realtime_offset_ns);

}  // namespace trivela::cli

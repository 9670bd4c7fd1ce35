#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/read/reader.hpp"

namespace trivela::log {

/// How much of a session a file has, the least first.
enum class Copy { kDamaged, kOpen, kWhole };

/// A file to be merged, sound or not.
class MergeSource {
 public:
  /// Reads which sessions are there. Nothing is thrown: see why_unreadable().
  explicit MergeSource(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }

  /// What is wrong with the file; empty: nothing.
  const std::string& damage() const { return damage_; }

  /// None: nothing can be taken of it.
  const Reader* reader() const { return reader_.get(); }

  const std::map<std::int64_t, Copy>& sessions() const { return sessions_; }

  /// The texts that are what they are named by, with the name that they have in this file.
  void for_each_text(const std::function<void(const std::string& name, const std::string& text)>& fn) const;

  /// Rows of a table in the order of `key`; of a damaged file those before the damage and those behind it, from the
  /// end on. False: not all of them.
  bool for_each_row(std::string_view table, const std::vector<std::string>& columns, std::string_view key,
                    const RowFunction& fn) const;

  /// Rows that can be counted of a session.
  std::int64_t rows_of(std::int64_t session_id) const;

 private:
  void open();
  void look_for_sessions();

  std::filesystem::path path_;
  std::string damage_;
  std::unique_ptr<Reader> reader_;
  std::map<std::int64_t, Copy> sessions_;
};

}  // namespace trivela::log

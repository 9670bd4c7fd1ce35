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
#include <tuple>
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
  /// end on.
  void for_each_row(std::string_view table, const std::vector<std::string>& columns, std::string_view key,
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

/// A kick of which two sources say different things. Who knows less says nothing different.
struct KickConflict {
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;  ///< of the decision
  std::string about;      ///< "policy", "driver", "outcome" or "label"
  struct Claim {
    std::string source;  ///< name of the file, without its folder
    std::string what;
  };
  std::vector<Claim> said;  ///< of each different thing the first source

  /// "kick 1:4 (outcome): robot1.db says on_target, base.db says over"
  std::string line() const;
};

/// What several files say of the same kicks. A kick is the same by robot, kick_id and instant of the decision, in
/// matches of one seed where they are simulated; in an experiment, whose arms share them, within one session.
class KickConflicts {
 public:
  /// Of a damaged file what can be read.
  void add(const MergeSource& source);

  /// By robot and kick_id.
  std::vector<KickConflict> conflicts() const;

 private:
  using Kick = std::tuple<int, std::int64_t, std::int64_t, std::optional<std::int64_t>, std::int64_t>;
  using Sayings = std::map<std::string, std::vector<KickConflict::Claim>>;  // by what they are about

  void say(const Kick& kick, const std::string& about, const std::string& source, const std::string& what);

  std::map<Kick, Sayings> kicks_;
};

}  // namespace trivela::log

#include "log/merge/merge.hpp"

#include <SQLiteCpp/VariadicBind.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "log/file/new_file.hpp"
#include "log/file/session_tallies.hpp"
#include "log/merge/merged_log.hpp"
#include "log/schema/bind.hpp"
#include "log/schema/row_digest.hpp"
#include "log/schema/schema.hpp"

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kToldEvery = 10'000;

/// A row that the new log does not take, thrown past who reads: a full disk is no damage of an input.
struct WriteFailed {
  std::string why;
};

/// From which file a session is taken first, and whether that is enough.
struct Choice {
  std::size_t source = 0;
  Copy copy = Copy::kDamaged;
};

class Merging {
 public:
  Merging(const std::vector<fs::path>& from, const MergeOptions& options) : options_(options) {
    for (const fs::path& path : from) sources_.emplace_back(path);
    for (const MergeSource& source : sources_) {
      MergedFile& file = merged_.files.emplace_back();
      file.path = source.path();
      file.damage = source.damage();
      file.readable = source.reader() != nullptr;
      if (file.readable) rows_ += source.reader()->verification().rows;
      for (const auto& [session_id, copy] : source.sessions()) file.parts.push_back({session_id, 0, 0});
    }
    choose();
  }

  Merged write(const fs::path& to) {
    if (choices_.empty()) throw std::runtime_error(nothing_to_merge());
    go_on_or_stop();
    const auto database = new_file(to, kMatchLog, [&](SQLite::Database& made) {
      stoppable(
          made, [this] { return goes_on(); },
          [&] {
            create_tables(made);
            copy_whole_sources(made);
            SQLite::Transaction transaction(made, SQLite::TransactionBehavior::IMMEDIATE);
            copy_all(made);
            finish_sessions(made);
            if (options_.finish) options_.finish(made);
            transaction.commit();
          });
    });
    fold(*database);
    return std::move(merged_);
  }

 private:
  std::string nothing_to_merge() const {
    std::string why = "nothing to merge";
    for (const MergedFile& file : merged_.files)
      why += "; " + (file.damage.empty() ? file.path.string() + " has no session" : file.damage);
    return why;
  }

  void choose() {
    std::map<std::int64_t, std::vector<std::size_t>> holders;
    for (std::size_t i = 0; i < sources_.size(); ++i)
      for (const auto& [session_id, copy] : sources_[i].sessions()) holders[session_id].push_back(i);
    for (const auto& holder : holders) {
      const std::int64_t session_id = holder.first;
      const std::vector<std::size_t>& places = holder.second;
      const auto copy_in = [&](std::size_t i) { return sources_[i].sessions().at(session_id); };
      std::size_t best = places.front();
      std::int64_t best_rows = -1;
      for (const std::size_t i : places) {
        if (copy_in(best) == Copy::kWhole && best_rows >= 0) break;
        const bool alone = places.size() == 1 || copy_in(i) == Copy::kWhole;
        const std::int64_t rows = alone ? 0 : sources_[i].rows_of(session_id);
        if (best_rows >= 0 && std::pair(copy_in(i), rows) <= std::pair(copy_in(best), best_rows)) continue;
        best = i;
        best_rows = rows;
      }
      choices_[session_id] = {best, copy_in(best)};
    }
  }

  /// Sound, and the one file that all of its sessions are taken from: nothing in it has to be chosen.
  bool is_taken_whole(std::size_t i) const {
    const Reader* const reader = sources_[i].reader();
    return reader != nullptr && sources_[i].damage().empty() &&
           std::ranges::all_of(sources_[i].sessions(), [&](const auto& session) {
             return session.second == Copy::kWhole && choices_.at(session.first).source == i;
           });
  }

  void copy_whole_sources(SQLite::Database& database) try {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (!is_taken_whole(i)) continue;
      const std::int64_t before = read_;
      copy_whole(database, sources_[i].path(), [&](std::int64_t rows) {
        read_ = before + rows;
        go_on_or_stop();
      });
      for (MergedPart& part : merged_.files[i].parts) {
        const auto rows = rows_of_whole(database, part.session_id);
        part.rows = part.added = rows ? *rows : counted_rows(database, part.session_id);
        if (part.rows == 0) unfit_.insert(part.session_id);
      }
    }
  } catch (const SQLite::Exception& error) {
    throw WriteFailed{error.what()};
  }

  void copy_all(SQLite::Database& database) {
    copy_texts(database);
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i].reader() == nullptr) continue;
      copy_experiments(database, sources_[i]);
      if (is_taken_whole(i)) continue;
      for (const StreamTable& table : digested_tables()) copy_rows(database, i, table, true);
    }
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const bool has_more = std::ranges::any_of(sources_[i].sessions(), [&](const auto& session) {
        const Choice& choice = choices_.at(session.first);
        return choice.source != i && choice.copy != Copy::kWhole;
      });
      if (!has_more) continue;
      for (const StreamTable& table : digested_tables()) copy_rows(database, i, table, false);
    }
  }

  void copy_texts(SQLite::Database& database) {
    RowCopy texts(database, "texts");
    names_.resize(sources_.size());
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i].reader() == nullptr) continue;
      sources_[i].for_each_text([&](const std::string& name, const std::string& text) {
        names_[i][name] = sha256(text);
        add(texts, std::vector<Value>{names_[i][name], text});
        texts_.insert(names_[i][name]);
      });
    }
    add(texts, std::vector<Value>{sha256(""), std::string()});  // of a session whose text is lost
  }

  /// An experiment of the same arguments is as far as the furthest.
  void copy_experiments(SQLite::Database& database, const MergeSource& source) {
    SQLite::Statement insert(database,
                             "INSERT INTO experiments (arguments_sha256, arguments, matches, matches_done) VALUES "
                             "(?, ?, ?, ?) ON CONFLICT DO UPDATE SET matches_done = max(matches_done, "
                             "excluded.matches_done)");
    source.for_each_row("experiments", {"arguments_sha256", "arguments", "matches", "matches_done"}, "arguments_sha256",
                        [&](std::span<const Value> row) {
                          if (sha256(std::get<std::string>(row[1])) != std::get<std::string>(row[0])) return;
                          insert.reset();
                          SQLite::bind(insert, std::get<std::string>(row[0]), std::get<std::string>(row[1]),
                                       std::get<std::int64_t>(row[2]), std::get<std::int64_t>(row[3]));
                          if (insert.tryExecuteStep() != SQLITE_DONE) throw WriteFailed{database.getErrorMsg()};
                        });
  }

  MergedPart* part_of(std::size_t source, std::int64_t session_id) {
    auto& parts = merged_.files[source].parts;
    const auto part = std::ranges::lower_bound(parts, session_id, {}, &MergedPart::session_id);
    return part != parts.end() && part->session_id == session_id ? &*part : nullptr;
  }

  /// Of each session what its chosen file has, or, not `chosen`, what the others have beyond.
  void copy_rows(SQLite::Database& database, std::size_t source, const StreamTable& table, bool chosen) {
    RowCopy copy(database, table.name);
    const std::size_t id_place = copy.place("session_id");
    const bool of_session = table.name == "sessions";
    std::vector<Value> cells;
    sources_[source].for_each_row(table.name, copy.columns(), table.key, [&](std::span<const Value> row) {
      const auto* const id = std::get_if<std::int64_t>(&row[id_place]);
      MergedPart* const part = id != nullptr ? part_of(source, *id) : nullptr;
      if (part == nullptr || unfit_.contains(*id)) return;
      const Choice& choice = choices_.at(*id);
      const bool is_chosen = choice.source == source;
      if (chosen && !is_chosen) ++part->rows;
      if (chosen != is_chosen || (!chosen && choice.copy == Copy::kWhole)) return;
      if (!chosen && (of_session || table.name == "losses")) return;  // of a recording under way: of the latest alone
      cells.assign(row.begin(), row.end());
      if (of_session) rename_texts(copy, source, cells, *id);
      const bool added = add(copy, cells);
      if (of_session && !added) unfit_.insert(*id);
      if (is_chosen) part->rows += added ? 1 : 0;
      part->added += added ? 1 : 0;
      tell();
    });
  }

  void rename_texts(const RowCopy& copy, std::size_t source, std::vector<Value>& cells, std::int64_t session_id) {
    for (const char* const column : {"config_sha256", "idl_sha256"}) {
      Value& cell = cells[copy.place(column)];
      const auto* const name = std::get_if<std::string>(&cell);
      const auto known = name != nullptr ? names_[source].find(*name) : names_[source].end();
      if (known != names_[source].end()) {
        cell = known->second;
      } else if (name == nullptr || !texts_.contains(*name)) {
        cell = sha256("");
        without_text_.insert(session_id);
      }
    }
  }

  bool add(RowCopy& copy, std::span<const Value> cells) {
    try {
      return copy.insert(cells);
    } catch (const SQLite::Exception& error) {
      throw WriteFailed{error.what()};
    }
  }

  void tell() {
    if (++read_ % kToldEvery == 0) go_on_or_stop();
  }

  bool goes_on() const { return !options_.progress || options_.progress(read_, rows_); }
  void go_on_or_stop() const {
    if (!goes_on()) throw Stopped{};
  }

  void finish_sessions(SQLite::Database& database) {
    RowDigests digests(database);
    SQLite::Statement reopen(database, "UPDATE sessions SET closed_t_ns = NULL WHERE session_id = ?");
    for (const auto& [session_id, choice] : choices_) {
      if (unfit_.contains(session_id)) continue;
      MergedSession& session = merged_.sessions.emplace_back();
      session.is_whole = choice.copy == Copy::kWhole && !without_text_.contains(session_id);
      if (session.is_whole) {
        if (!rows_of_whole(database, session_id)) digests.write(session_id);
        if (!has_tallies(database, session_id)) write_tallies(database, session_id);
      } else {
        run(reopen, session_id);
      }
      session.clock = clock_of(database, session_id);
      if (!session.is_whole) session.missing_rows = missing_rows(database, session_id);
    }
    write_provenance(database);
    copy_said(database);
    KickConflicts claims;
    for (const MergeSource& source : sources_) claims.add(source);
    merged_.conflicts = claims.conflicts();
    merged_.alignment = write_clocks(database, merged_.sessions, options_.reference_robot);
  }

  void write_provenance(SQLite::Database& database) {
    RowCopy copy(database, "merged_sessions");
    for (const MergeSource& source : sources_) {
      if (source.reader() == nullptr) continue;
      source.for_each_row("merged_sessions", copy.columns(), "session_id, file", [&](std::span<const Value> row) {
        inherited_.emplace(&source, std::get<std::int64_t>(row[0]));
        add(copy, row);
      });
    }
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const MergedFile& file = merged_.files[i];
      for (const MergedPart& part : file.parts) {
        if (inherited_.contains({&sources_[i], part.session_id})) continue;
        add(copy, std::vector<Value>{part.session_id, file.path.filename().string(), part.rows, damage_of(file)});
      }
    }
  }

  /// What people say, of every file.
  void copy_said(SQLite::Database& database) {
    for (const std::string_view table : {"labels", "notes"}) {
      RowCopy copy(database, table);
      const std::size_t id_place = copy.place("session_id");
      for (const MergeSource& source : sources_) {
        if (source.reader() == nullptr) continue;
        source.for_each_row(table, copy.columns(), "session_id", [&](std::span<const Value> row) {
          const auto* const id = std::get_if<std::int64_t>(&row[id_place]);
          if (id != nullptr && choices_.contains(*id) && !unfit_.contains(*id)) add(copy, row);
        });
      }
    }
  }

  /// Without its folder, which is another one tomorrow.
  static std::string damage_of(const MergedFile& file) {
    std::string damage = file.damage;
    const std::string path = file.path.string(), name = file.path.filename().string();
    if (const auto at = damage.find(path); at != std::string::npos) damage.replace(at, path.size(), name);
    return damage;
  }

  const MergeOptions& options_;
  std::vector<MergeSource> sources_;
  std::map<std::int64_t, Choice> choices_;                 // by session_id
  std::vector<std::map<std::string, std::string>> names_;  // of texts in the new log by those in each file
  std::set<std::string> texts_;
  std::set<std::int64_t> without_text_;                              // sessions
  std::set<std::int64_t> unfit_;                                     // sessions whose own row is against the schema
  std::set<std::pair<const MergeSource*, std::int64_t>> inherited_;  // sessions of which a merged file says more
  std::int64_t read_ = 0;
  std::int64_t rows_ = 0;  // that digests of the files cover
  Merged merged_;
};

}  // namespace

Merged merge(const std::vector<fs::path>& from, const fs::path& to, const MergeOptions& options) {
  Merging merging(from, options);
  try {
    return merging.write(to);
  } catch (const WriteFailed& error) {
    throw std::runtime_error(fmt::format("cannot write the match log {}: {}", to.string(), error.why));
  }
}

}  // namespace trivela::log

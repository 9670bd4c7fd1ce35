#include "log/write/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <deque>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "log/schema/digest.hpp"
#include "log/write/row_queue.hpp"
#include "log/write/session_writer.hpp"

namespace trivela::log {
namespace {

using Clock = std::chrono::steady_clock;

NewLog match_log(Session session) {
  if (session.uuid.empty()) session.uuid = make_uuid();
  return {.kind = kMatchLog,
          .session_id = session_id_of(session.uuid),
          .started_t_ns = session.started_t_ns,
          .create = [session](SQLite::Database& database) { create_log(database, session); }};
}

}  // namespace

struct Writer::Impl {
  Impl(const std::filesystem::path& file, const NewLog& log, WriterOptions chosen)
      : path(file.string()),
        options(std::move(chosen)),
        queue(options.queue_capacity),
        pace(options.group_commit_s),
        connection(file, log),
        thread([this] { run(); }) {}

  void warn(const std::string& sentence) const {
    if (options.warn) {
      options.warn(sentence);
    } else {
      std::fputs(fmt::format("{}: {}\n", connection.kind().name, sentence).c_str(), stderr);
    }
  }

  void warn_once(const std::string& stream, const std::string& sentence) {
    {
      const std::lock_guard lock(mutex);
      if (!warned.insert(stream + sentence).second) return;
    }
    warn(sentence + "; further ones are counted");
  }

  std::deque<RowTable> registered() {
    const std::lock_guard lock(mutex);
    return tables;
  }

  // Place of a kind of rows that is registered when it is needed.
  std::size_t place(std::optional<std::size_t>& place, RowTable (*make)()) {
    const std::lock_guard lock(mutex);
    if (!place) {
      tables.push_back(make());
      place = tables.size() - 1;
    }
    return *place;
  }

  // Commits the group whose first row was pushed then. False: the disk refused it.
  bool try_commit(const std::vector<Row>& group, Clock::time_point first) {
    const auto begun = Clock::now();
    try {
      const GroupResult result = connection.commit(group, registered(), loss_counters);
      for (const Loss& loss : result.counters) loss_counters.add(loss);
      for (const std::string& reason : result.reasons) warn_once("", "row left out, " + reason);
      rows_written += result.written - result.amended;
      rows_missing += static_cast<std::int64_t>(group.size()) - result.written;
      ++commits;
      const auto now = Clock::now();
      last_commit = now;
      const auto late = pace.committed(now - begun, now - first, now);
      oldest_row = pace.oldest();
      if (late && options.warn_late) warn(*late);
      if (connection.moved() && !std::exchange(moved_said, true))
        warn(path + " was deleted or renamed: its rows are written again at the end");
      queue.settle(group.size(), std::nullopt);
      return true;
    } catch (const std::exception& error) {
      const std::string sentence =
          fmt::format("cannot write the {} {}: {}", connection.kind().name, path, error.what());
      if (!queue.error()) warn(sentence);
      queue.settle(0, sentence);
      return false;
    }
  }

  void run() {
    const std::chrono::duration<double> span(options.group_commit_s);
    std::vector<Row> group;
    while (const auto first = queue.take(group, pace.wait())) {
      bool given_up = false;
      while (!group.empty() && !given_up) {
        const bool last_try = queue.closed();
        if (try_commit(group, *first)) {
          group.clear();
        } else if (last_try) {
          given_up = true;
        } else {
          queue.wait_to_retry(span);
        }
      }
      if (given_up) {
        for (const Row& row : group) count_overflow(row.table);
        group.clear();
      }
    }
  }

  void count_overflow(std::size_t table) {
    loss_counters.add({.stream = table_name(table), .received = 1, .overflow = 1});
    ++rows_missing;
  }

  std::string table_name(std::size_t table) {
    const std::lock_guard lock(mutex);
    return tables.at(table).name;
  }

  const std::string path;
  const WriterOptions options;
  RowQueue queue;
  CommitPace pace;          // of the thread
  bool moved_said = false;  // of the thread
  LossCounters loss_counters;
  std::mutex mutex;  // of the next six
  std::deque<RowTable> tables;
  std::optional<std::size_t> silences;
  std::optional<std::size_t> withdrawn_silences;
  std::optional<std::size_t> simulations;
  std::set<std::string> warned;
  SessionWriter connection;  // of the thread, after its end of finalise; `describe` under the mutex
  std::atomic<std::int64_t> rows_written = 0;
  std::atomic<std::int64_t> rows_missing = 0;
  std::atomic<std::int64_t> commits = 0;
  std::atomic<Clock::time_point> first_push = Clock::time_point{};
  std::atomic<Clock::time_point> last_commit = Clock::time_point{};
  std::atomic<Clock::duration> oldest_row = Clock::duration{0};
  bool finalised = false;
  std::thread thread;  // last: everything that it uses exists
};

Writer::Writer(const std::filesystem::path& path, const NewLog& log, WriterOptions options)
    : impl_(std::make_unique<Impl>(path, log, std::move(options))) {}

Writer::Writer(const std::filesystem::path& path, const Session& session, WriterOptions options)
    : Writer(path, match_log(session), std::move(options)) {}

Writer::~Writer() {
  try {
    finalise();
  } catch (const std::exception& error) {
    impl_->warn(error.what());
  }
}

std::int64_t Writer::session_id() const { return impl_->connection.session_id(); }

TableId Writer::table(std::string_view name, const std::vector<std::string>& columns) {
  const std::lock_guard lock(impl_->mutex);
  impl_->tables.push_back(impl_->connection.describe(name, columns));
  impl_->loss_counters.add({.stream = std::string(name)});
  return {impl_->tables.size() - 1};
}

bool Writer::push(TableId table, std::vector<Value> values) {
  if (impl_->first_push.load(std::memory_order_relaxed) == Clock::time_point{}) impl_->first_push = Clock::now();
  if (impl_->queue.push({table.index, std::move(values)})) return true;
  impl_->count_overflow(table.index);
  impl_->warn_once("", fmt::format("row left out, {}: the queue is full", impl_->table_name(table.index)));
  return false;
}

void Writer::add_loss(std::string_view stream, LossKind kind, std::int64_t n) {
  Loss delta{.stream = std::string(stream)};
  delta.*kLossCounters.at(static_cast<std::size_t>(kind)) = n;
  impl_->loss_counters.add(delta);
}

void Writer::silence(const Silence& silence) {
  const Value end = silence.to_t_ns ? Value(*silence.to_t_ns) : Value();
  push({impl_->place(impl_->silences, silence_rows)},
       {silence.stream, std::int64_t{silence.robot_id}, silence.from_t_ns, end});
}

void Writer::withdraw(const Silence& silence) {
  push({impl_->place(impl_->withdrawn_silences, withdrawn_silence_rows)},
       {silence.stream, std::int64_t{silence.robot_id}, silence.from_t_ns});
}

bool Writer::simulated(const std::optional<Simulation>& world) {
  const auto value = [](const auto& optional) { return optional ? Value(*optional) : Value(); };
  std::vector<Value> values(4);
  if (world)
    values = {value(world->seed), world->scenario, std::int64_t{world->paired_halves}, value(world->planned_s)};
  return push({impl_->place(impl_->simulations, simulation_rows)}, std::move(values));
}

void Writer::flush() {
  if (const auto error = impl_->queue.flush()) throw std::runtime_error(*error);
}

std::optional<std::string> Writer::health() const { return impl_->queue.error(); }

Stats Writer::stats() const {
  const std::chrono::duration<double> busy = impl_->last_commit.load() - impl_->first_push.load();
  const std::int64_t written = impl_->rows_written;
  std::int64_t missing = 0;
  for (const Loss& loss : impl_->loss_counters.all()) missing += loss.missing();
  return {.rows_written = written,
          .rows_missing = impl_->rows_missing,
          .samples_missing = missing,
          .commits = impl_->commits,
          .rows_per_s = written > 0 && busy.count() > 0.0 ? static_cast<double>(written) / busy.count() : 0.0,
          .queue_high_water = impl_->queue.high_water(),
          .oldest_row_s = std::chrono::duration<double>(impl_->oldest_row.load()).count()};
}

std::size_t Writer::waiting() const { return impl_->queue.waiting(); }

void Writer::finalise(std::optional<std::int64_t> closed_t_ns) {
  if (std::exchange(impl_->finalised, true)) return;
  impl_->queue.close();
  impl_->thread.join();
  const auto refused = impl_->queue.error();
  const std::size_t missing = impl_->queue.waiting();
  try {
    SessionWriter& connection = impl_->connection;
    const std::int64_t end = closed_t_ns.value_or(connection.latest_t_ns());
    connection.commit_end(impl_->loss_counters, missing > 0 ? std::nullopt : std::optional(end));
    if (connection.moved()) {
      impl_->warn(fmt::format("{} was deleted or renamed: all its rows are in {}", impl_->path,
                              connection.write_again().string()));
    } else if (!connection.fold()) {
      impl_->warn(fmt::format("{} is being read; it is whole together with its -wal file", impl_->path));
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("cannot finalise the {} {}, {} rows are missing: {}",
                                         impl_->connection.kind().name, impl_->path, missing,
                                         refused.value_or(error.what())));
  }
  if (missing > 0) {
    throw std::runtime_error(fmt::format("{} rows are missing at the end of the {} {}: {}", missing,
                                         impl_->connection.kind().name, impl_->path,
                                         refused.value_or("the disk refused them")));
  }
}

}  // namespace trivela::log

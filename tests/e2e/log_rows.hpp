#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "log/read/reader.hpp"

namespace trivela::e2e {

using log::Reader;
using log::Value;
using Row = std::vector<Value>;

/// All rows of a query.
std::vector<Row> rows_of(const Reader& log, const std::string& sql);

/// The one number of a query; 0 where it is NULL.
std::int64_t number_of(const Reader& log, const std::string& sql);
double real_of(const Reader& log, const std::string& sql);

/// The tables that have a seq of their own: one stream each.
std::vector<std::string> streams_of(const Reader& log);

/// Sentences on the streams that do not go 1, 2, 3, ...
std::vector<std::string> gaps_of(const Reader& log);

/// Sentences on the counters of lost rows that are not 0.
std::vector<std::string> losses_of(const Reader& log);

/// Sentences on what says that the recording was not ended as it should: no closed_t_ns, files beside the log.
std::vector<std::string> loose_ends_of(const std::filesystem::path& log);

/// Where two logs differ first, table by table, apart from the session's id and what it was called with; the session's
/// bits of a kick_id are left out. No sentence: the same match.
std::vector<std::string> differences_of(const Reader& one, const Reader& other);

}  // namespace trivela::e2e

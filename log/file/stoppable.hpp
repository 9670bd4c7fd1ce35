#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>

namespace trivela::log {

/// Thrown where whoever is told of the progress says to stop: no error, and no file is kept.
struct Stopped {};

/// Calls `work`, which runs statements of `database`, and asks meanwhile whether to go on, within long statements as
/// well. Throws Stopped where `go_on` says no, and whatever the two throw.
void stoppable(SQLite::Database& database, const std::function<bool()>& go_on, const std::function<void()>& work);

}  // namespace trivela::log

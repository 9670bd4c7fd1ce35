#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cli/scan/mount_flags.hpp"
#include "config/text/installation.hpp"
#include "kicking/lob/analyzer.hpp"

namespace trivela::cli {

/// Flags of `trivela lob --live` and `trivela lob --replay`.
struct PageFlags {
  std::string live;
  std::string replay;
  std::string record;  ///< empty: lobs-<date>.db
  std::string listen = "127.0.0.1";
  int port = 0;
  std::string plan;
  std::string robot;
  int trials = 2;
  std::string config = config::shipped("default.toml").string();

  bool asked_for() const { return !live.empty() || !replay.empty(); }
};

void add_page_flags(CLI::App& verb, PageFlags& flags);

/// Serves the page until Ctrl-C; returns the exit code. The mount is that of a live scanner; a record knows its own.
/// Throws std::runtime_error where a match is on: the page takes verdicts and powers.
int serve_lobs(const PageFlags& flags, const kicking::lob::LaserMount& mount,
               const kicking::lob::AnalyzerConfig& config);

}  // namespace trivela::cli

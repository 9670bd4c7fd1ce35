#include "cli/program.hpp"

namespace cli = trivela::cli;

int main(int argc, char** argv) {
  return cli::run_program(
      {.name = "trivela",
       .what = "Trivela: kick decisions, match logs and their evaluation for robot soccer",
       .footer = "On the robot itself each node is a program of its own, trivela-NODE: see docs/operations.md.\n"
                 "trivela-emulate is a device that is not there.\n"
                 "Exit codes: 0 done, 1 failed, 2 bad usage, 3 done but a gate missed or data was lost.",
       .verbs = {{"Play", {cli::add_match, cli::add_simulate}},
                 {"Calibrate", {cli::add_scan, cli::add_lob, cli::add_calibrate}},
                 {"Compare", {cli::add_compare, cli::add_study}},
                 {"After a match",
                  {cli::add_collect, cli::add_merge, cli::add_report, cli::add_drift, cli::add_query, cli::add_export,
                   cli::add_import, cli::add_replay, cli::add_label, cli::add_note}},
                 {"On the robot",
                  {cli::add_team, cli::add_top, cli::add_monitor, cli::add_doctor, cli::add_hardware, cli::add_solve,
                   cli::add_align, cli::add_predict, cli::add_keys}}},
       .has_manual = true},
      argc, argv);
}

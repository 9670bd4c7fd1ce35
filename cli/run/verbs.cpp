
#include "cli/program.hpp"

namespace trivela::cli {

int run_verbs(int argc, char** argv) {
  return run_program(
      {.name = "trivela",
       .what = "Trivela: kick decisions, match logs and their evaluation for robot soccer",
       .footer = "On the robot itself each node is a program of its own, trivela-NODE: see docs/operations.md.\n"
                 "trivela-emulate is a device that is not there.\n"
                 "Exit codes: 0 done, 1 failed, 2 bad usage, 3 done but a gate missed or data was lost.",
       .verbs = {{"Play", {add_match, add_simulate}},
                 {"Calibrate", {add_scan, add_lob, add_calibrate}},
                 {"Compare", {add_compare, add_study}},
                 {"After a match",
                  {add_collect, add_merge, add_report, add_drift, add_query, add_export, add_import, add_replay,
                   add_label, add_note}},
                 {"On the robot",
                  {add_team, add_top, add_monitor, add_doctor, add_hardware, add_solve, add_align, add_predict,
                   add_keys}}},
       .has_manual = true},
      argc, argv);
}

}  // namespace trivela::cli

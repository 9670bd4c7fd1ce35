#include "cli/emulate/devices.hpp"
#include "cli/program.hpp"

namespace cli = trivela::cli;

int main(int argc, char** argv) {
  return cli::run_program(
      {.name = "trivela-emulate",
       .what = "Be a device that is not there",
       .footer = "Prints the address to connect to, then the commands that it receives, until Ctrl-C.\n"
                 "Exit codes: 0 done, 1 failed, 2 bad usage.",
       .verbs = {{"Devices", {cli::add_ioboard, cli::add_rekick, cli::add_cia402, cli::add_mti, cli::add_refbox}}}},
      argc, argv);
}

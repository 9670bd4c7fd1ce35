#include "cli/program.hpp"

int main(int argc, char** argv) { return trivela::cli::run_verbs(argc, argv); }

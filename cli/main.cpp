#include "cli/run/verbs.hpp"

int main(int argc, char** argv) { return trivela::cli::run_verbs(argc, argv); }

#!/usr/bin/env bash
# Fails where clang-format would write a source otherwise; `clang-format -i FILE` mends it.
set -euo pipefail
find . \( -name build -o -name out -o -name .git \) -prune -o \( -name '*.cpp' -o -name '*.hpp' \) -print0 | xargs -0 clang-format --dry-run -Werror

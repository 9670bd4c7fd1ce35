#!/usr/bin/env bash
# clang-tidy as .clang-tidy says, over sources of a build that build/release holds (its generated headers are used).
#   tests/rules/tidy.sh FILE...      these
#   tests/rules/tidy.sh --changed    those that changed within three hours of the last commit, or whose header did, the 30 changed last: each is
#                                    compiled alone, so that a missing include is found, too
#   tests/rules/tidy.sh --all        every source outside of tests/ and examples/, which let an exception end them; pieces as they are compiled
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/release
flags=(-std=c++20 "-DTRIVELA_NODE_NAMES=\"\"" "-DTRIVELA_VERSION=\"\"" -I. -Iinclude -I$build -isystem /usr/include/eigen3 -DSPDLOG_COMPILED_LIB -DSPDLOG_FMT_EXTERNAL -DCPPHTTPLIB_OPENSSL_SUPPORT)
while IFS= read -r folder; do flags+=("-I$folder"); done < <(find $build -type d -name generated; echo $build/bus; echo $build/robot/recording)
for folder in /usr/include/python3.*; do flags+=(-isystem "$folder"); done
checks=()

case ${1:-} in
  --changed)
    if ! git rev-parse HEAD~1 >/dev/null 2>&1; then echo "SKIPPED: this is no checkout with a history"; exit 0; fi
    since=$(($(git log -1 --format=%ct) - 3 * 3600))
    mapfile -t files < <(git log --since=@$since --format= --name-only --diff-filter=AMR -- '*.cpp' '*.hpp' ':!tests' ':!examples' |
      sed 's/[.]hpp$/.cpp/' | awk '!seen[$0]++' | while IFS= read -r file; do [[ -f $file ]] && echo "$file"; done)
    [[ ${#files[@]} -le 30 ]] || echo "the 30 changed last of ${#files[@]}"
    files=("${files[@]:0:30}")
    ;;
  --all)
    mapfile -t files < <(find $build -name 'unity_*_cxx.cxx' ! -path "$build/tests/*" | sort)
    checks=(--checks=-bugprone-suspicious-include)
    ;;
  "") sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 2 ;;
  *) files=("$@") ;;
esac
[[ ${#files[@]} -gt 0 ]] || { echo "nothing changed"; exit 0; }
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -I{} clang-tidy --quiet "${checks[@]}" {} -- "${flags[@]}"

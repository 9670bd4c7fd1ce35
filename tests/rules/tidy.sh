#!/usr/bin/env bash
# clang-tidy as .clang-tidy says, over sources of a build that build/release holds (its generated headers are used).
#   tests/rules/tidy.sh FILE...      these
#   tests/rules/tidy.sh --changed    those that changed within three hours of the last commit, or whose header did; the 20 changed last are
#                                    compiled alone before, every warning an error, so that a missing include is found, too
#   tests/rules/tidy.sh --all        every source
# Of many files those of a unity file are checked together, since most of the time goes into the headers of others. There one check is
# left out that takes half of a large piece's time; it looks at single files. Tests need not be fast, and count in whole numbers.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/release
flags=(-std=c++20 -I. -Iinclude -I$build -isystem /usr/include/eigen3 -DSPDLOG_COMPILED_LIB -DSPDLOG_FMT_EXTERNAL -DCPPHTTPLIB_OPENSSL_SUPPORT)
for text in NODE_NAMES VERSION SOURCE_DIR BINARY_DIR LENIENT_ACCESS SLOW_DISK PATIENT ODD_POLICIES CMAKE; do flags+=("-DTRIVELA_$text=\"\""); done
while IFS= read -r folder; do flags+=("-I$folder"); done < <(find $build -type d -name generated; echo $build/bus; echo $build/robot/recording)
for folder in /usr/include/python3.*; do flags+=(-isystem "$folder"); done

# in_parallel COMMAND...: runs it for each line of the standard input, in place of {}.
in_parallel() { xargs -r -P "$(nproc)" -I{} "$@"; }

# by_unity FILE...: a source for each unity file, which includes those of its sources that are named; a file of none alone.
by_unity() {
  local pieces=$build/tidy unity
  rm -rf "$pieces" && mkdir -p "$pieces" && touch "$pieces/found"
  printf '#include "%s"\n' "${@/#/$PWD/}" | sort >"$pieces/wanted"
  while IFS= read -r unity; do
    grep -Fxf "$pieces/wanted" "$unity" >"$pieces/piece" || continue
    cat "$pieces/piece" >>"$pieces/found"
    mv "$pieces/piece" "$pieces/$(tr / _ <<<"${unity#"$build"/}")"
  done < <(find $build -name 'unity_*_cxx.cxx')
  find "$pieces" -name '*.cxx'
  sort -u "$pieces/found" | comm -13 - "$pieces/wanted" | sed 's/#include "\(.*\)"/\1/'
}

case ${1:-} in
  --changed)
    if ! git rev-parse HEAD~1 >/dev/null 2>&1; then echo "SKIPPED: this is no checkout with a history"; exit 0; fi
    since=$(($(git log -1 --format=%ct) - 3 * 3600))
    mapfile -t files < <(git log --since=@$since --format= --name-only --diff-filter=AMR -- '*.cpp' '*.hpp' |
      sed 's/[.]hpp$/.cpp/' | awk '!seen[$0]++' | while IFS= read -r file; do [[ ! -f $file ]] || echo "$file"; done)
    ;;
  --all) mapfile -t files < <(git ls-files '*.cpp') ;;
  "") sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 2 ;;
  *)
    printf '%s\n' "$@" | in_parallel clang-tidy --quiet {} -- "${flags[@]}"
    exit ;;
esac
[[ ${#files[@]} -gt 0 ]] || { echo "nothing changed"; exit 0; }
echo "${#files[@]} sources"
mapfile -t product < <(printf '%s\n' "${files[@]}" | grep -vE '^(tests|examples)/')
mapfile -t tests < <(printf '%s\n' "${files[@]}" | grep -E '^(tests|examples)/' | grep -v ^tests/interop/)
[[ $1 == --all || ${#product[@]} == 0 ]] || printf '%s\n' "${product[@]:0:20}" | in_parallel clang++ -fsyntax-only -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Werror "${flags[@]}" {}
checks=-bugprone-suspicious-include,-performance-unnecessary-value-param
[[ ${#product[@]} == 0 ]] || by_unity "${product[@]}" | in_parallel clang-tidy --quiet --checks=$checks {} -- "${flags[@]}"
checks+=,-performance-*,-readability-function-size,-bugprone-implicit-widening-of-multiplication-result,-bugprone-sizeof-container
checks+=,-bugprone-exception-escape,-bugprone-integer-division,-bugprone-string-constructor,-bugprone-unused-raii
# Eigen comes first, as in the build: <resolv.h> defines _res, a name of Eigen's.
[[ ${#tests[@]} == 0 ]] || by_unity "${tests[@]}" | in_parallel clang-tidy --quiet --checks=$checks {} -- -include Eigen/Core "${flags[@]}"

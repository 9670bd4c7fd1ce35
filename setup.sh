# Sourced by quickstart and run_tests: steps with elapsed time, the packages, the build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
started=$SECONDS step_number=0

# step TEXT: says what begins now.
step() { step_number=$((step_number + 1)); printf '[%d/%d] %3d s  %s\n' "$step_number" "$steps" $((SECONDS - started)) "$*"; }

# stop TEXT: the reason on stderr, exit 1.
stop() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# bar DONE TOTAL: one line that is drawn over, on a terminal alone.
bar() {
  [[ -t 1 ]] || return 0
  local filled=$(($1 * 40 / ($2 > 0 ? $2 : 1)))
  printf '\r        [%-40s] %d/%d  %d s ' "$(printf '%*s' "$filled" '' | tr ' ' '#')" "$1" "$2" $((SECONDS - started))
  [[ $1 -lt $2 ]] || printf '\n'
}

# follow LOG COMMAND...: runs it with its output in LOG, draws the bar from lines such as "[12/345] ...", shows the end of LOG when it fails.
follow() {
  local log=$1; shift
  mkdir -p "$(dirname "$log")"
  if ! "$@" 2>&1 | tee "$log" | while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] && bar "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" || true
  done; then
    [[ -t 1 ]] && printf '\n'
    tail -n 30 "$log" >&2
    stop "failed: $* (everything it said is in $log)"
  fi
}

# unused STEM ENDING: STEM.ENDING, or STEM-2.ENDING and so on: the first of which no file is there. A match log is never lost.
unused() {
  local n=1 name=$1$2
  while [[ -e $name || -e $name-wal || -e $name-shm ]]; do n=$((n + 1)); name=$1-$n$2; done
  echo "$name"
}

as_root() { if [[ $(id -u) == 0 ]]; then "$@"; else sudo "$@"; fi; }

# Installs what packages.txt lists and is not there yet: all of it, or with "programs" what stands above its last heading.
install_packages() {
  step "Debian packages (packages.txt)"
  local until=${1:-all}
  command -v apt-get >/dev/null || stop "apt-get is missing: Trivela is built with Debian 12's packages, listed in packages.txt"
  local missing=() name total count=0 log=build/logs/apt.log
  while read -r name; do
    [[ $until == programs && $name == "# run_tests alone"* ]] && break
    [[ -z $name || $name == \#* ]] && continue
    # A Node.js from elsewhere brings its npm and conflicts with Debian's.
    [[ $name == nodejs || $name == npm ]] && command -v "${name/nodejs/node}" >/dev/null && continue
    [[ $(dpkg-query -W -f '${Status}' "$name" 2>/dev/null) == "install ok installed" ]] || missing+=("$name")
  done <packages.txt
  [[ ${#missing[@]} -gt 0 ]] || { echo "        all there"; return 0; }
  [[ $(id -u) == 0 ]] || command -v sudo >/dev/null ||
    stop "these packages are missing, and installing them needs root or sudo: ${missing[*]}"
  echo "        installing ${missing[*]}"
  mkdir -p build/logs
  as_root apt-get -q update >"$log" 2>&1 || { tail -n 5 "$log" >&2; stop "apt-get update failed (log: $log)"; }
  total=$(apt-get -s install --no-install-recommends "${missing[@]}" 2>/dev/null | grep -c '^Inst' || true)
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -y -q install --no-install-recommends "${missing[@]}" 2>&1 | tee -a "$log" |
    while IFS= read -r name; do [[ $name == "Setting up "* ]] && count=$((count + 1)) && bar "$count" "$total" || true; done ||
    { tail -n 5 "$log" >&2; stop "apt-get could not install: ${missing[*]} (log: $log)"; }
}

# past_compiler_crash COMMAND...: runs it, and once more where GCC 12 crashed as it wrote a precompiled header ("in gt_pch_save"), which
# it does now and then: a second run goes on from there. Any other failure stays one.
past_compiler_crash() {
  local said
  said=$(mktemp)
  "$@" 2>&1 | tee "$said" || { grep -q "internal compiler error: in gt_pch_save" "$said" && "$@"; }
}

# build PRESET [TARGET...]: configures (with configure_options) and builds build/PRESET.
configure_options=()
build() {
  local preset=$1; shift
  step "build/$preset"
  local tool
  for tool in cmake ninja g++ idlc; do command -v "$tool" >/dev/null || stop "$tool is missing though packages.txt lists its package"; done
  follow "build/logs/$preset-configure.log" cmake --preset "$preset" "${configure_options[@]}"
  follow "build/logs/$preset-build.log" past_compiler_crash cmake --build --preset "$preset" ${@:+--target "$@"}
}

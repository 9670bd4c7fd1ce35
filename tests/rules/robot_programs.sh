#!/usr/bin/env bash
# robot_programs.sh BUILD PROGRAM...: what a program that runs on a robot must not contain, as nm and ldd see it.
# - No function of the emulators' library: a driver must not be able to be a device.
# - No function of the simulator's library. The recorder reads a scenario's file, to record it.
# - No SQLite, but in the recorders.
set -euo pipefail
build=$1
shift

# functions FILE...: names of the functions that are defined there for others, sorted.
functions() { nm --defined-only "$@" 2>/dev/null | awk '$2 == "T" {print $3}' | sort -u; }

emulators=$(functions "$build/emulators/libtrivela_emulators.a")
simulator=$(functions "$build/sim/libtrivela_sim.a")
scenario=$(functions "$(find "$build/sim" -name 'scenario.cpp.o' | head -1)")
for library in "$emulators" "$simulator" "$scenario"; do
  [ -n "$library" ] || { echo "nm finds no function in a library: this check would pass in vain"; exit 1; }
done

failed=0
# refuse PROGRAM WHAT FUNCTIONS: none of them is in the program.
refuse() {
  local found
  found=$(comm -12 <(functions "$build/$1") <(printf '%s\n' "$3"))
  [ -z "$found" ] && return
  echo "$1 contains the $2: $(wc -l <<<"$found") functions, as $(head -1 <<<"$found" | c++filt)"
  failed=1
}

for program in "$@"; do
  [ "$(functions "$build/$program" | wc -l)" -gt 100 ] || { echo "$program: nm finds no functions"; exit 1; }
  refuse "$program" emulators "$emulators"
  case $program in
    trivela-recorder) refuse "$program" simulator "$(comm -23 <(printf '%s\n' "$simulator") <(printf '%s\n' "$scenario"))" ;;
    *) refuse "$program" simulator "$simulator" ;;
  esac
  case $program in
    trivela-recorder | trivela-scan_recorder) ;;
    *)
      if ldd "$build/$program" | grep -qi sqlite || nm "$build/$program" | grep -qi 'sqlite3_'; then
        echo "$program uses SQLite"
        failed=1
      fi
      ;;
  esac
done
exit $failed

#!/bin/bash
# The job arrays of examples/slurm/ on a real Slurm of one node, beside one run of each: the rows must be the same.
#   tests/slurm/one_node.sh tests/slurm/arrays.sh [BUILD]
# By hand, as root, with Debian's packages slurm-wlm, munge and sqlite3.
set -euo pipefail
top=$(git -C "$(dirname "$0")" rev-parse --show-toplevel)
export TRIVELA=${TRIVELA:-${1:-$top/build/release}/trivela}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
say() { printf '\n$ %s\n' "$*"; "$@"; }
same() {  # two files, their tables
  local one=$1 other=$2 table
  shift 2
  for table; do
    cmp <(sqlite3 "$one" "SELECT * FROM $table") <(sqlite3 "$other" "SELECT * FROM $table") || exit 1
  done
  echo "$one and $other have the same rows: $*"
}
ab=(--arms stopped,moving --matches 40 --possessions 10)
say sbatch --wait --array=1-4 "$top/examples/slurm/simulate.sbatch" ab "${ab[@]}"
squeue
cat trivela-*_2.txt
rm trivela-*.txt
say "$TRIVELA" merge ab.db ab/shard_1.db ab/shard_2.db ab/shard_3.db ab/shard_4.db
"$TRIVELA" simulate "${ab[@]}" --jobs 2 --out whole.db > /dev/null
same ab.db whole.db sessions digests kick_decisions kick_receipts kick_outcomes possession_truths

study=(frontier --matches 12 --possessions 5 --threshold 0.2,0.6)
say sbatch --wait --array=1-4 "$top/examples/slurm/study.sbatch" fr "${study[@]}"
"$TRIVELA" study "${study[@]}" --results whole_frontier.results > one.txt
say "$TRIVELA" study "${study[@]}" --results frontier.results --with fr/shard_*.results > all.txt 2> /dev/null
cmp one.txt <(tail -n +3 all.txt)
cmp <(sort frontier.results) <(sort whole_frontier.results)

tune=(stopped --matches 8 --possessions 5 --calibrations 0 --rounds 2 --setting policy.settle_s --setting policy.dribble_mps)
say "$top/examples/slurm/tune.sh" 2 tune best.toml "${tune[@]}"
"$TRIVELA" study tune "${tune[@]}" --out whole.toml > /dev/null
cmp best.toml whole.toml

# A task whose time is up keeps what it has, and the same command goes on.
long=(--arms stopped,moving --matches 4000 --possessions 20)
printf '\n$ sbatch --wait --array=1-1 ... --matches 4000, stopped by scancel --signal=TERM\n'
job=$(sbatch --parsable --array=1-1 "$top/examples/slurm/simulate.sbatch" long "${long[@]}")
for _ in $(seq 100); do [[ -s long/shard_1.db-wal ]] && break; sleep 0.1; done
sleep 2
scancel --signal=TERM "$job"
for _ in $(seq 100); do [[ -z $(squeue --noheader) ]] && break; sleep 0.2; done
cat trivela-"${job}"_1.txt

#!/bin/bash
# A search step by step, each step an array of shards:
#   examples/slurm/tune.sh TASKS FOLDER OUT.toml stopped --matches 2000 ...
# Given again it goes on where it was. The steps are as many as the search has.
set -euo pipefail
tasks=$1 folder=$2 out=$3
shift 3
here=$(dirname "$(realpath "$0")")
with=()
for ((step = 1; ; ++step)); do
  code=0
  if [[ ! -e $folder/step_$step/done ]]; then
    sbatch --wait --array="1-$tasks" "$here/study.sbatch" "$folder/step_$step" tune "$@" "${with[@]}" || code=$?
    if ((code == 0)); then break; fi   # the search has ended
    if ((code != 3)); then exit "$code"; fi
    touch "$folder/step_$step/done"
  fi
  with=(--with "$folder/step_$step"/shard_*.results)
done
exec "${TRIVELA:-trivela}" study tune "$@" --with "$folder/step_$step"/shard_*.results --out "$out"

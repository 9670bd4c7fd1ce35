#!/bin/bash
# A search step by step, each step an array of shards:
#   examples/slurm/tune.sh TASKS FOLDER OUT.toml stopped --matches 2000 ...
# Given again it goes on where it was. The steps are as many as the search has.
set -euo pipefail
tasks=$1 folder=$2 out=$3
shift 3
here=$(dirname "$(realpath "$0")")
mkdir -p "$folder"
step=$(find "$folder" -name 'merged_*.db' | wc -l)
while :; do
  after=()
  if ((step > 0)); then after=(--after "$folder/merged_$step.db"); fi
  code=0
  sbatch --wait --array="1-$tasks" "$here/study.sbatch" "$folder" tune "$@" "${after[@]}" || code=$?
  if ((code == 0)); then break; fi   # the search has ended
  if ((code != 3)); then exit "$code"; fi
  step=$((step + 1))
  "${TRIVELA:-trivela}" merge "$folder/merged_$step.db" "$folder"/shard_*.db
done
exec "${TRIVELA:-trivela}" tune "$@" --tallies "$folder/merged_$step.db" --out "$out"

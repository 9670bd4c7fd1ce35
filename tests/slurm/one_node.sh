#!/bin/bash
# A Slurm of one node on the loopback, of Debian's packages slurm-wlm and munge, for as long as a command runs:
#   tests/slurm/one_node.sh COMMAND...
# By hand, as root; it has a folder, a key, ports and processes of its own, and ends them.
set -euo pipefail
folder=$(mktemp -d /tmp/one_node.XXXXXX)
chmod 755 "$folder"
node=$(hostname -s)
export SLURM_CONF=$folder/slurm.conf
pids=()
end() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  wait
  rm -rf "$folder"
}
trap end EXIT

/usr/sbin/mungekey --create --keyfile="$folder/munge.key"
mkdir "$folder/state" "$folder/spool"
cat > "$SLURM_CONF" <<CONF
ClusterName=one
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=36817
SlurmdPort=36818
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONF
munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
  --log-file="$folder/munged.log" --seed-file="$folder/munged.seed" 2>/dev/null &
pids+=($!)
for _ in $(seq 50); do [[ -S $folder/munge.socket ]] && break; sleep 0.1; done
slurmctld -D -f "$SLURM_CONF" >/dev/null 2>&1 &
pids+=($!)
slurmd -D -f "$SLURM_CONF" -N "$node" >/dev/null 2>&1 &
pids+=($!)
for _ in $(seq 100); do
  [[ $(sinfo --noheader --format=%t 2>/dev/null) == idle ]] && break
  sleep 0.2
done
if [[ $(sinfo --noheader --format=%t) != idle ]]; then
  tail -n 20 "$folder"/*.log
  exit 1
fi
"$@"

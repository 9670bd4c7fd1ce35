#!/usr/bin/env bash
# The units under systemd itself: what team configure wrote is started, watched, started again and stopped, in a bare Debian 12 whose systemd is
# the first process of namespaces of its own.
#   tests/packages/systemd_root.sh BUILD [DEB...]     as root; needs debootstrap and, the first time, a mirror (DEBIAN_MIRROR)
[[ $# -ge 1 ]] || { sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 2; }
source "$(dirname "$0")/kept_root.sh"
install systemd
configure
# What a container without devices cannot have; no accounting, so that the machine's other control groups stay as they are.
units="$root/etc/systemd/system"
for unit in systemd-udevd.service systemd-udevd-control.socket systemd-udevd-kernel.socket systemd-udev-trigger.service systemd-sysctl.service \
  systemd-modules-load.service systemd-random-seed.service dev-hugepages.mount sys-kernel-debug.mount sys-kernel-tracing.mount; do
  ln -sf /dev/null "$units/$unit"
done
mkdir -p "$root/etc/systemd/system.conf.d"
printf '[Manager]\nDefaultCPUAccounting=no\nDefaultMemoryAccounting=no\nDefaultTasksAccounting=no\nDefaultIOAccounting=no\nDefaultBlockIOAccounting=no\n' >"$root/etc/systemd/system.conf.d/bare.conf"
umount "$root/proc"

# Control groups of its own become the roots of those that it sees.
if [[ -d /sys/fs/cgroup/systemd ]]; then
  kind="cgroup -o none,name=systemd" at=/sys/fs/cgroup/systemd groups=()
  for name in systemd unified pids devices; do [[ ! -d /sys/fs/cgroup/$name ]] || groups+=("/sys/fs/cgroup/$name/trivela-root-$$"); done
else
  kind=cgroup2 at=/sys/fs/cgroup groups=("/sys/fs/cgroup/trivela-root-$$")
fi
mkdir "${groups[@]}" 2>/dev/null || skip "no control group can be made here"
cat >"$root/boot.sh" <<END
for group in ${groups[*]}; do echo \$\$ >\$group/cgroup.procs || exit 77; done
exec unshare --cgroup --mount --fork --pid --kill-child --uts --ipc --net sh -c '
  set -e
  mount --bind "$root" "$root"
  mount -t proc proc "$root/proc"
  mount -t sysfs sysfs "$root/sys"
  [ $at = /sys/fs/cgroup ] || mount -t tmpfs tmpfs "$root/sys/fs/cgroup"
  mkdir -p "$root$at"
  mount -t $kind cgroup "$root$at"
  mount -t tmpfs tmpfs "$root/run"
  mount --rbind /dev "$root/dev"
  ip link set lo up
  exec chroot "$root" env -i container=lxc PATH=/usr/sbin:/usr/bin:/sbin:/bin /lib/systemd/systemd --unit=basic.target --show-status=no'
END
say "boots"
sh "$root/boot.sh" >"$root/boot.log" 2>&1 &
booted=$!
first() { pgrep -P "$booted" | head -n 1; }
end() {
  local process
  for process in $(first) "$booted"; do kill -KILL "$process" 2>/dev/null || true; done
  wait "$booted" 2>/dev/null || true
  # They are empty when the last process has gone.
  local group
  for _ in {1..100}; do
    for group in "${groups[@]}"; do [[ ! -d $group ]] || find "$group" -depth -type d -exec rmdir {} \; 2>/dev/null || true; done
    [[ -n $(find "${groups[@]}" -maxdepth 0 2>/dev/null) ]] || break
    sleep 0.1
  done
  finish
}
trap end EXIT
# there COMMAND...: beside its systemd.
there() { nsenter -t "$(first)" --mount --pid --uts --ipc --net --cgroup chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }
# until_ok WHAT COMMAND...: within half a minute.
until_ok() {
  local what=$1 n; shift
  for n in {1..300}; do "$@" && return 0; kill -0 "$booted" 2>/dev/null || break; sleep 0.1; done
  there journalctl --no-pager -n 20 >&2 || tail "$root/boot.log" >&2
  stop "$what"
}
is_up() { there systemctl is-active --quiet basic.target 2>/dev/null; }
for _ in {1..150}; do is_up && break; kill -0 "$booted" 2>/dev/null || break; sleep 0.1; done
is_up || { tail -n 3 "$root/boot.log"; skip "systemd does not come up in namespaces here"; }

all_run() { local node; for node in $nodes; do there systemctl is-active --quiet "trivela@$node" || return 1; done; }
none_runs() { local node; for node in $nodes; do [[ $(pid "$node") == 0 ]] || return 1; done; }
pid() { there systemctl show "trivela@$1" -p MainPID --value; }
start_nodes() {
  say "systemctl start trivela.target"
  there systemctl start trivela.target
  nodes=$(sed -n 's/^TRIVELA_NODES="\(.*\)"/\1/p' "$root/etc/trivela/team/robot.env")
  until_ok "not every node of $nodes runs" all_run
  say "all run: $nodes"
}
stop_nodes() {
  there systemctl stop trivela.target
  until_ok "a node goes on after the target was stopped" none_runs
  local log
  for log in "$root"/var/lib/trivela/"$team"-1-*.db; do [[ ! -e $log-wal ]] || stop "the log was not closed"; done
}

# comes_back NODE SIGNAL: another process of it runs.
comes_back() {
  local node=$1 struck began=$EPOCHREALTIME
  struck=$(pid "$node")
  there sh -c "kill -$2 $struck"
  again() { local now; now=$(pid "$node"); [[ $now != 0 && $now != "$struck" ]] && there systemctl is-active --quiet "trivela@$node"; }
  until_ok "$node stayed away after $2" again
  say "$node is back after $2: $(awk "BEGIN {printf \"%.1f\", $EPOCHREALTIME - $began}") s"
}
start_nodes
[[ $(there stat -c %U "/proc/$(pid kick_decision)") == trivela ]] || stop "a node is not the user trivela's"
comes_back world_state KILL
comes_back kick_decision STOP
stop_nodes

configure $'[run]\none_process = true'
there systemctl daemon-reload
start_nodes
[[ " $nodes " == *" chain "* && " $nodes " != *" odometry "* ]] || stop "$nodes: not the decision path in one process"
comes_back chain KILL
comes_back chain STOP
stop_nodes
# A recorder whose folder refuses: its log is still there when the service has gone.
sed -i 's|^log = .*|log = "/media/stick/{team}-{robot}-{time}.db"|' "$root/etc/trivela/team/settings.toml"
grep -q /media/stick "$root/etc/trivela/team/settings.toml" || stop "the recorder's folder cannot be set"
before=$(find "$root/var/lib/trivela" -name '*.db' | wc -l)
start_nodes
stop_nodes
[[ $(find "$root/var/lib/trivela" -name '*.db' | wc -l) -gt $before ]] || stop "the log of a recorder whose folder refuses is gone"
say "all well: started, watched and stopped by systemd"

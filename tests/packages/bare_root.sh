#!/usr/bin/env bash
# Trivela's packages in a bare Debian 12: installed, configured as a robot of a team, started by trivela-launch with the C examples as
# devices, recorded, purged.
#   tests/packages/bare_root.sh BUILD [DEB...]     as root; needs debootstrap and, the first time, a mirror (DEBIAN_MIRROR)
# BUILD has the examples; the DEBs are all three, made by cpack where none is given. Everything happens in a temporary root, which goes at
# the end; what it begins with is kept in BUILD/bare_root. Ends with 77 where no root can be made here.
set -euo pipefail
[[ $# -ge 1 ]] || { sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 2; }
build=$(readlink -f "$1"); shift
skip() { printf 'SKIPPED: %s\n' "$*"; exit 77; }
[[ $(id -u) == 0 ]] || skip "a bare root needs root"
command -v debootstrap >/dev/null || skip "there is no debootstrap (packages.txt)"
kept=$build/bare_root
root=$(mktemp -d /var/tmp/trivela-root-XXXXXX)
chmod 755 "$root" # for the user trivela, too
processes=()
finish() {
  local process
  for process in "${processes[@]}"; do kill -TERM "$process" 2>/dev/null && wait "$process" || true; done
  ! mountpoint -q "$root/proc" || umount "$root/proc"
  rm -rf --one-file-system "$root"
}
trap finish EXIT
say() { printf '%3d s  %s\n' "$SECONDS" "$*"; }
stop() { printf 'bare_root: %s\n' "$*" >&2; tail -n 20 "$root"/var/lib/trivela/*.log >&2 2>/dev/null || true; exit 1; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"; }
logs() { find "$root/var/lib/trivela" -name "$team-1-*.db"; }
# rows TABLE: of the one log that the recorder has named by itself.
rows() { inside trivela query "/var/lib/trivela/$(basename "$(logs)")" "SELECT count(*) AS n FROM $1" --csv 2>/dev/null | tail -n 1; }

if [[ ! -e $kept/made ]]; then
  say "a bare root, to be kept in $kept"
  rm -rf --one-file-system "$kept"
  mkdir -p "$kept"
  debootstrap --variant=minbase bookworm "$kept/root" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$kept/log" 2>&1 ||
    { tail -n 3 "$kept/log"; skip "debootstrap cannot make a root (log: $kept/log)"; }
  touch "$kept/made"
fi
cp -a --reflink=auto "$kept/root/." "$root"
mount -t proc proc "$root/proc" 2>/dev/null || skip "/proc cannot be mounted in a root here"

if [[ $# == 0 ]]; then
  say "packages"
  (cd "$build" && cpack --config CPackConfig.cmake -B "$root/made" -D CPACK_DEBIAN_COMPRESSION_TYPE=none) >"$root/cpack.log" 2>&1 ||
    { tail "$root/cpack.log" >&2; stop "cpack fails"; }
  set -- "$root"/made/*.deb
fi
say "installs"
mkdir "$root/debs"
cp "$@" "$root/debs"
# Debian's packages that they need are fetched once.
inside sh -c 'apt-get -q -y --no-install-recommends --download-only install /debs/*.deb' >"$root/install.log" 2>&1 ||
  { tail -n 3 "$root/install.log"; skip "the packages that Trivela's need cannot be fetched"; }
cp -n "$root"/var/cache/apt/archives/*.deb "$kept/root/var/cache/apt/archives/" 2>/dev/null || true
inside sh -c 'apt-get -q -y --no-install-recommends install /debs/*.deb' >"$root/install.log" 2>&1 || { tail -n 20 "$root/install.log" >&2; stop "cannot install"; }
inside trivela --version | grep -qx 'configuration: /etc/trivela' || stop "trivela does not find /etc/trivela"

say "an edit survives a second installation"
sed -i 's/^log_level = "info"/log_level = "debug"/' "$root/etc/trivela/default.toml"
inside sh -c 'dpkg --install /debs/*.deb' >>"$root/install.log" 2>&1
grep -q '^log_level = "debug"' "$root/etc/trivela/default.toml" || stop "the edit is gone"

team=root-$$
say "is robot 1 of the team $team"
sed "s/^name = .*/name = \"$team\"/; s/^interface = .*/interface = \"none0\"/" "$root/etc/trivela/teams/example.toml" >"$root/etc/trivela/teams/here.toml"
inside trivela team configure /etc/trivela/teams/here.toml --robot 1 --out /etc/trivela/team >"$root/configure.log" || stop "cannot configure"
inside grep -qx 'Wants=trivela@team_link.service' /usr/lib/systemd/system/trivela.target.d/team.conf || stop "trivela.target does not know the nodes"

say "plays: the launcher, and the C examples as base, kicker and camera"
cp "$build/examples/bridge/bridge" "$build/examples/vision/vision" "$root/usr/local/bin"
chroot --userspec=trivela:trivela "$root" env -i PATH=/usr/bin trivela-launch &
processes+=($!) launcher=$!
for example in bridge vision; do
  chroot "$root" env -i CYCLONEDDS_URI=file:///etc/trivela/cyclonedds/loopback.xml "TRIVELA_TAG=$team-1" "/usr/local/bin/$example" 42 >/dev/null &
  processes+=($!)
done
for _ in {1..60}; do
  [[ -n $(logs) && $(rows odometry) -gt 100 ]] && break
  kill -0 "$launcher" || stop "the launcher ended"
  sleep 1
done
[[ -n $(logs) && $(rows odometry) -gt 100 ]] || stop "no odometry in the log"
say "$(rows odometry) rows of odometry in $(basename "$(logs)"); a node that is killed comes back"
# pid NODE: of this root, not of another one on this machine.
pid() {
  local process
  for process in $(pgrep -f "^/usr/bin/trivela-$1 "); do
    [[ $(readlink "/proc/$process/root") == "$root" ]] && echo "$process" && return 0
  done
  return 0
}
pid team_link | grep -q . || stop "team_link does not run"
killed=$(pid world_state)
kill -KILL "$killed"
for _ in {1..20}; do [[ -n $(pid world_state) && $(pid world_state) != "$killed" ]] && break; sleep 0.5; done
[[ -n $(pid world_state) && $(pid world_state) != "$killed" ]] || stop "world_state stayed dead"
kill -TERM "$launcher"
wait "$launcher" || stop "the launcher ended with $?"
[[ ! -e $(logs)-wal ]] || stop "the log was not closed"

say "purges"
inside dpkg --purge trivela-base trivela-dev trivela-robot >>"$root/install.log" 2>&1 || { tail "$root/install.log" >&2; stop "cannot purge"; }
left=$(find "$root/etc" "$root/usr" -name '*trivela*' -not -path '*/local/*' -not -path '*/etc/trivela' -print)
[[ -z $left ]] || stop "left behind: $left"
[[ $(find "$root/etc/trivela" -type f) == "$root/etc/trivela/teams/here.toml" ]] || stop "of /etc/trivela the team's own file alone should be left"
[[ -e $(logs) ]] || stop "the match log is gone"
say "all well: nothing is left but the logs and the team's file"

#!/usr/bin/env bash
# Trivela's packages in a bare Debian 12: installed, started by trivela-launch with the C examples as devices, recorded, purged.
#   tests/packages/bare_root.sh BUILD DEB...     as root; needs debootstrap and a mirror (DEBIAN_MIRROR)
# BUILD has the examples; the DEBs are all three. Everything happens in a temporary root, which goes at the end.
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 2; }
build=$1; shift
root=$(mktemp -d /var/tmp/trivela-root-XXXXXX)
chmod 755 "$root" # for the user trivela, too
processes=()
finish() {
  local process
  for process in "${processes[@]}"; do kill -TERM "$process" 2>/dev/null && wait "$process" || true; done
  mountpoint -q "$root/proc" && umount "$root/proc"
  rm -rf --one-file-system "$root"
}
trap finish EXIT
say() { printf '%3d s  %s\n' "$SECONDS" "$*"; }
stop() { printf 'bare_root: %s\n' "$*" >&2; tail -n 20 "$root"/var/lib/trivela/*.log >&2 2>/dev/null || true; exit 1; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"; }
rows() { inside trivela query /var/lib/trivela/match.db "SELECT count(*) AS n FROM $1" --csv 2>/dev/null | tail -n 1; }

say "a bare root"
debootstrap --variant=minbase bookworm "$root" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$root.log" 2>&1 || { cat "$root.log" >&2; exit 1; }
rm "$root.log"
mount -t proc proc "$root/proc"

say "installs"
mkdir "$root/debs"
cp "$@" "$root/debs"
inside sh -c 'apt-get -q -y --no-install-recommends install /debs/*.deb' >"$root/install.log" 2>&1 || { tail -n 20 "$root/install.log" >&2; stop "cannot install"; }
inside trivela --version | grep -qx 'configuration: /etc/trivela' || stop "trivela does not find /etc/trivela"

say "an edit survives a second installation"
sed -i 's/^log_level = "info"/log_level = "debug"/' "$root/etc/trivela/default.toml"
inside sh -c 'dpkg --install /debs/*.deb' >>"$root/install.log" 2>&1
grep -q '^log_level = "debug"' "$root/etc/trivela/default.toml" || stop "the edit is gone"

say "plays: the launcher, and the C examples as base, kicker and camera"
cp "$build/examples/bridge/bridge" "$build/examples/vision/vision" "$root/usr/local/bin"
chroot --userspec=trivela:trivela "$root" env -i PATH=/usr/bin trivela-launch &
processes+=($!) launcher=$!
for example in bridge vision; do
  chroot "$root" env -i CYCLONEDDS_URI=file:///etc/trivela/cyclonedds/loopback.xml TRIVELA_TAG=trivela "/usr/local/bin/$example" 42 >/dev/null &
  processes+=($!)
done
for _ in {1..60}; do
  [[ $(rows odometry) -gt 100 ]] && break
  kill -0 "$launcher" || stop "the launcher ended"
  sleep 1
done
[[ $(rows odometry) -gt 100 ]] || stop "no odometry in the log"
say "$(rows odometry) rows of odometry; a node that is killed comes back"
pid() { pgrep -f "^/usr/bin/trivela-$1 " --newest || true; }
killed=$(pid world_state)
kill -KILL "$killed"
for _ in {1..20}; do [[ -n $(pid world_state) && $(pid world_state) != "$killed" ]] && break; sleep 0.5; done
[[ -n $(pid world_state) && $(pid world_state) != "$killed" ]] || stop "world_state stayed dead"
kill -TERM "$launcher"
wait "$launcher" || stop "the launcher ended with $?"
[[ ! -e $root/var/lib/trivela/match.db-wal ]] || stop "the log was not closed"

say "purges"
inside dpkg --purge trivela-base trivela-dev trivela-robot >>"$root/install.log" 2>&1 || { tail "$root/install.log" >&2; stop "cannot purge"; }
left=$(find "$root/etc" "$root/usr" -name '*trivela*' -not -path '*/local/*' -print)
[[ -z $left ]] || stop "left behind: $left"
[[ -e $root/var/lib/trivela/match.db ]] || stop "the match log is gone"
say "all well: nothing is left but the logs"

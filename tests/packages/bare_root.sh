#!/usr/bin/env bash
# Trivela's packages in a bare Debian 12: installed, configured as a robot of a team, started by trivela-launch with the C examples as
# devices, recorded, purged.
#   tests/packages/bare_root.sh BUILD [DEB...]     as root; needs debootstrap and, the first time, a mirror (DEBIAN_MIRROR)
[[ $# -ge 1 ]] || { sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 2; }
source "$(dirname "$0")/kept_root.sh"
logs() { find "$root/var/lib/trivela" -name "$team-1-*.db"; }
# rows TABLE: of the one log that the recorder has named by itself.
rows() { inside trivela query "/var/lib/trivela/$(basename "$(logs)")" "SELECT count(*) AS n FROM $1" --csv 2>/dev/null | tail -n 1; }

inside trivela --version | grep -qx 'configuration: /etc/trivela' || stop "trivela does not find /etc/trivela"

say "an edit survives a second installation"
sed -i 's/^log_level = "info"/log_level = "debug"/' "$root/etc/trivela/default.toml"
inside sh -c 'dpkg --install /debs/*.deb' >>"$root/install.log" 2>&1
grep -q '^log_level = "debug"' "$root/etc/trivela/default.toml" || stop "the edit is gone"

say "is robot 1 of the team $team"
configure
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

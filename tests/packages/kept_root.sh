# Sourced by bare_root.sh and systemd_root.sh, with BUILD [DEB...]: a temporary root with a bare Debian 12 and Trivela's packages in it, $root,
# which goes at the end with the $processes. What it begins with is kept in BUILD/bare_root. The DEBs are all three, made by cpack where none
# is given. Ends with 77 where no root can be made here.
set -euo pipefail
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
stop() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; tail -n 20 "$root"/var/lib/trivela/*.log >&2 2>/dev/null || true; exit 1; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"; }

# fetch PACKAGE...: what apt-get needs to install them is kept for the next time.
fetch() {
  inside apt-get -q -y --no-install-recommends --download-only install "$@" >"$root/install.log" 2>&1 ||
    { tail -n 3 "$root/install.log"; skip "packages cannot be fetched: $*"; }
  cp -n "$root"/var/cache/apt/archives/*.deb "$kept/root/var/cache/apt/archives/" 2>/dev/null || true
}

# install PACKAGE...
install() {
  fetch "$@"
  inside apt-get -q -y --no-install-recommends install "$@" >"$root/install.log" 2>&1 || { tail -n 20 "$root/install.log" >&2; stop "cannot install $*"; }
}

# configure [SETTINGS]: this root is robot 1 of the team $team, whose network is not there; SETTINGS is a text of TOML.
team=root-$$
configure() {
  local settings=
  if [[ $# != 0 ]]; then settings=here.settings.toml; printf '%s\n' "$1" >"$root/etc/trivela/teams/$settings"; fi
  sed "s/^name = .*/name = \"$team\"/; s/^interface = .*/interface = \"none0\"/; s/^settings = .*/settings = \"$settings\"/" \
    "$root/etc/trivela/teams/example.toml" >"$root/etc/trivela/teams/here.toml"
  inside trivela team configure /etc/trivela/teams/here.toml --robot 1 --out /etc/trivela/team >"$root/configure.log" || stop "cannot configure"
}

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
  set -- "$root"/made/trivela-*.deb
fi
mkdir "$root/debs"
cp "$@" "$root/debs"
say "installs"
install $(cd "$root" && printf '/%s ' debs/*.deb)

#!/usr/bin/env bash
# Runs a command of this tree in a bare root of a Debian release.
#
#   Testing/Releases/in-root.sh [--again] RELEASE USER COMMAND...
#
# RELEASE  bookworm, trixie, forky, sid, ...: any name of a release in Debian's archive
# USER     root, in a root without sudo; or any other name, of a user who may sudo
# --again  goes on in the root of the last run, with the sources as they are now
#
# The command runs in /tree, a copy of the sources. The root is build/roots/RELEASE and stays there, to be looked into; packages
# and compiled objects are kept beside it, so that the next run takes them. As root; on Debian, with debootstrap.
#
# A bare root is made once and kept in build/roots/RELEASE.tar. Remove that file for a newer one of testing or sid.
set -euo pipefail

again=
if [ "${1:-}" = --again ]; then
  again=yes
  shift
fi
if [ $# -lt 3 ]; then
  sed -n '2,/^set/{s/^# \?//;/^set/!p}' "$0" >&2
  exit 2
fi
[ "$(id -u)" -eq 0 ] || { echo "$0: run it as root, since it makes a root of another system" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "$0: install debootstrap" >&2; exit 1; }

release=$1 user=$2
shift 2
cd "$(dirname "$0")/../.."
mkdir -p "build/roots/$release."{packages,objects}
chmod 777 "build/roots/$release.objects"
root=$PWD/build/roots/$release
archive=http://deb.debian.org/debian

# In namespaces of its own: its mounts and processes end with it.
isolated() { unshare --mount --pid --fork --kill-child -- "$@"; }

# Runs a program in the root.
in_root() {
  isolated bash -euc '
    root=$1
    shift
    mount --types proc proc "$root/proc"
    for folder in /dev /sys; do
      mount --rbind "$folder" "$root$folder"
    done
    mount --bind "$root.packages" "$root/var/cache/apt/archives"
    mount --bind "$root.objects" "$root/var/cache/objects"
    exec chroot "$root" env --ignore-environment LANG=C.UTF-8 TERM="${TERM:-dumb}" PATH=/usr/sbin:/usr/bin:/sbin:/bin \
      CCACHE_DIR=/var/cache/objects CCACHE_UMASK=000 "$@"
  ' in_root "$root" "$@"
}

if [ ! -e "$root.tar" ]; then
  echo "Making a bare root of $release"
  rm -rf "$root"
  # The recipe of sid is that of every release, also of those that this debootstrap does not know yet.
  isolated debootstrap --variant=minbase --cache-dir="$root.packages" "$release" "$root" "$archive" \
    /usr/share/debootstrap/scripts/sid
  echo "deb $archive $release main" > "$root/etc/apt/sources.list"
  if [ "$release" != sid ]; then # new versions go to sid itself
    echo "deb $archive-security $release-security main" >> "$root/etc/apt/sources.list"
  fi
  echo force-unsafe-io > "$root/etc/dpkg/dpkg.cfg.d/unsafe-io" # a root that lasts for minutes needs no fsync
  cat > "$root/etc/apt/apt.conf.d/root" <<'END'
Acquire::Check-Valid-Until "false"; // a mirror of testing may be some weeks old
Binary::apt-get::APT::Keep-Downloaded-Packages "true";
END
  mkdir "$root/var/cache/objects"
  tar --create --one-file-system --file "$root.tar.new" --directory "$root" .
  mv "$root.tar.new" "$root.tar" # whole, also where a run was interrupted
fi

if [ -z "$again" ] || [ ! -e "$root" ]; then
  rm -rf --one-file-system "$root"
  mkdir "$root"
  tar --extract --file "$root.tar" --directory "$root"
  if [ "$user" != root ]; then
    in_root sh -euc "
      apt-get update --quiet=2
      DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet=2 --no-install-recommends sudo
      useradd --create-home --shell /bin/bash $user
      echo '$user ALL = NOPASSWD: ALL' > /etc/sudoers.d/$user"
  fi
fi

mkdir -p "$root/tree"
# All files are new: objects of the last run may be younger than a change that they lack. The cache of objects knows the rest. Files that
# are gone are gone there, too.
find "$root/tree" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
git ls-files --cached --others --exclude-standard -z |
  tar --create --null --files-from=- --ignore-failed-read | tar --extract --touch --no-same-owner --directory "$root/tree"
in_root chown --recursive "$user" /tree
in_root setpriv --reuid "$user" --regid "$user" --init-groups --reset-env \
  env CCACHE_DIR=/var/cache/objects CCACHE_UMASK=000 bash -euc 'cd /tree && "$@"' bash "$@"

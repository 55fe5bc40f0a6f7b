#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     debian_package.sh SOURCE BUILD
#
# Makes the Debian package and installs it on a bare Debian 12 in a chroot: dependencies alone, man page,
# check, first-contact, a result read by the Python package. Needs root, debootstrap and a mirror
# ($ASPERITY_MIRROR, else that of the first source in apt's list). Exit code 77: not possible here.
set -u
source=$(cd -- "$1" && pwd)
build=$(cd -- "$2" && pwd)

skip() { echo "skipped: $*"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "only root may chroot"
command -v debootstrap >/dev/null || skip "no debootstrap"
command -v dpkg-shlibdeps >/dev/null || skip "no dpkg-dev"
mirror=${ASPERITY_MIRROR:-$(cat /etc/apt/sources.list /etc/apt/sources.list.d/*.sources /etc/apt/sources.list.d/*.list 2>/dev/null |
    grep -oE 'https?://[^ ]*debian/?( |$)' | head -n 1)}
mirror=${mirror:-http://deb.debian.org/debian}

work=$(mktemp -d "${TMPDIR:-/tmp}/asperity-deb.XXXXXX") || exit 1
root=$work/root
cleanup() {
    umount "$root/proc" "$root/dev" 2>/dev/null
    rm -rf --one-file-system -- "$work"
}
trap cleanup EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

(cd "$build" && cpack -G DEB -B "$work/package") >"$work/cpack.log" 2>&1 || fail "cpack: $(tail -n 5 "$work/cpack.log")"
package=$(ls "$work"/package/*.deb) || fail "cpack made no package"
dpkg-deb --field "$package" Package Version Architecture Depends

debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log" 2>&1 ||
    fail "debootstrap: $(tail -n 3 "$work/debootstrap.log")"
# What lets apt reach the mirror on this machine lets it do so in there.
cp /etc/resolv.conf "$root/etc/" 2>/dev/null
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/" 2>/dev/null
rm -f "$root"/etc/dpkg/dpkg.cfg.d/*
mount -t proc proc "$root/proc" && mount --bind /dev "$root/dev" || skip "cannot mount in a chroot"
cp "$package" "$root/tmp/asperity.deb"
in_root() { chroot "$root" env DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 \
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 bash -c "$1"; }

in_root 'apt-get update && apt-get install -y --no-install-recommends /tmp/asperity.deb man-db' >"$work/install.log" 2>&1 ||
    fail "installation: $(tail -n 5 "$work/install.log")"
in_root 'man asperity | grep -q "SCENE KEYS"' || fail "the man page"
in_root 'cd /root && asperity check /usr/share/asperity/scenes/first-contact.toml' || fail "check"
in_root 'cd /root && asperity run /usr/share/asperity/scenes/first-contact.toml --progress off' || fail "run"
in_root 'cd /root && mpirun -n 2 asperity run /usr/share/asperity/scenes/first-contact.toml --set drive.path=zero-load \
    --set surface.sites=64 --out two-ranks --progress off' >/dev/null || fail "run on two ranks"
in_root "cd /root && python3 -c 'import asperity; print(asperity.load(\"results/first-contact\").binding_energy)'" ||
    fail "the Python package"
in_root 'apt-get remove -y asperity && ! command -v asperity' >/dev/null 2>&1 || fail "removal"
echo "all fine"

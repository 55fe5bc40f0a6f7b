#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     debian_package.sh SOURCE BUILD
#
# Makes the Debian package and installs it on a bare Debian 12 in a chroot, with nothing else but man. There: the
# man page is read, first-contact run, two ranks, a report made, the Python example of docs/howto/results.md
# run, the package removed.
# Needs root, debootstrap and a mirror ($ASPERITY_MIRROR, else that of the first source in apt's list).
# ASPERITY_CHROOT: a bare tree that debootstrap --variant=minbase has made, to be copied instead of made.
# Exit code 77: not possible here.
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

if [ -n "${ASPERITY_CHROOT:-}" ]; then
    cp -a --one-file-system "$ASPERITY_CHROOT" "$root" || fail "$ASPERITY_CHROOT cannot be copied"
else
    debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log" 2>&1 ||
        fail "debootstrap: $(tail -n 3 "$work/debootstrap.log")"
fi
# What lets apt reach the mirror on this machine lets it do so in there.
cp /etc/resolv.conf "$root/etc/" 2>/dev/null
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/" 2>/dev/null
rm -f "$root"/etc/dpkg/dpkg.cfg.d/* "$root"/etc/apt/apt.conf.d/docker-clean
mount -t proc proc "$root/proc" && mount --bind /dev "$root/dev" || skip "cannot mount in a chroot"
cp "$package" "$root/tmp/asperity.deb"
sed -n '/^```python$/,/^```$/p' "$source/docs/howto/results.md" | sed '/^```$/q' | sed '/^```/d' >"$root/root/notebook.py"
in_root() { # in_root COMMANDS: in /root, with no more of this machine's environment than its proxies
    local proxies=()
    mapfile -t proxies < <(env | grep -iE '^(https?|ftp|no)_proxy=')
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
        MPLBACKEND=agg OMP_WAIT_POLICY=passive "${proxies[@]}" bash -c "cd /root && $1"
}
install_packages() { in_root "apt-get install -y --no-install-recommends $*" >>"$work/install.log" 2>&1; }

in_root 'apt-get update' >"$work/install.log" 2>&1 || fail "apt-get update: $(tail -n 5 "$work/install.log")"
install_packages /tmp/asperity.deb man-db || fail "installation: $(tail -n 5 "$work/install.log")"
echo "installed: $(in_root "dpkg-query -W -f '\${Installed-Size} kB' asperity"), with $(in_root 'dpkg -l | grep -c ^ii') packages in all"
in_root 'man asperity > page 2>&1; grep -q "SCENE KEYS" page && grep -q "surface.rms" page && grep -q "asperity run" page' ||
    fail "the man page: $(in_root 'head -n 5 page')"
in_root 'asperity check /usr/share/asperity/scenes/first-contact.toml' || fail "check"
in_root 'ln -s /usr/share/asperity/scenes scenes && asperity run scenes/first-contact.toml --progress off' || fail "run"
in_root 'mpirun -n 2 asperity run scenes/first-contact.toml --set drive.path=relax surface.sites=64 \
    --out two-ranks --progress off' >/dev/null || fail "run on two ranks"
in_root 'asperity report results/first-contact && [ -s results/first-contact/report.html ]' || fail "report"
in_root "python3 notebook.py && python3 -c 'import asperity; print(asperity.load(\"results/smoother\").binding_energy)'" ||
    fail "the Python example of docs/howto/results.md"

in_root 'apt-get remove -y asperity && ! command -v asperity && [ ! -e /usr/share/asperity ]' >/dev/null 2>&1 || fail "removal"
echo "all fine"

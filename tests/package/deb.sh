#!/usr/bin/env bash
# The Debian packages: built, installed below a folder of their own by dpkg, used as a user would, removed with nothing left.
# Usage: deb.sh BUILD_FOLDER SOURCE_FOLDER
set -euo pipefail
build=$1 source=$2
export PATH=/usr/bin:/usr/sbin:/bin:/sbin LC_ALL=C
unset GLCAST_LIBRARY LD_PRELOAD # what is installed must be found by itself
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "deb.sh: $*" >&2; exit 1; }

cpack --config "$build/CPackConfig.cmake" -B "$work/packed" >"$work/log" 2>&1 || { cat "$work/log"; fail "cpack failed"; }
runtime=$(echo "$work"/packed/glcast_*.deb) development=$(echo "$work"/packed/libglcast-dev_*.deb)

# What the package says of itself. dpkg-shlibdeps finds what is linked; OSMesa is loaded at run time.
depends=$(dpkg-deb -f "$runtime" Depends)
for library in libc6 libimath libembree libtbb libosmesa6; do
    [[ $depends == *$library* ]] || fail "$library is not in Depends: $depends"
done

# A root of its own that knows what this system has, so that Depends are really checked.
root=$work/root
mkdir -p "$root/var/lib/dpkg/updates" "$root/var/lib/dpkg/info"
cp /var/lib/dpkg/status "$root/var/lib/dpkg/status"
(cd "$root" && find . -path ./var -prune -o -print) | sort >"$work/before"
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(fakeroot)
"${as_root[@]}" dpkg --root="$root" --force-not-root --no-triggers -i "$runtime" "$development" >"$work/log" 2>&1 ||
    { grep -v 'list file for package' "$work/log"; fail "dpkg -i failed"; }
for name in bin/glcast bin/glcast-run share/man/man1/glcast-mesh.1.gz share/man/man1/glcast-run.1.gz \
    share/bash-completion/completions/glcast share/doc/glcast/copyright share/doc/glcast/changelog.gz; do
    [ -f "$root/usr/$name" ] || fail "no /usr/$name"
done

# Used.
cd "$work"
version=$("$root/usr/bin/glcast" --version)
[ "$version" = "glcast $(dpkg-deb -f "$runtime" Version | sed 's/-.*//')" ] || fail "glcast --version says $version"
timeout 60 "$root/usr/bin/glcast-run" -n 32 -o a.exr --headless --quit --timeout 50 -- \
    "$build/fixtures/fixture-glx" --shape teapot || fail "glcast-run failed"
timeout 60 "$root/usr/bin/glcast" mesh a.exr -o a.glb || fail "glcast mesh failed"
timeout 60 "$root/usr/bin/glcast" info a.glb --json >info.json || fail "glcast info failed"
grep -q '"closedManifold": true' info.json || fail "no closed mesh" # no pipe: grep -q would close it early
timeout 60 "$root/usr/bin/glcast" render a.glb -o a.png --size 32 || fail "glcast render failed"
sh "$source/tests/package/consumer.sh" "$root/usr" "$source" "$work/consumer" "$work/a.exr" || fail "the CMake package does not work"

# Removed.
"${as_root[@]}" dpkg --root="$root" --force-not-root --no-triggers --purge glcast libglcast-dev >"$work/log" 2>&1 ||
    { grep -v 'list file for package' "$work/log"; fail "dpkg --purge failed"; }
(cd "$root" && find . -path ./var -prune -o -print) | sort >"$work/after"
diff "$work/before" "$work/after" || fail "something is left"
[ -z "$(find "$root/var/lib/dpkg/info" -name '*glcast*')" ] || fail "something is left in dpkg's own folder"
echo "$(basename "$runtime"): $(stat -c %s "$runtime") bytes; Depends: $depends"

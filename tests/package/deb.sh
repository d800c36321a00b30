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
here=$(dpkg --print-architecture)
library=$(echo "$work"/packed/libglcast0_*_"$here".deb) library32=$work/packed/none

# What the package says of itself. dpkg-shlibdeps finds what is linked; OSMesa is loaded at run time.
depends=$(dpkg-deb -f "$runtime" Depends)
for need in libc6 libimath libembree libtbb libosmesa6 libglcast0; do
    [[ $depends == *$need* ]] || fail "$need is not in Depends: $depends"
done

for package in "$work"/packed/libglcast0_*.deb; do
    [ "$(dpkg-deb -f "$package" Multi-Arch)" = same ] || fail "$package is not Multi-Arch: same"
    [ "$(dpkg-deb -f "$package" Depends)" = "libc6 (>= 2.17)" ] || fail "Depends of $package"
done
# The 32-bit library, built beside the other where that can be.
if [ -f "$build/i386/shim/preload/libglcast.so" ]; then
    library32=$(echo "$work"/packed/libglcast0_*_i386.deb)
    [ -f "$library32" ] || fail "no package of the 32-bit library"
fi

# A root of its own that knows what this system has, so that Depends are really checked.
root=$work/root
mkdir -p "$root/var/lib/dpkg/updates" "$root/var/lib/dpkg/info"
cp /var/lib/dpkg/status "$root/var/lib/dpkg/status"
(cd "$root" && find . -path ./var -prune -o -print) | sort >"$work/before"
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(fakeroot)
"${as_root[@]}" dpkg --root="$root" --force-not-root --no-triggers -i "$library" "$runtime" "$development" >"$work/log" 2>&1 ||
    { grep -v 'list file for package' "$work/log"; fail "dpkg -i failed"; }
if [ -f "$library32" ]; then
    dpkg --root="$root" --add-architecture i386
    # This machine may have no libc6 of i386, and knows its own architectures alone.
    "${as_root[@]}" dpkg --root="$root" --force-not-root --force-depends --no-triggers -i "$library32" >"$work/log" 2>&1 ||
        { grep -v 'list file for package' "$work/log"; fail "dpkg -i of the 32-bit library failed"; }
    file -L "$root/usr/lib/i386-linux-gnu/glcast/libglcast.so" "$root/usr/lib32/glcast/libglcast.so" >"$work/kinds"
    [ "$(grep -c 'ELF 32-bit.*, stripped' "$work/kinds")" -eq 2 ] || { cat "$work/kinds"; fail "no stripped 32-bit library"; }
fi
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
if [ -f "$library32" ]; then
    # A program of 32 bits that asks what has been loaded into it: by the loader of i386, or by that of libc6-i386.
    printf '#include <stdio.h>\nint main(void) { char line[4096]; FILE* f = fopen("/proc/self/maps", "r");\n%s' \
        'while (fgets(line, sizeof line, f)) fputs(line, stdout); return 0; }' >maps.c
    gcc -m32 -o maps maps.c
    "$root/usr/bin/glcast-run" -o b.exr -- ./maps >maps.txt 2>maps.err || true # no GL seen
    grep -q "$root/usr/lib/i386-linux-gnu/glcast/libglcast.so" maps.txt || { cat maps.err; fail "the 32-bit library is not preloaded"; }
fi
sh "$source/tests/package/consumer.sh" "$root/usr" "$source" "$work/consumer" "$work/a.exr" || fail "the CMake package does not work"

# Removed.
"${as_root[@]}" dpkg --root="$root" --force-not-root --no-triggers --purge glcast libglcast-dev libglcast0:"$here" \
    $([ -f "$library32" ] && echo libglcast0:i386) >"$work/log" 2>&1 ||
    { grep -v 'list file for package' "$work/log"; fail "dpkg --purge failed"; }
(cd "$root" && find . -path ./var -prune -o -print) | sort >"$work/after"
diff "$work/before" "$work/after" || fail "something is left"
[ -z "$(find "$root/var/lib/dpkg/info" -name '*glcast*')" ] || fail "something is left in dpkg's own folder"
echo "$(basename "$runtime"): $(stat -c %s "$runtime") bytes; Depends: $depends"

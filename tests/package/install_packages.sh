#!/usr/bin/env bash
# tools/install-packages against an apt-get that does as the test says: what a mirror does while it is being synchronised.
# Usage: install_packages.sh SOURCE_FOLDER
set -euo pipefail
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin" "$folder/tools"
cp "$source/tools/install-packages" "$folder/tools/"
printf 'build gone-fishing\nbuild gone-sailing\nbuild here-already\ntest other\n' > "$folder/tools/packages"

# Each call takes a line of the plan: how update and install end. What was asked goes to asked.
cat > "$folder/bin/apt-get" <<'A'
#!/usr/bin/env bash
echo "$*" >> "$FOLDER/asked"
case " $* " in
    *" -s "*) case " $* " in *" gone-fishing "*) exit 100 ;; *) exit 0 ;; esac ;;
    *" update "*) plan=$FOLDER/update ;;
    *" install "*) plan=$FOLDER/install ;;
esac
result=$(head -n 1 "$plan"); sed -i 1d "$plan"
[ "${result:-0}" -eq 0 ] || echo "E: Failed to fetch http://mirror/Packages.xz  File has unexpected size (1 != 2). Mirror sync in progress?" >&2
exit "${result:-0}"
A
cat > "$folder/bin/dpkg-query" <<'D'
#!/usr/bin/env bash
case "$*" in *here-already*) echo -n installed ;; *) exit 1 ;; esac
D
printf '#!/bin/sh\nexec "$@"\n' > "$folder/bin/sudo"
chmod +x "$folder"/bin/*

fail() { echo "$1" >&2; cat "$folder/said" "$folder/asked" >&2; exit 1; }
# plan NAME "UPDATES" "INSTALLS" STATUS: runs it, and expects that exit status.
plan() {
    printf '%s\n' $2 > "$folder/update"; printf '%s\n' $3 > "$folder/install"; : > "$folder/asked"
    local status=0
    FOLDER=$folder GLCAST_APT_WAIT=0 PATH=$folder/bin:/usr/bin:/bin "$folder/tools/install-packages" build 2> "$folder/said" || status=$?
    [ "$status" -eq "$4" ] || fail "$1: ended with $status instead of $4"
}
asked() { grep -c -- "$1" "$folder/asked" || true; }
said() { grep -q -- "$1" "$folder/said" || fail "never said: $1"; }

plan "all is well" "0" "0" 0
[ "$(asked update)" -eq 1 ] && [ "$(asked install)" -eq 1 ] || fail "asked more than once"
grep -q "gone-fishing gone-sailing" "$folder/asked" || fail "not what was missing"
! grep -q "here-already\|other" "$folder/asked" || fail "what is there, or of another group"

plan "one index fails once" "100 0" "0" 0
[ "$(asked update)" -eq 2 ] || fail "update was not tried again"

plan "one index fails always" "100 100 100" "0" 0
said "going on with those that are there"

plan "a package comes late" "100 100 100 0" "100 0" 0
[ "$(asked " install ")" -eq 2 ] || fail "install was not tried again"

plan "a package never comes" "0 0 0" "100 100 100" 1
[ "$(tail -n 1 "$folder/said")" = "install-packages: cannot be had: gone-fishing" ] || fail "does not name what is lost"
echo "all is well"

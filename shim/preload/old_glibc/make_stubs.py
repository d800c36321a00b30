"""Makes libraries to link with that have no more than glibc VERSION had, so that what is linked loads there.

  make_stubs.py FOLDER VERSION STAMP COMPILER [FLAG...]

Old programs live in old systems, and the library is preloaded there. Each symbol of the C library of this machine is
given the newest version it has up to VERSION; one that came later is missing, and shows at link time. FOLDER gets
libc.so (a linker script), libc.so.6, libm.so, libpthread.so and libdl.so with the names that an old glibc has for them:
what is in libc.so.6 from glibc 2.34 on is looked for in libpthread.so.0 and libdl.so.2, which a newer glibc keeps as
empty files with these versions. STAMP is made when all is there.
"""
import os
import re
import subprocess
import sys

MOVED = {
    "libpthread.so.0": re.compile(r"(__)?(pthread|sem)_\w+$"),
    "libdl.so.2": re.compile(r"dl(open|close|sym|vsym|error|addr|addr1|info|mopen)$"),
}
LINK_NAMES = {"libm.so.6": "libm.so", "libpthread.so.0": "libpthread.so", "libdl.so.2": "libdl.so"}
# SIZE FLAGS SECTION SIZE VERSION NAME, as objdump prints them; a version in brackets is not the default one.
LINE = re.compile(r"^[0-9a-f]+ (?P<flags>.{7}) (?P<section>\S+)\t[0-9a-f]+ +\(?(?P<version>GLIBC_[0-9.]+)\)? +(?P<name>\S+)$")


def number(version):
    return tuple(int(part) for part in version.removeprefix("GLIBC_").split("."))


def symbols(path, limit):
    """Name -> (version, is a function) of what `path` defines, the newest up to `limit`."""
    listed = subprocess.run(["objdump", "-T", path], check=True, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    found = {}
    for line in listed.stdout.splitlines():
        match = LINE.match(line)
        if not match or match["section"] == "*UND*" or match["section"] == "*ABS*" or number(match["version"]) > limit:
            continue
        name = match["name"]
        if name not in found or number(match["version"]) > number(found[name][0]):
            found[name] = (match["version"], "F" in match["flags"] or "i" in match["flags"])
    return found


def make_library(folder, soname, wanted, compiler):
    """A library that only says which symbols it has."""
    base = os.path.join(folder, soname)
    with open(base + ".s", "w") as source:
        source.write(".text\n")
        for name, (_, function) in sorted(wanted.items()):
            kind = "function" if function else "object"
            section = ".text" if function else ".data"
            source.write("%s\n.globl %s\n.type %s, @%s\n%s: .quad 0\n.size %s, 8\n" % (section, name, name, kind, name, name))
        source.write('.section .note.GNU-stack,"",@progbits\n')
    nodes = {}
    for name, (version, _) in wanted.items():
        nodes.setdefault(version, []).append(name)
    with open(base + ".map", "w") as script:
        for version in sorted(nodes, key=number):
            script.write("%s { global: %s };\n" % (version, " ".join(name + ";" for name in sorted(nodes[version]))))
        if not nodes:
            script.write("GLIBC_NONE { local: *; };\n")
    path = os.path.join(folder, LINK_NAMES.get(soname, soname))
    subprocess.run(compiler + ["-shared", "-nostdlib", "-Wl,-soname," + soname, "-Wl,--version-script," + base + ".map",
                               "-o", path, base + ".s"], check=True)
    return path


def where(compiler, name):
    """The file of this machine that the compiler would take, or nothing."""
    path = subprocess.run(compiler + ["-print-file-name=" + name], check=True, capture_output=True, text=True).stdout.strip()
    return path if os.path.isabs(path) and os.path.exists(path) else None


def main():
    folder, version, stamp, *compiler = sys.argv[1:]
    limit = number(version)
    os.makedirs(folder, exist_ok=True)
    libc = {}
    for name in ("libc.so.6", "libpthread.so.0", "libdl.so.2"):
        path = where(compiler, name)
        if path:
            for symbol, what in symbols(path, limit).items():
                if symbol not in libc or number(what[0]) > number(libc[symbol][0]):
                    libc[symbol] = what
    if not libc:
        sys.exit("make_stubs.py: no libc.so.6 found by %s" % " ".join(compiler))
    for soname, pattern in MOVED.items():
        moved = {name: what for name, what in libc.items() if pattern.match(name)}
        make_library(folder, soname, moved, compiler)
        libc = {name: what for name, what in libc.items() if name not in moved}
    script = [make_library(folder, "libc.so.6", libc, compiler), where(compiler, "libc_nonshared.a")]
    math = where(compiler, "libm.so.6")
    make_library(folder, "libm.so.6", symbols(math, limit), compiler)
    needed = []
    for loader in ("ld-linux-x86-64.so.2", "ld-linux.so.2", "ld-linux-aarch64.so.1"):
        path = where(compiler, loader)
        if path:
            needed.append(make_library(folder, loader, symbols(path, limit), compiler))
            break
    with open(os.path.join(folder, "libc.so"), "w") as text:
        text.write("GROUP(%s %s)\n" % (" ".join(part for part in script if part),
                                       "AS_NEEDED(%s)" % " ".join(needed) if needed else ""))
    open(stamp, "w").close()


main()

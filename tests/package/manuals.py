#!/usr/bin/env python3
"""Manual pages and completion know every option of --help, and none that is not there.

manuals.py FOLDER_OF_MANUALS COMMAND...
"""
import os
import re
import subprocess
import sys

folder, *programs = sys.argv[1:]
troubles = []


def output(command):
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=60,
                          env={**os.environ, "LC_ALL": "C"})


def listed(text):
    """Options at the start of the lines of a list, with what they may be."""
    names, choices = set(), {}
    for line in text.splitlines():
        found = re.match(r" {2}(-\S+)", line)
        if found:
            names |= set(found[1].split(","))
            values = re.search(r":\{([^}]*)\}", line)
            if values:
                choices[found[1].split(",")[-1]] = set(values[1].split(","))
    return names, choices


def manual_options(name):
    page = os.path.join(folder, name + ".1")
    checked = output(["groff", "-man", "-ww", "-z", page])
    if checked.stderr:
        troubles.append(f"{name}.1: {checked.stderr}")
    text = output(["groff", "-man", "-Tascii", "-P-cbou", page]).stdout
    options = text[text.index("\nOPTIONS\n"):text.index("\nEXIT STATUS\n")]
    names = set()
    for line in re.findall(r"^ {7}(-.*)", options, re.M):
        names |= {word for word in re.split(r",? ", line) if word.startswith("-")}
    return names, text


def complete(program, words):
    """What Tab gives after `words`, the last of which is being typed."""
    script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); f=$(complete -p "$1"); f=${f#*-F }; ${f%% *};'
              ' printf "%s\\n" "${COMPREPLY[@]}"')
    got = output(["bash", "-c", script, "bash", os.path.join(folder, program + ".bash"), program, *words])
    if got.stderr:
        troubles.append(f"{program}.bash: {got.stderr}")
    return set(got.stdout.split())


def same(what, is_, wanted):
    if is_ != wanted:
        troubles.append(f"{what}: too many {sorted(is_ - wanted)}, missing {sorted(wanted - is_)}")


def check(program, words):
    name = os.path.basename(program)
    options, choices = listed(output([program, *words, "--help"]).stdout)
    if len(options) < 3:
        troubles.append(f"{name} {words}: --help lists {options}")
    in_manual, text = manual_options("-".join([name, *words]))
    same(f"{name} {words}: manual", in_manual, options)
    after = complete(name, [*words, "-"])
    same(f"{name} {words}: completion", after - {"--"}, options)
    for option, values in choices.items():
        same(f"{name} {words}: completion of {option}", complete(name, [*words, option, ""]), values)
        for value in values:
            if value not in text:
                troubles.append(f"{name} {words}: {option} {value} is not in the manual")
    return len(options)


count = 0
for program in programs:
    count += check(program, [])
    helped = output([program, "--help"]).stdout
    if "\nSubcommands:\n" not in helped:
        continue
    subcommands = re.findall(r"^ {2}([a-z]+) ", helped.split("\nSubcommands:\n")[1], re.M)
    name = os.path.basename(program)
    same(f"{name}: completion", complete(name, [""]) - listed(helped)[0], set(subcommands))
    for subcommand in subcommands:
        count += check(program, [subcommand])
print(*troubles, sep="\n")
print(f"{count} names of options compared")
sys.exit(1 if troubles or count < 50 else 0)

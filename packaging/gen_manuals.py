#!/usr/bin/env python3
"""Manual pages and bash completion out of what the commands say of themselves by --help.

gen_manuals.py FOLDER VERSION COMMAND...   writes COMMAND.1, COMMAND-SUBCOMMAND.1 and COMMAND.bash

What a line of --help is must be understood, or the build fails: so no option can be missing here.
"""
import os
import re
import subprocess
import sys
from dataclasses import dataclass, field

DESCRIPTION_COLUMN = 30  # CLI11's

EXIT_STATUS = {
    "glcast": [("0", "done"), ("1", "not done; one line on standard error says why, and nothing was written"), ("2", "wrong usage"),
               ("130", "ended by Ctrl-C (143: SIGTERM, 129: SIGHUP); nothing is left half written")],
    "glcast-run": [("0", "cast, and the mesh made when -o names one"), ("1", "not cast; one line on standard error says why"),
                   ("2", "wrong usage")],
}
EXAMPLES = {
    "glcast-run": [
        ("From a program to a mesh in one command:", "glcast-run -o gears.glb --headless --quit -- glxgears"),
        ("Cast a program that draws to your screen, then go on with it:", "glcast-run -o gears.exr -- glxgears"),
        ("The same without a screen, ended when the cast is there:",
         "glcast-run -o gears.exr -n 256 --headless --quit -- glxgears"),
        ("What is in a frame to be cast:", "glcast-run --list --headless -- glxgears"),
    ],
    "glcast": [
        ("From a program to a picture of its cast:",
         "glcast-run -o gears.exr --headless --quit -- glxgears\nglcast mesh gears.exr -o gears.glb\n"
         "glcast render gears.glb -o gears.png"),
    ],
    "glcast mesh": [
        ("Levels for an object 256, 128, 64 and 32 pixels wide (n = 512):", "glcast mesh gears.exr -o gears.glb"),
        ("The full surface:", "glcast mesh gears.exr -o gears.glb --full"),
        ("Levels of at most so many triangles:", "glcast mesh gears.exr -o gears.glb --triangles 10000,500"),
    ],
    "glcast refine": [
        ("A level out of a progressive mesh:", "glcast mesh gears.exr -o gears.glb --pm gears.glpm\n"
         "glcast refine gears.glpm -o coarse.glb --triangles 2000"),
    ],
    "glcast info": [("What is in a capture, for a script:", "glcast info gears.exr --json")],
    "glcast compare": [("How far a cast is from the original:", "glcast compare original.obj cast.glb")],
    "glcast render": [("Six sides and two corners of every level:", "glcast render gears.glb -o gears.png")],
    "glcast view": [("A page with the levels beside the captured views:",
                     "glcast view gears.glb --capture gears.exr -o gears.html")],
}


@dataclass
class Option:
    names: list  # ["-o", "--output"]
    value: str  # "TEXT", or empty
    choices: list  # what the value may be, when it is one of a few
    limits: str
    default: str
    variable: str
    required: bool
    text: str


@dataclass
class Page:
    command: str  # "glcast mesh"
    summary: str
    usage: str
    positionals: list = field(default_factory=list)
    options: list = field(default_factory=list)
    subcommands: list = field(default_factory=list)  # (name, text)
    notes: list = field(default_factory=list)

    @property
    def name(self):
        return self.command.replace(" ", "-")


LEFT = re.compile(
    r"(?P<names>\S+)"
    r"(?: (?P<value>[A-Z]+)(?::(?:\{(?P<choices>[^}]*)\}|(?P<limits>[A-Z]+ in \[[^]]*\]|[A-Z]+)))?(?:=(?P<default>\S+))?)?"
    r"(?P<many> \.\.\.)?(?: \(Env:(?P<env>\w+)\))?(?P<required> REQUIRED)?(?: Needs: [^:]*)?(?: Excludes: (?P<excludes>.*))?")


def option(left, right):
    found = LEFT.fullmatch(left)
    if not found or not right:
        raise SystemExit(f"gen_manuals: --help has a line that is not understood: {left!r} {right!r}")
    choices = list(dict.fromkeys(found["choices"].split(","))) if found["choices"] else []
    limits = re.sub(r"^[A-Z]+ in ", "", found["limits"] or "") if "in" in (found["limits"] or "") else ""
    return Option(found["names"].split(","), found["value"] or "", choices, limits, found["default"] or "",
                  found["env"] or "", bool(found["required"]), right)


def split_entries(lines):
    """What stands left and right in a list of --help; the right is on the line below where the left is long."""
    result = []
    for k, line in enumerate(lines):
        if line.startswith(" " * DESCRIPTION_COLUMN):
            continue
        below = lines[k + 1].strip() if k + 1 < len(lines) and lines[k + 1].startswith(" " * DESCRIPTION_COLUMN) else ""
        if below:
            result.append((line.strip(), below))
        else:
            result.append((line[:DESCRIPTION_COLUMN].strip(), line[DESCRIPTION_COLUMN:].strip()))
    return result


def read_page(program, command):
    words = command.split()[1:]
    text = subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout
    lines = [line.rstrip() for line in text.splitlines()]
    page = Page(command, lines[0], lines[1].removeprefix("Usage: "))
    section, lists = "", {"Positionals:": [], "Options:": [], "Subcommands:": []}
    for line in lines[2:]:
        if line in lists:
            section = line
        elif re.fullmatch(r"[A-Z][a-z ]*:", line):  # a group of options
            section = "Options:"
        elif not line:
            section = ""
        elif section:
            lists[section].append(line)
        else:
            page.notes.append(line)
    page.positionals = [option(*pair) for pair in split_entries(lists["Positionals:"])]
    page.options = [option(*pair) for pair in split_entries(lists["Options:"])]
    page.subcommands = split_entries(lists["Subcommands:"])
    return page


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga")
    return "\\&" + text if text.startswith(".") else text


def sentence(text):
    """With a capital, but for what starts with a value: "contour: ..."."""
    return text if re.match(r"\S+:", text) else text[0].upper() + text[1:]


def option_lines(option):
    head = ", ".join("\\fB" + roff(name) + "\\fR" for name in option.names)
    if option.choices:
        head += " " + "|".join("\\fB" + roff(choice) + "\\fR" for choice in option.choices)
    elif option.value:
        head += " \\fI" + roff(option.value) + "\\fR"
    text = sentence(option.text)
    facts = ["required"] * option.required + [f"range {option.limits}"] * bool(option.limits) + [f"default {option.default}"] * bool(option.default)
    if facts:
        text += " (" + ", ".join(facts) + ")"
    text += "."
    lines = [".TP", head, roff(text)]
    if option.variable:
        lines.append(f"Also by the variable \\fB{roff(option.variable)}\\fR.")
    return lines


def manual(page, version, pages):
    program = page.command.split()[0]
    out = [f'.TH "{roff(page.name.upper())}" "1" "" "glcast {version}" "glcast"', ".nh", ".ad l",
           ".SH NAME", roff(f"{page.name} - {page.summary[0].lower() + page.summary[1:].rstrip('.')}"),
           ".SH SYNOPSIS", "\\fB" + roff(page.command) + "\\fR" + roff(page.usage.removeprefix(page.command)),
           ".SH DESCRIPTION", roff(page.summary[0].upper() + page.summary[1:].rstrip(".") + ".")]
    if page.notes:
        out += [".PP"] + [roff(line) for line in page.notes]
    if page.positionals:
        out += [".SH ARGUMENTS"]
        for positional in page.positionals:
            out += [".TP", "\\fI" + roff(positional.names[0]) + "\\fR",
                    roff(sentence(positional.text) + ".")]
    if page.subcommands:
        out += [".SH COMMANDS"]
        for name, text in page.subcommands:
            out += [".TP", f"\\fB{roff(name)}\\fR", roff(text[0].upper() + text[1:] + f"; see {page.name}-{name}(1).")]
    out += [".SH OPTIONS"] + [line for each in page.options for line in option_lines(each)]
    out += [".SH EXIT STATUS"]
    for code, meaning in EXIT_STATUS[program]:
        out += [".TP", code, roff(meaning[0].upper() + meaning[1:] + ".")]
    if EXAMPLES.get(page.command):
        out += [".SH EXAMPLES"]
        for text, commands in EXAMPLES[page.command]:
            out += [".PP", roff(text), ".PP", ".RS 4", ".nf", *map(roff, commands.splitlines()), ".fi", ".RE"]
    out += [".SH SEE ALSO", ", ".join(f"\\fB{roff(p.name)}\\fR(1)" for p in pages if p is not page)]
    return "\n".join(out) + "\n"


def completion(program, pages):
    """One function for each program: words of the subcommand, values of an option that has but a few."""
    name = program.replace("-", "_")
    top = pages[0]
    out = [f"# bash completion for {program}, made by gen_manuals.py out of its --help", f"_{name}() {{",
           '    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command="" k', "    COMPREPLY=()"]
    if top.subcommands:
        names = "|".join(n for n, _ in top.subcommands)
        out += ["    for ((k = 1; k < COMP_CWORD; ++k)); do",
                f"        case ${{COMP_WORDS[k]}} in {names}) command=${{COMP_WORDS[k]}}; break ;; esac", "    done"]
    else:  # what comes after -- is somebody else's command
        out += ["    for ((k = 1; k < COMP_CWORD; ++k)); do", "        if [[ ${COMP_WORDS[k]} == -- ]]; then",
                "            if ((k + 1 == COMP_CWORD)); then mapfile -t COMPREPLY < <(compgen -c -- \"$word\")",
                "            else mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); fi", "            return", "        fi",
                "    done"]
    out += ["    case $command,$before in"]
    for page in pages:
        sub = page.command.partition(" ")[2]
        for each in page.options:
            keys = "|".join(f"{sub},{n}" for n in each.names)
            if each.choices:
                out.append(f'        {keys}) mapfile -t COMPREPLY < <(compgen -W "{" ".join(each.choices)}" -- "$word"); return ;;')
            elif each.value == "TEXT":
                out.append(f'        {keys}) mapfile -t COMPREPLY < <(compgen -f -- "$word"); return ;;')
            elif each.value:
                out.append(f"        {keys}) return ;;")
    out += ["    esac", "    case $command in"]
    for page in pages:
        sub = page.command.partition(" ")[2]
        words = [n for each in page.options for n in each.names] + [n for n, _ in page.subcommands]
        words += ["--"] * (not page.subcommands and not sub)
        out += [f"        {sub or chr(39) * 2})", f'            mapfile -t COMPREPLY < <(compgen -W "{" ".join(words)}" -- "$word")']
        if page.positionals:
            out += ['            [[ $word == -* ]] || mapfile -t COMPREPLY < <(compgen -f -- "$word")']
        out += ["            ;;"]
    out += ["    esac", "}", f"complete -o filenames -F _{name} {program}"]
    return "\n".join(out) + "\n"


def main():
    folder, version, *programs = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    groups = []
    for program in programs:
        name = os.path.basename(program)
        top = read_page(program, name)
        groups.append([top] + [read_page(program, f"{name} {sub}") for sub, _ in top.subcommands])
    everything = [page for group in groups for page in group]
    for group in groups:
        with open(os.path.join(folder, group[0].name + ".bash"), "w") as file:
            file.write(completion(group[0].name, group))
    for page in everything:
        with open(os.path.join(folder, page.name + ".1"), "w") as file:
            file.write(manual(page, version, everything))


main()

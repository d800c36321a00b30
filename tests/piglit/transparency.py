#!/usr/bin/env python3
"""Run programs of Debian's piglit plain and with libglcast.so casting every frame: each must end the same way.

Usage: transparency.py SHIM RULES [--neutral PRELOAD] [--only REGEX] [--jobs N]
RULES holds regular expressions over the names of piglit's own profile `quick_gl`, one a line; "!" takes names away, for the
reason beside it. Of several tests of one program the first is run, of "+" lines all. How they are run is piglit's own rule:
into a framebuffer object (-fbo) where the profile says that they may run side by side, in a window where it does not.

The same: exit status, and every line of results that the program prints, subtests included. One that differs is run plain
again and again: it is only let off when it gives without us, too, what it gave with us, or when it never gives a result
without us (glx-visuals-depth: an X error of Mesa's own ends it), or when a preload of two lines changes it just so
(polygon-mode-facing: Mesa falls over in its atexit handlers). A program that needs more than SLOW_CPU seconds without us
is left out. All these are named. Exit status: 0 all the same, 1 some differ, 2 nothing to run.
"""
import argparse
import ast
import concurrent.futures
import gzip
import os
import queue
import re
import resource
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

FOLDERS = [*Path("/usr/lib").glob("*/piglit"), Path("/usr/lib/piglit")]
SLOW_CPU, SHIM_CPU, WALL = 3, 10, 300  # seconds
SPARSE = 1000  # every how many frames, for those that end ten thousand of them
RETRIES = 6
REFUSALS = 5  # of the X server, which say nothing of the program
REFUSED = re.compile(r"XOpenDisplay|(open|connect to) (X )?(display|server)", re.IGNORECASE)
LEAST_PROGRAMS, LEAST_CASTING = 150, 100

ARMED = {"GLCAST_READ_ENDS": "1", "GLCAST_N": "8", "GLCAST_GROUP": "1"}


class Rules:
    def __init__(self, path):
        self.take, self.all, self.leave = [], [], []
        for line in Path(path).read_text().splitlines():
            line = line.split("  #")[0].strip()
            if line and not line.startswith("#"):
                where = {"!": self.leave, "+": self.all}.get(line[0], self.take)
                where.append(re.compile(line.lstrip("!+").strip()))

    def wants(self, name, program, seen):
        if any(r.fullmatch(name) for r in self.leave):
            return False
        if any(r.fullmatch(name) for r in self.all):
            return True
        return program not in seen and any(r.fullmatch(name) for r in self.take)


def read_profile(folder, rules):
    """[(name, command)], in the profile's order."""
    with gzip.open(folder / "tests" / "quick_gl.xml.gz") as file:
        root = ElementTree.parse(file).getroot()
    chosen, seen = [], set()
    for test in root.iter("Test"):
        options = {o.get("name"): o.get("value") for o in test.iter("option")}
        if test.get("type") != "gl" or "command" not in options:
            continue
        command = ast.literal_eval(options["command"])
        if rules.wants(test.get("name"), command[0], seen) and (folder / "bin" / command[0]).exists():
            seen.add(command[0])
            concurrent_too = options.get("run_concurrent") == "True"
            chosen.append((test.get("name"), command + ["-auto"] + (["-fbo"] if concurrent_too else [])))
    return chosen


class Server:
    """An X server of its own for each worker: programs look at focus, overlap and front buffers.

    Without -noreset it starts anew whenever its last client leaves, and refuses the next program that comes meanwhile: on a
    busy machine that takes long enough to be met.
    """

    def __init__(self):
        reader, writer = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset"],
            pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as answer:
            self.display = ":" + answer.readline().strip()
        if self.display == ":":
            sys.exit("transparency.py: no X server came up (Xvfb)")

    def stop(self):
        self.process.terminate()
        self.process.wait()


class Run:
    def __init__(self, folder, command, display, cpu, shim=None, every=1, neutral=None):
        environment = {k: v for k, v in os.environ.items() if not k.startswith("GLCAST_") and k != "LD_PRELOAD"}
        environment |= {"DISPLAY": display, "PIGLIT_PLATFORM": "glx", "LIBGL_ALWAYS_SOFTWARE": "1", "LP_NUM_THREADS": "1"}
        if neutral:
            environment["LD_PRELOAD"] = neutral
        with tempfile.TemporaryDirectory() as scratch:
            if shim:
                environment |= ARMED | {"GLCAST_EVERY": str(every), "LD_PRELOAD": shim, "GLCAST_OUT": scratch + "/cast.exr"}
            for _ in range(1 + REFUSALS):
                self.start(folder, command, environment, cpu)
                if not REFUSED.search(self.err + self.out):
                    break
        self.casts = self.err.count("glcast: captured frame")

    def start(self, folder, command, environment, cpu):
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 1))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process = subprocess.Popen([folder / "bin" / command[0], *command[1:]], cwd=folder, env=environment, preexec_fn=limit,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                   start_new_session=True)
        try:
            out, err = process.communicate(timeout=WALL)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            out, err = process.communicate()
        self.status = process.returncode
        self.slow = self.status in (-9, -24)  # SIGXCPU, or killed by the clock
        self.err = err.decode(errors="replace")
        self.out = out.decode(errors="replace")
        lines = [line for line in (self.out + "\n" + self.err).splitlines() if line.startswith("PIGLIT:")]
        self.result = (self.status, *lines)


def judge(folder, command, display, shim, neutral):
    """(verdict, plain, ours). Verdicts: same, flaky, slow, "no result", "any preload", DIFFERENT."""
    plain = Run(folder, command, display, SLOW_CPU)
    if plain.slow:
        return "slow", plain, None
    ours = Run(folder, command, display, SHIM_CPU, shim)
    if ours.slow:
        ours = Run(folder, command, display, 6 * SHIM_CPU, shim, every=SPARSE)
    if plain.result == ours.result:
        return "same", plain, ours
    again = [Run(folder, command, display, SHIM_CPU).result for _ in range(RETRIES)]
    if ours.result in again:
        return "flaky", plain, ours
    if all(len(result) == 1 for result in [plain.result, *again]):
        return "no result", plain, ours  # it never comes to one without us
    if neutral and ours.result in [Run(folder, command, display, SHIM_CPU, neutral=neutral).result for _ in range(RETRIES)]:
        return "any preload", plain, ours
    return "DIFFERENT", plain, ours


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("shim")
    parser.add_argument("rules")
    parser.add_argument("--only", default="")
    parser.add_argument("--neutral", help="a preload that only passes two calls through")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    folder = next((f for f in FOLDERS if (f / "bin").is_dir()), None)
    if not folder:
        print("transparency.py: piglit is not installed (tools/install-packages real)", file=sys.stderr)
        return 2
    tests = [t for t in read_profile(folder, Rules(options.rules)) if re.search(options.only, t[0])]
    neutral = os.path.abspath(options.neutral) if options.neutral else None
    servers = queue.SimpleQueue()
    running = [Server() for _ in range(options.jobs)]
    for server in running:
        servers.put(server)

    def work(test):
        server = servers.get()
        try:
            return test, judge(folder, test[1], server.display, os.path.abspath(options.shim), neutral)
        finally:
            servers.put(server)

    counts, casts, casting = {}, 0, 0
    try:
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for (name, command), (verdict, plain, ours) in pool.map(work, tests):
                counts[verdict] = counts.get(verdict, 0) + 1
                casts += ours.casts if ours else 0
                casting += bool(ours and ours.casts)
                if verdict != "same" or options.verbose:
                    print(f"{verdict}: {name}: {' '.join(command)}" + (f" ({ours.casts} casts)" if ours else ""), flush=True)
                if verdict == "DIFFERENT":
                    print(f"  plain: {plain.result}\n  ours:  {ours.result}\n  {ours.err[-600:]}", flush=True)
    finally:
        for server in running:
            server.stop()
    print(f"{len(tests)} programs: {counts}; {casting} of them cast, {casts} casts in all")
    if not options.only and (len(tests) - counts.get("slow", 0) < LEAST_PROGRAMS or casting < LEAST_CASTING):
        print(f"too few: at least {LEAST_PROGRAMS} programs and {LEAST_CASTING} that are cast")
        return 1
    return 1 if counts.get("DIFFERENT") else 0


if __name__ == "__main__":
    sys.exit(main())

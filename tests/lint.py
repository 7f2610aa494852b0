#!/usr/bin/env python3
"""clang-tidy over sources, several in one unit: most of its time goes into the headers they share.

    lint.py BUILD OUT SOURCE...

BUILD holds compile_commands.json; units are written below OUT, as deep as their sources lie below the working
directory, so that the same .clang-tidy files hold. A unit is its sources one after the other, not included, for the
analyzer reads no more than the main file. Where a unit fails, its sources are read one by one, and what that says
counts: names may collide in a unit, and places are those of the unit.
"""
import concurrent.futures
import itertools
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

SOURCES_IN_UNIT = 10
# The analyzer follows a function through at most so many states, in place of 225,000: templates of JSON and of the
# command line took half of all the time, and what our functions need is far below.
MAX_NODES = 30000
# What is GCC's alone, and -Wshadow, which would see the names of a unit's other sources: GCC asks for it, too.
GCC_ONLY = re.compile(r"-Winvalid-pch|-include \S+|-Wno-error=\S+|-Wshadow")
CLANG_TIDY = ["clang-tidy", "--quiet"] + [
    f"--extra-arg={part}" for part in ("-Xclang", "-analyzer-config", "-Xclang", f"max-nodes={MAX_NODES}")]


def flags_of(command):
    return shlex.split(GCC_ONLY.sub("", command))[1:-4]  # without the compiler, -o, -c and what they name


def tidy(path, flags):
    """Exit status and what it says of `path`."""
    run = subprocess.run([*CLANG_TIDY, str(path), "--", *flags], capture_output=True, text=True)
    return run.returncode, run.stdout or run.stderr


def lint(unit, sources, flags):
    """What is wrong with the sources; empty where nothing is."""
    unit.parent.mkdir(parents=True, exist_ok=True)
    unit.write_text("".join(source.read_text() + "\n" for source in sources))
    if len(sources) > 1 and tidy(unit, [*flags, "-iquote", str(sources[0].parent)])[0] == 0:
        return ""
    results = [tidy(source, flags) for source in sources]
    if len(sources) > 1 and all(status == 0 for status, _ in results):
        print(f"{unit}: fails though its sources do not; do their names collide?")
    return "".join(said or f"{source}: clang-tidy failed\n"
                   for source, (status, said) in zip(sources, results) if status != 0)


def main():
    build, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    root = pathlib.Path.cwd()
    shutil.rmtree(out, ignore_errors=True)
    sources = {root / name for name in sys.argv[3:]}
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = pathlib.Path(entry["file"])
        if path in sources:
            commands[path] = flags_of(entry["command"])
    for path in sorted(sources - commands.keys()):
        print(f"{path.relative_to(root)}: in no target, so not linted")
    units = []
    alike = lambda path: (str(path.parent), commands[path])
    for (folder, flags), group in itertools.groupby(sorted(commands, key=lambda p: (alike(p), p)), alike):
        group = list(group)
        for first in range(0, len(group), SOURCES_IN_UNIT):
            unit = out / pathlib.Path(folder).relative_to(root) / f"unit_{len(units)}.cpp"
            units.append((unit, group[first:first + SOURCES_IN_UNIT], flags))
    for config in [*root.glob("src/**/.clang-tidy"), *root.glob("tests/**/.clang-tidy")]:
        copy = out / config.relative_to(root)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(config, copy)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = "".join(pool.map(lambda unit: lint(*unit), sorted(units, key=lambda unit: -len(unit[1]))))
    print(found, end="")
    return 1 if found or sources - commands.keys() else 0


sys.exit(main())

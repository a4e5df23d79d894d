#!/usr/bin/env python3
"""Which source files one public call passes: those of src/ with a function that is executed in it.

Usage: tools/walk/walk.py [CALL]    all calls of calls.cpp as a table, or the files of one

The library is compiled without optimisation, so that functions are not inlined, into build/walk (minutes the first
time); valgrind then lists what runs. A header and its source count as one file. A file whose constructors, destructors
and assignments alone run does not count: they come with the members of a class.
"""
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.path.join(ROOT, "build", "walk")
PROGRAM = os.path.join(BUILD, "walk_calls")
NUMBERS = ("base/", "exact/")  # rooms without geometry of their own


def compile_calls():
    run = lambda *command: subprocess.run(command, check=True, stdout=sys.stderr, cwd=ROOT)
    run("cmake", "-G", "Ninja", "-B", BUILD, "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -g1",
        "-DDYMSUM_UNITY=ON", "-DDYMSUM_BUILD_CLI=OFF", "-DDYMSUM_BUILD_TESTS=OFF")
    run("ninja", "-C", BUILD, "dymsum")
    run("g++", "-std=c++20", "-O0", "-g1", "-Iinclude", "tools/walk/calls.cpp", "-o", PROGRAM,
        os.path.join(BUILD, "libdymsum.a"), "-ltbb", "-lpugixml", "-lzip", "-lz", "-lsqlite3")


def is_special(function):
    """Whether a function is a constructor, a destructor or an assignment."""
    name = re.sub(r"\[abi:[^]]*\]", "", function).split("(")[0]
    while (plain := re.sub(r"<[^<>]*>", "", name)) != name:
        name = plain
    parts = name.split("::")
    return len(parts) > 1 and (parts[-1].lstrip("~") == parts[-2] or parts[-1] == "operator=")


def files_of(call):
    listing = os.path.join(BUILD, "walk.out")
    # One core: what runs on other threads is not counted.
    subprocess.run(["taskset", "-c", "0", "valgrind", "--tool=callgrind", "--collect-atstart=no",
                    "--toggle-collect=walked(*", "--compress-strings=no", "--callgrind-out-file=" + listing, PROGRAM,
                    call], check=True, stderr=subprocess.DEVNULL)
    found, file = set(), ""
    with open(listing, errors="replace") as lines:
        for line in lines:
            if line.startswith("fl="):
                file = os.path.normpath(line[3:].strip())
            elif line.startswith("fn=") and "/src/" in file and file.startswith(ROOT) and not is_special(line[3:]):
                found.add(os.path.splitext(file.split("/src/", 1)[1])[0])
    return sorted(found)


def main():
    compile_calls()
    if len(sys.argv) == 2:
        print("\n".join(files_of(sys.argv[1])))
        return
    calls = subprocess.run([PROGRAM], check=True, capture_output=True, text=True).stdout.splitlines()
    print("| call | files | of `base/` and `exact/` | of the rooms above |\n|---|---|---|---|")
    for call in calls:
        files = files_of(call)
        numbers = sum(file.startswith(NUMBERS) for file in files)
        print(f"| `{call}` | {len(files)} | {numbers} | {len(files) - numbers} |", flush=True)


if __name__ == "__main__":
    main()

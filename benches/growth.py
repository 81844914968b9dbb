#!/usr/bin/env python3
"""How the time of a verdict grows: with the rows of a table, durations, the width of integers, and instances.

    benches/growth.py [--rungbook PROGRAM] [--limit SECONDS] [FAMILY…]

Each member of a family is a block with its table, written here and decided by `rungbook verify`. Times are seconds of CPU of
the whole command, the second check of the certificate included. Standard library only.
"""

import argparse
import json
import os
import resource
import subprocess
import tempfile


def rows(count):
    """A counter, and a table that says each of its values in a row of its own."""
    lines = [f"        row r{i} 1 {{ Up: TRUE; N: {i}; }}" for i in range(1, count + 1)]
    block = """FUNCTION_BLOCK FB_Grows
VAR_INPUT Up : BOOL; END_VAR
VAR_OUTPUT N : INT; END_VAR
IF Up THEN N := N + 1; END_IF
END_FUNCTION_BLOCK
"""
    return block, table("var input Up : BOOL\n    var output N : INT", lines)


def durations(cycles):
    """A switch-on delay of so many cycles of 1 ms."""
    block = f"""FUNCTION_BLOCK FB_Grows
VAR_INPUT Up : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
VAR Delay : TON; END_VAR
Delay(IN := Up, PT := T#{cycles}ms);
Q := Delay.Q;
END_FUNCTION_BLOCK
"""
    lines = [
        "        row off - { Up: FALSE; Q: FALSE; }",
        f"        row waiting {cycles} {{ Up: TRUE; Q: FALSE; }}",
        "        row on omega { Up: TRUE; Q: TRUE; }",
    ]
    return block, table("var input Up : BOOL\n    var output Q : BOOL", lines)


def widths(bits):
    """The extremes of a signal, and any value that was seen."""
    kind = {8: "SINT", 16: "INT", 32: "DINT", 64: "LINT"}[bits]
    block = f"""FUNCTION_BLOCK FB_Grows
VAR_INPUT Restart : BOOL; Value : {kind}; END_VAR
VAR_OUTPUT Lowest : {kind}; Highest : {kind}; END_VAR
IF Restart OR Value < Lowest THEN Lowest := Value; END_IF
IF Restart OR Value > Highest THEN Highest := Value; END_IF
END_FUNCTION_BLOCK
"""
    lines = [
        "        row restart 1   { Restart: TRUE;  Value: -;    Lowest: -;    Highest: -; }",
        "        row before -    { Restart: FALSE; Value: <> v; Lowest: -;    Highest: -; }",
        "        row seen 1      { Restart: FALSE; Value: v;    Lowest: <= v; Highest: >= v; }",
        "        row after omega { Restart: FALSE; Value: -;    Lowest: <= v; Highest: >= v; }",
    ]
    columns = f"var input Restart : BOOL\n    var input Value : {kind}\n    var output Lowest, Highest : {kind}\n    gvar v : {kind}"
    return block, table(columns, lines)


def instances(count):
    """A chain of latches, each set by the one before."""
    chain = "\n".join(f"L{i}(Set := L{i - 1}.Q);" for i in range(2, count + 1))
    names = ", ".join(f"L{i}" for i in range(1, count + 1))
    block = f"""FUNCTION_BLOCK FB_Latch
VAR_INPUT Set : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
IF Set THEN Q := TRUE; END_IF
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Grows
VAR_INPUT Up : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
VAR {names} : FB_Latch; END_VAR
L1(Set := Up);
{chain}
Q := L{count}.Q;
END_FUNCTION_BLOCK
"""
    lines = [
        "        row off -    { Up: FALSE; Q: FALSE; }",
        "        row set 1    { Up: TRUE;  Q: TRUE; }",
        "        row on omega { Up: -;     Q: TRUE; }",
    ]
    return block, table("var input Up : BOOL\n    var output Q : BOOL", lines)


def table(columns, lines):
    body = "\n".join(lines)
    return f"table Grows {{\n    {columns}\n    group g 1 {{\n{body}\n    }}\n}}\n"


FAMILIES = {
    "rows": (rows, [10, 30, 100, 300, 1000]),
    "durations": (durations, [10, 100, 1000, 10000, 100000]),
    "widths": (widths, [8, 16, 32, 64]),
    "instances": (instances, [1, 3, 10, 30, 100]),
}


def decide(program, made, limit):
    with tempfile.TemporaryDirectory() as folder:
        paths = [os.path.join(folder, "FB_Grows.st"), os.path.join(folder, "FB_Grows.gtt")]
        for path, text in zip(paths, made):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        command = [program, "verify", "--quiet", "--format", "json", "--jobs", "1", "--unit", "FB_Grows"]
        command += ["--cycle", "1ms", "--timeout", str(20 * limit)]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        confine = lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
        done = subprocess.run(command + paths, capture_output=True, text=True, preexec_fn=confine, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    try:
        found = json.loads(done.stdout)["tables"][0]
        return found["verdict"], found.get("engine") or "–", spent
    except (ValueError, KeyError, IndexError):
        return "not decided", "–", spent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rungbook", default="target/release/rungbook")
    parser.add_argument("--limit", type=int, default=60, help="seconds of CPU for one member")
    parser.add_argument("families", nargs="*", metavar="FAMILY")
    args = parser.parse_args()
    program = os.path.abspath(args.rungbook)
    print("| family | size | verdict | engine | seconds |\n|---|---:|---|---|---:|")
    for name in args.families or FAMILIES:
        make, sizes = FAMILIES[name]
        for size in sizes:
            verdict, engine, spent = decide(program, make(size), args.limit)
            print(f"| {name} | {size} | {verdict} | {engine} | {spent:.2f} |", flush=True)
            if verdict != "verified":
                break


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Holds the prover against public model checkers, on the obligations that tables give.

    benches/compare.py [--rungbook PROGRAM] [--limit SECONDS] [--only TEXT] PROJECT…

A PROJECT is a folder, or files joined by commas (PROGRAM.st,LIBRARY.st,TABLE.gtt), with `@4ms` behind it for a cycle time.
`rungbook verify --aiger` writes one AIGER file a table; then, one after the other and on one core:

* rungbook: `verify --fresh --jobs 1 --table NAME`, from the sources on, the second check of the certificate included;
* ABC (Debian: berkeley-abc): `pdr`, `int`, `bmc3`, each alone;
* rIC3 (crates.io), where it is found: its IC3.

Times are seconds of CPU, which other work on the machine changes little. The ratio is rungbook's time to that of the
fastest peer that decides the file; below 1 rungbook is ahead. Standard library only.
"""

import argparse
import json
import os
import re
import resource
import shutil
import subprocess
import tempfile

ABC = {"pdr": "pdr", "int": "int", "bmc3": "bmc3 -F 400"}


def timed(command, limit, cwd=None):
    """What the command prints, and its CPU seconds; None for the time where the limit ended it."""

    def confine():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", preexec_fn=confine, cwd=cwd)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.stdout, spent


def own(program, paths, options, table, limit):
    command = [program, "verify", "--quiet", "--fresh", "--jobs", "1", "--format", "json", "--timeout", str(20 * limit)]
    text, spent = timed(command + ["--table", table] + options + paths, limit)
    try:
        found = json.loads(text)["tables"][0]
    except (ValueError, KeyError, IndexError):
        return "", None
    decided = found["verdict"] in ("verified", "violated")
    return found["verdict"], spent if decided else None


def abc(program, file, engine, limit):
    text, spent = timed([program, "-c", f"read_aiger {file}; strash; {ABC[engine]}"], limit)
    if "Property proved" in text:
        return "verified", spent
    if re.search(r"was asserted in frame|Output \d+ of miter .* was asserted|asserted", text):
        return "violated", spent
    return "", None


def ric3(program, file, limit):
    text, spent = timed([program, "check", file, "ic3"], limit)
    word = next((w for w in ("UNSAT", "SAT") if w in text.upper()), "")
    return {"UNSAT": "verified", "SAT": "violated", "": ""}[word], spent if word else None


def obligations(program, paths, options):
    """The tables' names with their files."""
    folder = tempfile.mkdtemp(prefix="obligations-")
    subprocess.run([program, "verify", "--quiet", "--aiger", folder] + options + paths, capture_output=True, check=False)
    found = sorted(os.listdir(folder))
    return [(file, os.path.join(folder, file)) for file in found]


def names(program, paths, options):
    """The tables' names, by the names of their files."""
    command = [program, "verify", "--quiet", "--format", "json", "--fresh", "--timeout", "0"]
    done = subprocess.run(command + options + paths, capture_output=True, text=True, check=False)
    tables = json.loads(done.stdout)["tables"]
    plain = lambda text: "".join(c if c.isalnum() or c == "-" else "_" for c in text)
    return {f"{plain(t['unit'] or '')}-{plain(t['name'])}.aig": t["name"] for t in tables}


def show(time):
    return "–" if time is None else f"{time:.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rungbook", default="target/release/rungbook")
    parser.add_argument("--limit", type=int, default=60, help="seconds of CPU for one run")
    parser.add_argument("--only", default="", help="only files whose name holds this")
    parser.add_argument("projects", nargs="+")
    args = parser.parse_args()
    program = os.path.abspath(args.rungbook)
    peer = shutil.which("berkeley-abc") or shutil.which("abc")
    other = shutil.which("rIC3") or shutil.which("ric3")
    engines = (list(ABC) if peer else []) + (["rIC3"] if other else [])
    print("| table | verdict | rungbook | " + " | ".join(engines) + " | ratio |")
    print("|---|---|---:|" + "---:|" * len(engines) + "---:|")
    for project in args.projects:
        place, _, cycle = project.partition("@")
        paths, options = place.split(","), ["--cycle", cycle] if cycle else []
        known = names(program, paths, options)
        for short, file in obligations(program, paths, options):
            if args.only not in short or short not in known:
                continue
            verdict, time = own(program, paths, options, known[short], args.limit)
            peers = [abc(peer, file, engine, args.limit) for engine in engines if engine in ABC]
            peers += [ric3(other, file, args.limit)] if other else []
            claims = {claim for claim, spent in peers if spent is not None} | ({verdict} if time is not None else set())
            best = min((spent for _, spent in peers if spent is not None), default=None)
            ratio = f"{time / max(best, 0.01):.1f}" if time is not None and best is not None else "–"
            word = "DISAGREE " + "/".join(sorted(claims)) if len(claims) > 1 else next(iter(claims), "open")
            cells = [short.removesuffix(".aig"), word, show(time)] + [show(spent) for _, spent in peers] + [ratio]
            print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()

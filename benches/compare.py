#!/usr/bin/env python3
"""Holds the prover against public model checkers, on the obligations that tables give.

    benches/compare.py [--rungbook PROGRAM] [--limit SECONDS] [--only TEXT] PROJECT…

A PROJECT is a folder, or files joined by commas (PROGRAM.st,LIBRARY.st,TABLE.gtt), with `@4ms` behind it for a cycle time.
`rungbook verify --aiger` writes one AIGER file a table; then, one after the other and on one core:

* rungbook: `verify --fresh --jobs 1 --table NAME`, what the command says of its time: translation, proof, and the second
  check of the certificate, from the sources as they were read;
* the same prover on the AIGER file (`cargo build --release --no-default-features --example aiger`), where it is found: it
  then knows no more than the file says: words of several bits by their names, and no constraints;
* ABC (Debian: berkeley-abc): `pdr`, `int`, `bmc3`, each alone;
* rIC3 (crates.io), where it is found: its IC3.

Times are seconds, of CPU where another program is timed, which other work on the machine changes little. The ratios are
rungbook's time and the bare prover's to that of the fastest peer that decides the file; below 1 rungbook is ahead.
Standard library only.
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
    command = [program, "verify", "--quiet", "--fresh", "--jobs", "1", "--format", "json", "--timeout", str(limit)]
    done = subprocess.run(command + ["--table", table] + options + paths, capture_output=True, text=True, check=False)
    try:
        found = json.loads(done.stdout)["tables"][0]
    except (ValueError, KeyError, IndexError):
        return "", None
    return found["verdict"], found["seconds"] if found["verdict"] in ("verified", "violated") else None


def prover(program, file, limit):
    text, spent = timed([program, "--timeout", str(20 * limit), file], limit)
    verdict = text.partition("\t")[0]
    return verdict, spent if verdict in ("verified", "violated") else None


def abc(program, file, engine, limit):
    text, spent = timed([program, "-c", f"read_aiger {file}; strash; {ABC[engine]}"], limit)
    if "Property proved" in text:
        return "verified", spent
    if re.search(r"Output \d+ of miter .* was asserted in frame", text):
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


def ratio(time, best):
    return "–" if time is None or best is None else f"{time / max(best, 0.01):.1f}"


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
    bare = os.path.join(os.path.dirname(program), "examples", "aiger")
    bare = bare if os.path.exists(bare) else None
    engines = (list(ABC) if peer else []) + (["rIC3"] if other else [])
    print("| table | verdict | rungbook | on the file | " + " | ".join(engines) + " | ratio | on the file |")
    print("|---|---|---:|---:|" + "---:|" * len(engines) + "---:|---:|")
    for project in args.projects:
        place, _, cycle = project.partition("@")
        paths, options = place.split(","), ["--cycle", cycle] if cycle else []
        known = names(program, paths, options)
        for short, file in obligations(program, paths, options):
            if args.only not in short or short not in known:
                continue
            ours = [own(program, paths, options, known[short], args.limit)]
            ours.append(prover(bare, file, args.limit) if bare else ("", None))
            peers = [abc(peer, file, engine, args.limit) for engine in engines if engine in ABC]
            peers += [ric3(other, file, args.limit)] if other else []
            claims = {claim for claim, spent in ours + peers if spent is not None}
            word = "DISAGREE " + "/".join(sorted(claims)) if len(claims) > 1 else next(iter(claims), "open")
            best = min((spent for _, spent in peers if spent is not None), default=None)
            times = [show(spent) for _, spent in ours + peers] + [ratio(spent, best) for _, spent in ours]
            print("| " + " | ".join([short.removesuffix(".aig"), word] + times) + " |", flush=True)


if __name__ == "__main__":
    main()

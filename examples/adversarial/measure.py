#!/usr/bin/env python3
"""Time and memory of the tools on the bodies of this folder, at sizes that double, with growth exponents.

    cargo build --release --bins -p symtet -p adversarial
    python3 examples/adversarial/measure.py target/release [--sizes 50000,100000,200000] [--shape circle]

Time is processor time of the tool and its children, memory the peak of the tool alone. An exponent of 1 is
linear; it is taken between the smallest and the largest size.
"""
import argparse
import math
import os
import resource
import subprocess
import sys
import tempfile

SHAPES = ["coplanar", "shells", "circle", "spindle"]
# What is run, in the order of the pipe; each reads what the one named wrote.
STAGES = [
    ("meshqual", "body.off", ["--check"], None),
    ("symdetect", "body.off", ["--allow-asymmetric"], "found.tmesh"),
    ("wedgecut", "found.tmesh", [], "wedge.tmesh"),
    ("tetwedge", "wedge.tmesh", ["--no-quality", "--timeout", "60"], "tet.tmesh"),
]


def run(command, limit):
    """Exit code, last line of the messages, processor seconds, peak MiB."""
    with tempfile.TemporaryFile() as messages:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=messages,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        messages.seek(0)
        last = messages.read().decode(errors="replace").strip().splitlines()[-1:]
        return process.returncode, "".join(last), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries")
    parser.add_argument("--sizes", default="50000,100000,200000")
    parser.add_argument("--shape", choices=SHAPES, action="append")
    parser.add_argument("--stages", default="meshqual,symdetect,wedgecut,tetwedge")
    parser.add_argument("--limit", type=int, default=300, help="processor seconds per run")
    options = parser.parse_args()
    sizes = [int(n) for n in options.sizes.split(",")]
    print(f"{'shape':<10}{'tool':<11}" + "".join(f"{n:>12} s{'MiB':>7}" for n in sizes) + "   exponents s, MiB")
    worst = 0
    for shape in options.shape or SHAPES:
        rows = {stage[0]: [] for stage in STAGES}
        for n in sizes:
            with tempfile.TemporaryDirectory() as folder:
                at = lambda name: os.path.join(folder, name)
                with open(at("body.off"), "wb") as out:
                    subprocess.run([os.path.join(options.binaries, "adversarial"), shape, str(n)],
                                   stdout=out, check=True)
                for tool, source, arguments, target in STAGES:
                    if tool not in options.stages or not os.path.exists(at(source)):
                        continue
                    command = [os.path.join(options.binaries, tool), *arguments, at(source)]
                    if target:
                        command += ["-o", at(target)]
                    code, said, seconds, memory = run(command, options.limit)
                    rows[tool].append((n, code, seconds, memory))
                    if code:
                        print(f"{shape} {tool} {n}: exit {code}: {said[:200]}", file=sys.stderr)
        for tool, results in rows.items():
            if not results:
                continue
            line = "".join(f"{s:>12.2f}  {m:>7.0f}" for _, _, s, m in results)
            exponents = ""
            if len(results) > 1:
                (n0, _, s0, m0), (n1, _, s1, m1) = results[0], results[-1]
                grown = [math.log(max(b, 1e-3) / max(a, 1e-3)) / math.log(n1 / n0) for a, b in ((s0, s1), (m0, m1))]
                exponents = "   {:.2f} {:.2f}".format(*grown)
                worst = max(worst, grown[0])
            print(f"{shape:<10}{tool:<11}{line}{exponents}", flush=True)
    print(f"worst exponent of time {worst:.2f}")


if __name__ == "__main__":
    main()

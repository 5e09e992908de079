#!/usr/bin/env python3
"""The benchmark: the pipe against the direct mesh of the whole body, with the same parameters.

    bench.py run --quick        two parameter sets, ends within ten minutes on two cores
    bench.py run                every cell, hours; can be interrupted and started again
    bench.py direct             only the long direct runs, ahead of `run`, which then takes them over
    bench.py scaling            time against order, triangles and size of the output
    bench.py report             tables and plots of what has been measured so far
    bench.py summary            the main figures of the published report, in a few lines

Needs nothing but Python 3.9, the release binaries and `tetgen`.
"""

import argparse
import dataclasses
import json
import os
import shutil
import subprocess
import sys
import time

import cells
import contestants
import machine
import measure
import quality
import report
import scaling

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
TOOLS = ("symdetect", "wedgecut", "tetwedge", "rotassemble", "meshqual")
# The same placement for every body: nothing about the axis is given away.
PLACEMENT = ["--rotate", "1"]
# Hours of direct meshing can be the answer for the practical via; seconds.
PRACTICAL_LIMIT = 3600
# Direct runs from here on are taken over from `bench.py direct`, seconds; shorter ones alternate with
# the pipe's.
LONG = 2.0
# The quick run ends within ten minutes whatever the machine; the last cell, scaling and the report
# take the rest.
QUICK_MINUTES = 7.5


class Results:
    """Measurements as lines of JSON, appended as they are made."""

    def __init__(self, path, header):
        self.path = path
        self.lines = report.load(self.path)
        known = next((r for r in self.lines if r["kind"] == "header"), None)
        if known is None:
            self.append(header)
        elif known["binaries"] != header["binaries"] or known["machine"] != header["machine"]:
            sys.exit(
                f"bench: {self.path} was measured with other binaries or on another machine; "
                "give another --out, or remove it"
            )
        self.done = {(r["kind"], r.get("key")): r for r in self.lines}

    def has(self, kind, key):
        return (kind, key) in self.done

    def get(self, kind, key):
        """The record of that name, or nothing."""
        return self.done.get((kind, key))

    def append(self, record):
        self.lines.append(record)
        with open(self.path, "a+b") as file:
            # A line that an interruption cut short must not swallow this one.
            if file.tell() and not self.ends_with_newline(file):
                file.write(b"\n")
            file.write(json.dumps(record).encode() + b"\n")
        if "key" in record:
            self.done[(record["kind"], record["key"])] = record

    @staticmethod
    def ends_with_newline(file):
        file.seek(-1, os.SEEK_END)
        return file.read(1) == b"\n"


def make_body(options, arguments, folder):
    """Writes body.stl, somewhere in space, and body.poly, its axis on z, into a clean folder."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    program = os.path.join(options.binaries, "body")
    for extra in (PLACEMENT + ["--to", "ascii", "-o", "body.stl"], ["-o", "body.poly"]):
        subprocess.run([program, *arguments, *extra], cwd=folder, check=True)


def limit_of(options, cell):
    return PRACTICAL_LIMIT if cell.category == "P" and not options.quick else options.limit


def kept_of_direct(options, cell, direct, series, folder):
    """What is kept of the direct mesh."""
    summary = series.summary()
    if series.ok:
        summary["output_seconds"] = direct.output_seconds(folder)
        summary["quality"] = quality.of_direct(options.binaries, folder, cell.elements.radius_edge)
    return summary


def measure_optimized(options, cell, folder):
    """The direct mesh with -o/130, once."""
    direct = contestants.Direct(cell.elements, "130")
    series = measure.Series([direct.run(folder, limit_of(options, cell))])
    return kept_of_direct(options, cell, direct, series, folder)


def measure_direct(options, cell, folder):
    """The direct mesh alone, as often as `options.repeats` says."""
    make_body(options, cell.body_arguments(), folder)
    direct = contestants.Direct(cell.elements)
    repeats = dataclasses.replace(options.repeats, seconds=0)
    series = measure.interleaved({"direct": lambda: direct.run(folder, limit_of(options, cell))}, repeats)["direct"]
    record = {"load": os.getloadavg()[0], "direct": {"default": kept_of_direct(options, cell, direct, series, folder)}}
    if cell.elements in cells.OPTIMIZED_SETS and series.ok and cell.category != "P":
        record["direct"]["130"] = measure_optimized(options, cell, folder)
    return record


def measure_cell(options, cell, folder, ahead=None):
    """Everything about one cell, as plain data; `ahead` is the record of a long direct run made before."""
    make_body(options, cell.body_arguments(), folder)
    e, limit = cell.elements, limit_of(options, cell)
    direct = contestants.Direct(e)
    pipes = {v: contestants.Pipe(options.binaries, e, angle) for v, angle in contestants.VARIANTS.items()}
    record = {"load": os.getloadavg()[0], "switches": direct.switches, "pipe": {}, "direct": {}, "stages": {}}
    if ahead and ahead["direct"]["default"]["seconds"] < LONG:
        ahead = None

    tasks = {} if ahead else {"direct": lambda: direct.run(folder, limit)}
    for name in options.variants(cell):
        tasks[name] = lambda name=name: pipes[name].run(folder, limit, f"pipe-{name}.vtk")
    series = measure.interleaved(tasks, options.repeats)

    if ahead:
        record["direct"] = ahead["direct"]
        record["direct_load"] = ahead["load"]
    else:
        record["direct"]["default"] = kept_of_direct(options, cell, direct, series["direct"], folder)
    for name in options.variants(cell):
        record["pipe"][name] = summary = series[name].summary()
        if series[name].ok:
            summary["memory_of"] = pipes[name].memory(folder, limit)
            summary["memory"] = sum(summary["memory_of"])
            summary["bytes"] = os.path.getsize(os.path.join(folder, f"pipe-{name}.vtk"))
            summary["quality"] = quality.of(options.binaries, folder, f"pipe-{name}.vtk", e.radius_edge)

    if e in cells.OPTIMIZED_SETS and not ahead and series["direct"].ok and cell.category != "P":
        record["direct"]["130"] = measure_optimized(options, cell, folder)

    record["stages"] = measure_stages(options, pipes["default"], folder)
    if options.hxt and cell.category != "P" and e in cells.OPTIMIZED_SETS:
        hxt = contestants.Hxt(options.gmsh_python, cell)
        again = measure.interleaved({"hxt": lambda: hxt.run(folder, limit)}, options.repeats)["hxt"]
        record["hxt"] = summary = again.summary()
        if again.ok:
            summary["quality"] = quality.of(options.binaries, folder, "hxt.msh", e.radius_edge)
    record["memory_floor"] = measure.own_memory()
    return record


def measure_stages(options, pipe, folder):
    """Each stage alone, from file to file."""
    stages = {}
    for index, name in enumerate(contestants.STAGES):
        mesher = []

        def one():
            result = pipe.stage(index, folder, options.limit)
            if name == "tetwedge" and result.ok:
                mesher.append(contestants.mesher_seconds(result))
            return result

        # The whole pipe has been measured; here it is the shares that matter.
        series = measure.interleaved({name: one}, dataclasses.replace(options.repeats, seconds=0))[name]
        stages[name] = series.summary()
        if not series.ok:
            break
        if mesher:
            stages[name]["mesher_seconds"] = sorted(mesher)[len(mesher) // 2]
    return stages


def describe(record):
    """One line about a cell for the terminal."""
    direct, pipe = record["direct"]["default"], record["pipe"]["default"]
    if "failure" in pipe:
        return f"pipe failed: {pipe['failure']}"
    counts = f"pipe {pipe['seconds']:.3f} s, {pipe['quality'].get('tetrahedra', 0):,} tets"
    if "failure" in direct:
        return f"direct failed: {direct['failure']}; {counts}"
    return f"direct {direct['seconds']:.3f} s, {counts}, speed-up {direct['seconds'] / pipe['seconds']:.1f}"


def chosen_cells(options):
    return [c for c in (cells.quick() if options.quick else cells.full()) if options.wants(c)]


def run_direct(options):
    """Measures direct meshes; what takes less than `LONG` is measured by `run` itself again."""
    results = open_direct(options)
    chosen = chosen_cells(options)
    folder = os.path.join(options.out, "work-direct")
    for number, cell in enumerate(chosen, 1):
        if not results.has("direct", cell.key):
            record = {"kind": "direct", "key": cell.key}
            record.update(measure_direct(options, cell, folder))
            results.append(record)
            print(f"[{number}/{len(chosen)}] {cell.key}: {record['direct']['default']['seconds']:.3f} s", flush=True)
    shutil.rmtree(folder, ignore_errors=True)


def run(options):
    results, ahead = open_results(options), open_direct(options)
    chosen = chosen_cells(options)
    if options.list:
        for cell in chosen:
            print(cell.key, "done" if results.has("cell", cell.key) else "")
        return
    if options.hxt and not contestants.Hxt.available(options.gmsh_python):
        print("bench: no Python package gmsh; HXT is skipped")
        options.hxt = False
    folder = os.path.join(options.out, "work")
    start = time.monotonic()
    for number, cell in enumerate(chosen, 1):
        if results.has("cell", cell.key):
            continue
        if options.stop_after and time.monotonic() - start > 60 * options.stop_after:
            print(f"bench: {options.stop_after:g} minutes are over; start again to go on")
            break
        record = {"kind": "cell", "key": cell.key, "category": cell.category, "order": cell.order}
        record.update(vars(cell.elements))
        record.update(measure_cell(options, cell, folder, ahead.get("direct", cell.key)))
        results.append(record)
        print(f"[{number}/{len(chosen)}] {cell.key}: {describe(record)}", flush=True)
    shutil.rmtree(folder, ignore_errors=True)
    if options.quick and not options.cells:
        scaling.run(options, results, make_body, quick=True)
    report.write(results.lines, options.out)
    print(f"bench: the report is {os.path.join(options.out, 'README.md')}")


def open_results(options):
    os.makedirs(options.out, exist_ok=True)
    header = {
        "kind": "header",
        "machine": machine.describe(),
        "binaries": machine.fingerprint(options.binaries, TOOLS),
        "sets": "quick" if options.quick else "full",
        "limit": options.limit,
        "hxt": bool(options.hxt),
    }
    return Results(os.path.join(options.out, "results.jsonl"), header)


def open_direct(options):
    """Direct runs made ahead; they do not depend on the tools, only on the bodies."""
    os.makedirs(options.out, exist_ok=True)
    bodies = machine.fingerprint(options.binaries, ("body",))
    header = {"kind": "header", "machine": machine.describe(), "binaries": bodies}
    return Results(os.path.join(options.out, "direct.jsonl"), header)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "direct", "scaling", "report", "summary"))
    parser.add_argument("--quick", action="store_true", help="two parameter sets, one run of what takes long")
    parser.add_argument("--out", help="folder for results [default: target/bench/quick or full]")
    parser.add_argument("--binaries", default=os.path.join(ROOT, "target", "release"), help="folder of the programs")
    parser.add_argument("--limit", type=float, help="seconds that a run may take [default: 900; quick 60]")
    parser.add_argument("--least", type=int, help="runs of each, unless one takes 30 s [default: 3; quick 1]")
    parser.add_argument("--seconds", type=float, help="least time that runs of each take together, seconds [default: 2; quick 0.5]")
    parser.add_argument("--cells", action="append", help="only cells whose key starts with this, as B-16; repeatable")
    parser.add_argument("--stop-after", type=float, metavar="MINUTES", help="start no cell after that time [quick: 7.5]")
    parser.add_argument("--hxt", action="store_true", help="also measure Gmsh's HXT, where gmsh can be imported")
    parser.add_argument("--gmsh-python", default=sys.executable, help="Python program that can import gmsh")
    parser.add_argument("--largest", type=float, default=201, help="largest output of scaling, million elements [default: 201]")
    parser.add_argument("--list", action="store_true", help="list the cells and what is done")
    options = parser.parse_args()
    name = "quick" if options.quick else "full"
    options.out = os.path.abspath(options.out or os.path.join(ROOT, "target", "bench", name))
    options.binaries = os.path.abspath(options.binaries)
    options.limit = options.limit or (60 if options.quick else 900)
    if options.quick and options.stop_after is None:
        options.stop_after = QUICK_MINUTES
    least = options.least or (1 if options.quick else 3)
    seconds, once = (0.5, 1.0) if options.quick else (2.0, 30.0)
    seconds = options.seconds or seconds
    options.repeats = measure.Repeats(least=least, seconds=seconds, once=once)
    options.wants = lambda c: not options.cells or any((c.key + "-").startswith(p + "-") for p in options.cells)
    few = lambda c: c.elements not in cells.OFF_SETS or options.quick and c.order != 16
    options.variants = lambda c: ["default"] if few(c) else list(contestants.VARIANTS)
    return options


def main():
    options = parse()
    if options.command == "run":
        run(options)
    elif options.command == "direct":
        run_direct(options)
    elif options.command == "scaling":
        results = open_results(options)
        scaling.run(options, results, make_body, quick=options.quick)
        report.write(results.lines, options.out)
    elif options.command == "summary":
        with open(os.path.join(ROOT, "examples", "benchmark", "results", "results.json")) as file:
            print("\n".join(report.summary(json.load(file))))
    else:
        report.write(report.load(os.path.join(options.out, "results.jsonl")), options.out)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("bench: interrupted; start again to go on")

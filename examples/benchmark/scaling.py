"""How the pipe's time grows: with the order, with the triangles, with the size of the output.

As a program: `scaling.py subdivide LEVELS IN OUT` splits every triangle of an ASCII STL file into
four, LEVELS times, and writes binary STL.
"""

import json
import os
import shutil
import statistics
import struct
import sys

import contestants
import measure
from cells import Elements

HERE = os.path.abspath(__file__)
ELEMENTS = Elements(1.4, 10, 1e-3)

ORDER = (8, 16, 32, 64, 128, 256, 512)
QUICK_ORDER = (16, 64, 256)
# 128 triangles, each split into four so many times.
LEVELS = (1, 2, 3, 4, 5, 6)
QUICK_LEVELS = (1, 3, 5)
# Order of the body whose elements are made smaller and smaller, and their largest volumes; the last
# gives 200 million elements.
OUTPUT_ORDER = 128
VOLUMES = (1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 2.6e-8)
QUICK_VOLUMES = (1e-5, 1e-6, 3e-7)
# Elements over 1 / volume, roughly.
ELEMENTS_PER_VOLUME = 5.1
# Where the time goes: orders of the body, and for each the largest volumes that give about 1 and 20 million elements.
SHARES = {4: (7e-6, 1.55e-7), 16: (7e-4, 2.5e-7), 128: (1e-3, 3e-7)}
QUICK_SHARES = {16: (7e-4,)}


def run(options, results, make_body, quick):
    """Measures the series as far as they are not measured yet."""
    folder = os.path.join(options.out, "work")
    for order in QUICK_ORDER if quick else ORDER:
        arguments = ["ring", "--order", str(order)]
        point(options, results, make_body, folder, "order", order, arguments, ELEMENTS)
    for level in QUICK_LEVELS if quick else LEVELS:
        arguments = ["prism", "--bore", "0.5", "--order", "16"]
        point(options, results, make_body, folder, "triangles", 128 * 4**level, arguments, ELEMENTS, level)
    for volume in QUICK_VOLUMES if quick else VOLUMES:
        if ELEMENTS_PER_VOLUME / volume <= 1e6 * options.largest:
            elements = Elements(1.4, 10, volume)
            arguments = ["ring", "--order", str(OUTPUT_ORDER)]
            point(options, results, make_body, folder, "output", volume, arguments, elements)
    for order, volumes in (QUICK_SHARES if quick else SHARES).items():
        for volume in volumes:
            if ELEMENTS_PER_VOLUME / volume <= 1e6 * options.largest:
                elements = Elements(1.4, 10, volume)
                arguments = ["ring", "--order", str(order)]
                point(options, results, make_body, folder, f"share-{order}", volume, arguments, elements)
    shutil.rmtree(folder, ignore_errors=True)


def point(options, results, make_body, folder, series, x, arguments, elements, levels=0):
    """One point of a series: each stage alone, and the whole pipe into a file and into nothing."""
    key = f"{series}-{x:g}"
    if results.has("scaling", key):
        return
    make_body(options, arguments, folder)
    if levels:
        os.rename(os.path.join(folder, "body.stl"), os.path.join(folder, "coarse.stl"))
        command = [sys.executable, HERE, "subdivide", str(levels), "coarse.stl", "body.stl"]
        done = measure.run([command], folder, options.limit)
        if not done.ok:
            sys.exit(f"bench: cannot subdivide: {done.failure}")
    pipe = contestants.Pipe(options.binaries, elements)
    if series == "output":
        # Every wedge is meshed, so that the output is much larger than what is meshed.
        pipe.commands[1] += ["--order", str(OUTPUT_ORDER)]
    record = {"kind": "scaling", "key": key, "series": series, "x": x, "stages": {}}
    measure_point(options, record, pipe, folder)
    results.append(record)
    print(f"scaling {key}: {describe(record)}", flush=True)


def measure_point(options, record, pipe, folder):
    for index, name in enumerate(contestants.STAGES[:3]):
        runs = measure.interleaved({name: lambda: pipe.stage(index, folder, options.limit)}, options.repeats)
        record["stages"][name] = runs[name].summary()
        if not runs[name].ok:
            record["failure"] = f"{name}: {runs[name].summary()['failure']}"
            return
        if name == "tetwedge":
            record["mesher_seconds"] = statistics.median(map(contestants.mesher_seconds, runs[name].runs))
    counts = count(options, folder)
    record.update(counts)
    # Legacy VTK: 28 bytes a tetrahedron with its region, 24 a vertex.
    size = 28 * counts["tetrahedra"] + 24 * counts["vertices"]
    last = contestants.Pipe.stage
    tasks = {
        "pipe": lambda: pipe.run(folder, options.limit, os.devnull),
        "null": lambda: measure.run([pipe.commands[3]], folder, options.limit, os.path.join(folder, "stage-3.tmesh")),
    }
    if shutil.disk_usage(folder).free > 1.5 * size + 2e9:
        tasks["file"] = lambda: last(pipe, 3, folder, options.limit)
        tasks["pipe_file"] = lambda: pipe.run(folder, options.limit)
    series = measure.interleaved(tasks, options.repeats)
    for name, runs in series.items():
        record[name] = runs.summary()
    record["bytes"] = size
    record["memory_of"] = pipe.memory(folder, options.limit)
    for name in ("pipe.vtk", "stage.vtk"):
        if os.path.exists(os.path.join(folder, name)):
            os.unlink(os.path.join(folder, name))


def count(options, folder):
    """Sizes of the assembled mesh, without assembling it."""
    command = [os.path.join(options.binaries, "meshqual"), "stage-3.tmesh", "--json", "-"]
    measure.run([command], folder, 3600, sink="count.json")
    with open(os.path.join(folder, "count.json")) as file:
        report = json.load(file)
    return {"tetrahedra": report["tetrahedra"], "vertices": report["vertices"]}


def describe(record):
    if "failure" in record:
        return record["failure"]
    pipe = record["pipe"]
    if "failure" in pipe:
        return pipe["failure"]
    return f"{record['tetrahedra']:,} tets, pipe {pipe['seconds']:.3f} s"


def subdivide(levels, source, target):
    triangles, corners = [], []
    with open(source) as file:
        for line in file:
            words = line.split()
            if words and words[0] == "vertex":
                corners.append(tuple(map(float, words[1:])))
                if len(corners) == 3:
                    triangles.append(tuple(corners))
                    corners = []
    middle = lambda p, q: tuple(0.5 * (x + y) for x, y in zip(p, q))
    for _ in range(levels):
        finer = []
        for a, b, c in triangles:
            d, e, f = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, d, f), (d, b, e), (f, e, c), (d, e, f)]
        triangles = finer
    with open(target, "wb") as out:
        out.write(b"subdivided".ljust(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for p in triangle for x in p), 0))


if __name__ == "__main__":
    subdivide(int(sys.argv[2]), sys.argv[3], sys.argv[4])

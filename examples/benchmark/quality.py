"""Quality of a mesh by meshqual, reduced to what the benchmark keeps.

As a program: `quality.py elements FOLDER` turns TetGen's body.1.node and body.1.ele into the binary
VTK file direct.vtk. It runs in a process of its own, so that the driver's memory stays small.
"""

import array
import json
import os
import sys

import measure

# Common bins, so that runs can be averaged: first edge, last edge, number.
BINS = {
    "min_dihedral_deg": (0.0, 72.0, 72),
    "max_dihedral_deg": (60.0, 180.0, 60),
    "radius_edge_ratio": (0.6, 2.4, 90),
}
# Part of a bound that is taken for rounding: meshes that keep it may have elements that just reach it.
ROUNDING = 1e-9
STATISTICS = ("min", "max", "mean", "p01", "p50", "p99")


def rebinned(histogram, bins):
    """Shares per bin of `bins`; what lies outside goes to the first and the last one."""
    first, last, number = bins
    width = (last - first) / number
    shares = [0.0] * number
    edges, counts = histogram["edges"], histogram["counts"]
    total = max(1, sum(counts))
    for low, high, count in zip(edges, edges[1:], counts):
        if not count:
            continue
        middle = int((0.5 * (low + high) - first) / width)
        shares[min(max(middle, 0), number - 1)] += count / total
    return [round(s, 7) for s in shares]


def summary(report):
    """What is kept of meshqual's JSON report."""
    metrics = report["metrics"]
    return {
        "tetrahedra": report["tetrahedra"],
        "vertices": report["vertices"],
        "volume": report["volume"],
        "radius_edge_violations": report["beyond"][0]["share"],
        "statistics": {m: {s: metrics[m][s] for s in STATISTICS} for m in BINS},
        "histograms": {m: rebinned(metrics[m]["histogram"], bins) for m, bins in BINS.items()},
        "checks": report["checks"],
    }


def of(binaries, folder, mesh, radius_edge):
    """Quality of a mesh file, or what went wrong."""
    bound = f"radius_edge_ratio={radius_edge * (1 + ROUNDING)!r}"
    tool = os.path.join(binaries, "meshqual")
    command = [tool, mesh, "--bins", "1000", "--count-above", bound, "--json", "-"]
    run = measure.run([command], folder, 3600, sink="quality.json")
    if not run.ok:
        return {"failure": run.failure}
    with open(os.path.join(folder, "quality.json")) as file:
        return summary(json.load(file))


def of_direct(binaries, folder, radius_edge):
    """Quality of the files that the direct run wrote."""
    command = [sys.executable, os.path.abspath(__file__), "elements", "."]
    run = measure.run([command], folder, 3600)
    if not run.ok:
        return {"failure": run.failure}
    return of(binaries, folder, "direct.vtk", radius_edge)


def big_endian(values):
    if sys.byteorder == "little":
        values.byteswap()
    return values.tobytes()


def convert(folder):
    """TetGen's text files as a binary VTK file."""
    with open(os.path.join(folder, "body.1.node")) as file:
        count = int(file.readline().split()[0])
        points, first = array.array("d", bytes(24 * count)), None
        for i in range(count):
            words = file.readline().split()
            first = int(words[0]) if first is None else first
            points[3 * i : 3 * i + 3] = array.array("d", map(float, words[1:4]))
    with open(os.path.join(folder, "body.1.ele")) as file:
        elements = int(file.readline().split()[0])
        cells, regions = array.array("i", bytes(20 * elements)), array.array("i", bytes(4 * elements))
        for i in range(elements):
            words = [int(w) for w in file.readline().split()]
            a, b, c, d = words[1:5]
            cells[5 * i : 5 * i + 5] = array.array("i", (4, a - first, b - first, c - first, d - first))
            regions[i] = words[5] if len(words) > 5 else 0
    with open(os.path.join(folder, "direct.vtk"), "wb") as out:
        say = lambda text: out.write(text.encode())
        say("# vtk DataFile Version 3.0\ndirect mesh\nBINARY\nDATASET UNSTRUCTURED_GRID\n")
        say(f"POINTS {count} double\n")
        out.write(big_endian(points))
        say(f"\nCELLS {elements} {5 * elements}\n")
        out.write(big_endian(cells))
        say(f"\nCELL_TYPES {elements}\n")
        out.write(big_endian(array.array("i", [10]) * elements))
        say(f"\nCELL_DATA {elements}\nSCALARS region int 1\nLOOKUP_TABLE default\n")
        out.write(big_endian(regions))


if __name__ == "__main__":
    convert(sys.argv[2])

"""From the measurements to tables and plots."""

import csv
import json
import math
import os

import contestants
import markdown
import plots
import quality
from cells import ORDERS

SERIES = {
    "order": "order n (ring, everything else the same)",
    "triangles": "triangles (bored prism, order 16)",
    "output": "tetrahedra written (ring, order 128)",
}


def load(path):
    """Lines of a result file; what an interruption left of the last one is passed over."""
    lines = []
    if os.path.exists(path):
        with open(path) as file:
            for line in file:
                try:
                    lines.append(json.loads(line))
                except ValueError:
                    continue
    return lines


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def spread(values):
    values = [v for v in values if v is not None]
    return {"min": min(values), "geomean": geometric_mean(values), "max": max(values)} if values else None


def flat(cell):
    """A cell as one row."""
    direct, stages = cell["direct"]["default"], cell["stages"]
    row = {k: cell[k] for k in ("key", "category", "order", "radius_edge", "min_dihedral", "max_volume", "load")}
    contest = {"direct": direct, "direct_130": cell["direct"].get("130", {}), "hxt": cell.get("hxt", {})}
    for variant in contestants.VARIANTS:
        contest["pipe" if variant == "default" else f"pipe_{variant}"] = cell["pipe"].get(variant, {})
    for name, summary in contest.items():
        measured = summary.get("quality") or {}
        statistics = measured.get("statistics", {})
        angle = statistics.get("min_dihedral_deg", {})
        checks = measured.get("checks", {})
        row.update({
            f"seconds_{name}": summary.get("seconds") if "failure" not in summary else None,
            f"cpu_seconds_{name}": summary.get("cpu_seconds"),
            f"runs_{name}": summary.get("runs"),
            f"memory_{name}": summary.get("memory"),
            f"tets_{name}": measured.get("tetrahedra"),
            f"min_dihedral_{name}": angle.get("min"),
            f"p01_dihedral_{name}": angle.get("p01"),
            f"violations_{name}": measured.get("radius_edge_violations"),
            f"checks_{name}": checks.get("passed"),
            f"failure_{name}": summary.get("failure") or measured.get("failure"),
        })
    row["direct_output_seconds"] = direct.get("output_seconds")
    row["direct_timed_out"] = direct.get("timed_out", False)
    row["direct_limit"] = direct["seconds"] if direct.get("timed_out") else None
    for stage in contestants.STAGES:
        row[f"stage_{stage}"] = stages.get(stage, {}).get("seconds")
    row["stage_mesher"] = stages.get("tetwedge", {}).get("mesher_seconds")
    ratio = lambda a, b: a / b if a and b else None
    pipe = row["seconds_pipe"]
    row["speedup"] = ratio(row["seconds_direct"], pipe)
    without = row["seconds_direct"] - row["direct_output_seconds"] if row["seconds_direct"] else None
    row["speedup_without_output"] = ratio(without, pipe)
    row["speedup_at_least"] = ratio(row["direct_limit"], pipe)
    row["speedup_off"] = ratio(row["seconds_direct"], row["seconds_pipe_off"])
    row["speedup_130_both"] = ratio(row["seconds_direct_130"], pipe)
    row["count_ratio_130_both"] = ratio(row["tets_pipe"], row["tets_direct_130"])
    row["direct_ahead"] = "direct_load" in cell
    row["speedup_hxt"] = ratio(row["seconds_hxt"], pipe)
    row["count_ratio"] = ratio(row["tets_pipe"], row["tets_direct"])
    return row


def aggregate(rows):
    """Per category and order, over the parameter sets."""
    table = []
    groups = [(c, n) for c in "ABC" for n in ORDERS] + [("P", 24)]
    for category, order in groups:
        mine = [r for r in rows if (r["category"], r["order"]) == (category, order)]
        if not mine:
            continue
        both = [r for r in mine if r["p01_dihedral_pipe"] is not None and r["p01_dihedral_direct"] is not None]
        gain = lambda name: min((r[f"{name}_pipe"] - r[f"{name}_direct"] for r in both), default=None)
        worst = lambda name: max((r[name] for r in mine if r[name] is not None), default=None)
        table.append({
            "category": category,
            "order": order,
            "sets": len(mine),
            "direct_failed": sum(r["failure_direct"] is not None for r in mine),
            "pipe_failed": sum(r["failure_pipe"] is not None for r in mine),
            "speedup": spread([r["speedup"] for r in mine]),
            "speedup_without_output": spread([r["speedup_without_output"] for r in mine]),
            "speedup_at_least": spread([r["speedup_at_least"] for r in mine]),
            "speedup_off": spread([r["speedup_off"] for r in mine]),
            "speedup_130_both": spread([r["speedup_130_both"] for r in mine]),
            "count_ratio": spread([r["count_ratio"] for r in mine]),
            "count_ratio_130_both": spread([r["count_ratio_130_both"] for r in mine]),
            "p01_gain": gain("p01_dihedral"),
            "min_gain": gain("min_dihedral"),
            "violations_pipe": worst("violations_pipe"),
            "violations_direct": worst("violations_direct"),
            "violations_more": sum((r["violations_pipe"] or 0) > (r["violations_direct"] or 0) for r in mine),
            "checks_passed": sum(r["checks_pipe"] is True for r in mine),
        })
    return table


def summary(results):
    """The main figures of a report, lines of text: the mean over the sets of the order where it is least and most."""
    lines = [f"{'':<14}{'times as fast, mean of an order':<36}{'of a set, at least':<22}elements over the direct mesh's"]
    for category, name in (("A", "plain prisms"), ("B", "coated holes"), ("C", "vias"), ("P", "practical via")):
        rows = sorted((r for r in results["table"] if r["category"] == category), key=lambda r: r["speedup"]["geomean"])
        if not rows:
            continue
        ends = rows[:1] + rows[1:][-1:]
        means = " to ".join(f"{r['speedup']['geomean']:.1f} (order {r['order']})" for r in ends)
        least = min(r["speedup"]["min"] for r in rows)
        counts = [min(r["count_ratio"]["min"] for r in rows), max(r["count_ratio"]["max"] for r in rows)]
        lines.append(f"{name:<14}{means:<36}{least:<22.1f}{counts[0]:.2f} to {counts[1]:.2f}")
    cells = results["cells"]
    both = [c for c in cells if c["p01_dihedral_pipe"] is not None and c["p01_dihedral_direct"] is not None]
    gains = [[c[f"{name}_pipe"] - c[f"{name}_direct"] for c in both] for name in ("p01_dihedral", "min_dihedral")]
    lines.append(f"smallest dihedral angle, first percentile: {min(gains[0]):.1f} to {max(gains[0]):.1f} degrees above the direct mesh's")
    lines.append(f"smallest dihedral angle of all: {min(gains[1]):.1f} to {max(gains[1]):.1f} degrees above it")
    past = [sum((c[f"violations_{who}"] or 0) > 0 for c in cells) for who in ("pipe", "direct")]
    lines.append(f"cells with elements past the radius-edge bound, of {len(cells)}: {past[0]} of the pipe, {past[1]} of the direct mesh")
    passed = sum(c["checks_pipe"] is True for c in cells)
    lines.append(f"meshes that pass meshqual --check: {passed} of {len(cells)}")
    largest = max((p for series in results["scaling"].values() for p in series), key=lambda p: p["tetrahedra"])
    lines.append(
        f"largest mesh into a pipe: {largest['tetrahedra'] / 1e6:.0f} million elements, {largest['pipe']:.1f} seconds, "
        f"{largest['memory'] / 2**30:.1f} GiB"
    )
    return lines


def fit(points):
    """Exponent of y in x, least squares in logarithms."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x > 0 and y > 0]
    if len(logs) < 2:
        return None
    mx, my = (sum(c) / len(logs) for c in zip(*logs))
    below = sum((x - mx) ** 2 for x, _ in logs)
    return sum((x - mx) * (y - my) for x, y in logs) / below if below else None


def scaling(lines):
    """Series name to its points, sorted, with the stages' times."""
    series = {name: [] for name in SERIES}
    for record in lines:
        if record["kind"] != "scaling" or record["series"] not in series or "failure" in record or "failure" in record["pipe"]:
            continue
        stages = {s: m["seconds"] for s, m in record["stages"].items()}
        best = record.get("file", record["null"])
        if "seconds" in best and "failure" not in best:
            stages["rotassemble"] = best["seconds"]
        series[record["series"]].append({
            "x": record["tetrahedra"] if record["series"] == "output" else record["x"],
            "tetrahedra": record["tetrahedra"],
            "bytes": record["bytes"],
            "pipe": record["pipe"]["seconds"],
            "pipe_file": record.get("pipe_file", {}).get("seconds"),
            "null": record["null"].get("seconds"),
            "file": record.get("file", {}).get("seconds"),
            "memory": sum(record["memory_of"]),
            "memory_rotassemble": record["memory_of"][-1],
            "stages": stages,
        })
    for points in series.values():
        points.sort(key=lambda p: p["x"])
    return series


def shares(lines):
    """Where the time goes: per stage, and in the mesher, of one body of each order in two sizes."""
    found = []
    for record in lines:
        if record["kind"] != "scaling" or "failure" in record or not record["series"].startswith("share-"):
            continue
        last = record.get("file", record["null"])
        if "failure" in last or "failure" in record["pipe"]:
            continue
        stages = {s: m["seconds"] for s, m in record["stages"].items()}
        found.append({
            "order": int(record["series"].removeprefix("share-")),
            "tetrahedra": record["tetrahedra"],
            "stages": {**stages, "rotassemble": last["seconds"]},
            "mesher": record["mesher_seconds"],
            "pipe": record["pipe"]["seconds"],
            "pipe_file": record.get("pipe_file", {}).get("seconds"),
        })
    return sorted(found, key=lambda s: (s["order"], s["tetrahedra"]))


def exponents(points):
    """Of the pipe and of every stage: over all points, and over the upper half."""
    def both(values):
        return fit(values), fit(values[len(values) // 2 - 1 if len(values) < 4 else len(values) // 2 :])

    found = {"pipe": both([(p["x"], p["pipe"]) for p in points])}
    for stage in contestants.STAGES:
        found[stage] = both([(p["x"], p["stages"][stage]) for p in points if stage in p["stages"]])
    return found


def mean_histograms(cells):
    """Mean share per bin over the cells where everybody has a mesh; each cell weighs the same."""
    wanted = {
        "direct": lambda c: c["direct"].get("default", {}),
        "pipe": lambda c: c["pipe"].get("default", {}),
    }
    have = lambda summary: (summary.get("quality") or {}).get("histograms")
    usable = [c for c in cells if c["category"] in "ABC" and all(have(get(c)) for get in wanted.values())]
    if not usable:
        return None, 0
    means = {}
    for title, get in wanted.items():
        means[title] = {}
        for metric in quality.BINS:
            columns = zip(*(have(get(c))[metric] for c in usable))
            means[title][metric] = [sum(column) / len(usable) for column in columns]
    return means, len(usable)


def write(lines, folder):
    """All files of the report."""
    header = next((r for r in lines if r["kind"] == "header"), None)
    latest = {r["key"]: r for r in lines if r["kind"] == "cell"}
    cells = list(latest.values())
    rows = [flat(c) for c in cells]
    table, series = aggregate(rows), scaling(lines)
    fits = {name: exponents(points) for name, points in series.items() if len(points) > 1}

    def save(name, text):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)

    pictures = []
    if rows:
        with open(os.path.join(folder, "cells.csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
        practical = [(r["speedup"] or r["speedup_at_least"], not r["speedup"]) for r in rows if r["category"] == "P"]
        save("speedup-order.svg", plots.speedup_by_order(table, [p for p in practical if p[0]]))
        save("speedup-elements.svg", plots.speedup_by_elements(rows))
        pictures += ["speedup-order.svg", "speedup-elements.svg"]
        means, number = mean_histograms(cells)
        if means:
            save("quality.svg", plots.quality_histograms(means))
            pictures.append("quality.svg")
    if any(len(points) > 1 for points in series.values()):
        shown = {name: (SERIES[name], points) for name, points in series.items() if len(points) > 1}
        save("scaling.svg", plots.scaling(shown))
        pictures.append("scaling.svg")
    data = {"header": header, "table": table, "scaling": series, "shares": shares(lines), "exponents": fits, "cells": rows}
    # One line per entry, so that versions can be compared.
    entry = lambda value: ",\n".join(json.dumps(v) for v in value)
    parts = [f'"{k}": [\n{entry(v)}\n]' if isinstance(v, list) else f'"{k}": {json.dumps(v)}' for k, v in data.items()]
    save("results.json", "{\n" + ",\n".join(parts) + "\n}\n")
    save("README.md", markdown.page(header, rows, table, series, data["shares"], fits, pictures))

"""The report as a Markdown page."""

import cells
from cells import TITLES
from contestants import STAGES

CAPTIONS = {
    "speedup-order.svg": "Time of the direct mesh over time of the pipe, against order: geometric mean, band from minimum to maximum",
    "speedup-elements.svg": "The same for every cell, against the number of elements",
    "quality.svg": "Quality of the elements, mean over the cells",
    "scaling.svg": "Time of the pipe and of its stages",
}


def number(value, form=".1f"):
    return "-" if value is None else format(value, form)


def spread(value, form=".1f"):
    if value is None:
        return "-"
    return f"{value['min']:{form}} / **{value['geomean']:{form}}** / {value['max']:{form}}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    cell = lambda value: str(value).replace("|", "\\|")
    return lines + ["| " + " | ".join(map(cell, row)) + " |" for row in rows] + [""]


def unfinished(header, rows):
    """What is missing, in words."""
    whole = len(cells.quick() if header["sets"] == "quick" else cells.full())
    return "" if len(rows) >= whole else f", of {whole} cells"


def introduction(header, rows):
    machine = header["machine"]
    busy = [r for r in rows if (r["cpu_seconds_direct"] or 0) < 0.9 * (r["seconds_direct"] or 0) and r["seconds_direct"] > 0.2]
    lines = [
        "# Benchmark results",
        "",
        f"{machine['processor']}, {machine['cores']} cores, {machine['memory_gib']} GiB, {machine['system']}, "
        f"kernel {machine['kernel']}; TetGen {machine['tetgen']}; binaries {header['binaries']}. "
        f"{len(rows)} cells ({header['sets']} table{unfinished(header, rows)}).",
        "",
        "Pipe: `symdetect body.stl | wedgecut --radius-edge R --max-volume V | tetwedge --radius-edge R --min-dihedral D "
        "--max-volume V | rotassemble > body.vtk`, whole processes, from an STL file of the body turned and shifted at random to a VTK "
        "file of the whole mesh. Direct: `tetgen -pqR/DaVA body.poly`, the body with its axis on z, TetGen's usual output. "
        "Wall time, medians of alternating runs. Speed-up: direct over pipe, its mean over the sets geometric. "
        f"Direct runs of more than {header['limit']:g} s (practical via in the full table: 3600 s) count as failed.",
        "",
    ]
    ahead = sum(r["direct_ahead"] for r in rows)
    if ahead:
        lines += [
            f"In {ahead} cells the direct run, of two seconds and more, was made ahead of the pipe's, not in turn with them.",
            "",
        ]
    if busy:
        lines += [
            f"**In {len(busy)} of {len(rows)} cells the direct run had less than 90 % of a processor: "
            "the machine was busy with something else, and these times are unreliable.**",
            "",
        ]
    return lines


def main_table(groups):
    head = [
        "category", "order", "sets", "speed-up min / mean / max", "without direct's output", "elements over direct's",
        "1st percentile of the smallest dihedral, worst gain", "its minimum, worst gain",
        "past radius-edge bound, worst: pipe (direct); more than direct in", "failed: pipe, direct", "checks passed",
    ]
    rows = []
    for g in groups:
        bound = g["speedup_at_least"]
        rows.append([
            TITLES[g["category"]], g["order"], g["sets"],
            spread(g["speedup"]) + (f" (over the limit: at least {bound['min']:.0f})" if bound else ""),
            spread(g["speedup_without_output"]), spread(g["count_ratio"], ".2f"),
            number(g["p01_gain"], "+.2f"), number(g["min_gain"], "+.2f"),
            f"{number(percent(g['violations_pipe']), '.3f')} % ({number(percent(g['violations_direct']), '.3f')} %)"
            f"; {g['violations_more']}",
            f"{g['pipe_failed']}, {g['direct_failed']}", f"{g['checks_passed']} of {g['sets']}",
        ])
    return table(head, rows)


def percent(share):
    return None if share is None else 100 * share


def variants(groups, rows):
    head = [
        "category", "order", "speed-up as it comes (130)", "off", "as it comes over direct with -o/130",
        "elements over those of direct with -o/130", "1st percentile: direct, direct with -o/130, pipe off, as it comes",
    ]
    body = []
    for g in groups:
        if not g["speedup_off"]:
            continue
        mine = [r for r in rows if (r["category"], r["order"]) == (g["category"], g["order"])]
        mean = lambda name: average([r[f"p01_dihedral_{name}"] for r in mine])
        angles = [number(mean(n)) for n in ("direct", "direct_130", "pipe_off", "pipe")]
        body.append([
            TITLES[g["category"]], g["order"], spread(g["speedup"]), spread(g["speedup_off"]),
            spread(g["speedup_130_both"]), spread(g["count_ratio_130_both"], ".2f"), ", ".join(angles),
        ])
    note = "Direct with -o/130: one set of parameters, the middle one."
    return ["## Optimization of dihedral angles (`--optimize`)", "", note, "", *table(head, body)] if body else []


def average(values):
    values = [v for v in values if v is not None]
    return sum(values) / len(values) if values else None


def stages(groups, rows):
    head = ["category", "order", *(f"{s}, ms" for s in STAGES), "TetGen in tetwedge, ms", "all but TetGen", "pipe, ms", "direct, ms", "memory: pipe, direct, MiB"]
    body = []
    for g in groups:
        mine = [r for r in rows if (r["category"], r["order"]) == (g["category"], g["order"])]
        mean = lambda name: average([r[name] for r in mine])
        ms = lambda name: number(None if mean(name) is None else 1e3 * mean(name))
        parts = [mean(f"stage_{s}") for s in STAGES]
        rest = None if None in parts or mean("stage_mesher") is None else 1 - mean("stage_mesher") / sum(parts)
        memory = [number(None if mean(f"memory_{n}") is None else mean(f"memory_{n}") / 2**20, ".0f") for n in ("pipe", "direct")]
        body.append([
            TITLES[g["category"]], g["order"], *(ms(f"stage_{s}") for s in STAGES), ms("stage_mesher"),
            number(percent(rest), ".0f") + " %", ms("seconds_pipe"), ms("seconds_direct"), ", ".join(memory),
        ])
    return [
        "## Stages", "",
        "Each alone, from file to file, means over the sets. In the pipe, stages overlap. Memory of the pipe: sum of the "
        "peaks of its four processes.", "", *table(head, body),
    ]


def hxt(groups, rows):
    body = []
    for g in groups:
        mine = [r for r in rows if (r["category"], r["order"]) == (g["category"], g["order"]) and r["seconds_hxt"]]
        if mine:
            mean = lambda name: average([r[name] for r in mine])
            body.append([
                TITLES[g["category"]], g["order"], number(mean("seconds_hxt"), ".2f"), number(mean("seconds_pipe"), ".2f"),
                number(mean("tets_hxt"), ",.0f"), number(mean("tets_pipe"), ",.0f"),
                number(mean("p01_dihedral_hxt")), number(mean("p01_dihedral_pipe")),
            ])
    if not body:
        return ["Gmsh's HXT was not measured: it is optional (`--hxt`).", ""]
    head = ["category", "order", "HXT, s", "pipe, s", "elements HXT", "pipe", "1st percentile HXT", "pipe"]
    return ["## Gmsh's HXT", "", "Whole process, geometry and surface mesh included. It has no bounds on the shape of elements.", "", *table(head, body)]


def scaling(series, fits):
    if not fits:
        return []
    lines = ["## Scaling", "", "Exponents of time, over all points and over the upper half of them:", ""]
    rows = []
    for name, found in fits.items():
        pair = lambda who: ", ".join(number(v, ".2f") for v in found[who])
        rows.append([name, pair("pipe"), *(pair(s) for s in STAGES)])
    lines += table(["against", "pipe", *STAGES], rows)
    head = [
        "series", "order or triangles", "tetrahedra", "file, MB", "pipe to /dev/null, s", "pipe to file, s",
        "rotassemble to /dev/null, MB/s", "to file, MB/s", "memory of the pipe, MiB", "of rotassemble",
    ]
    rate = lambda p, where: number(p["bytes"] / p[where] / 1e6 if p[where] else None, ".0f")
    rows = [
        [
            name, "128" if name == "output" else f"{p['x']:,}", f"{p['tetrahedra']:,}", number(p["bytes"] / 1e6),
            number(p["pipe"], ".3f"), number(p["pipe_file"], ".3f"), rate(p, "null"), rate(p, "file"),
            number(p["memory"] / 2**20, ".0f"), number(p["memory_rotassemble"] / 2**20, ".0f"),
        ]
        for name, points in series.items()
        for p in points
    ]
    return lines + table(head, rows)


def shares(found):
    """Where the time goes in large meshes."""
    if not found:
        return []
    head = [
        "order of the body", "tetrahedra", *(f"{s}, s" for s in STAGES), "TetGen in tetwedge, s", "all but TetGen",
        "pipe to /dev/null, s", "pipe to file, s",
    ]
    rows = []
    for f in found:
        parts = [f["stages"][s] for s in STAGES]
        rest = 100 * (1 - f["mesher"] / sum(parts))
        rows.append([
            f["order"], f"{f['tetrahedra']:,}", *(number(t, ".3f") for t in parts), number(f["mesher"], ".3f"),
            f"{rest:.0f} %", number(f["pipe"], ".3f"), number(f["pipe_file"], ".3f"),
        ])
    text = (
        "A coated ring, stages alone, from file to file. TetGen meshes one wedge, everything that is written comes out "
        "of `rotassemble`: the higher the order, the less there is for TetGen."
    )
    return ["", "## Where the time goes in large meshes", "", text, "", *table(head, rows)]


def failures(rows):
    found = [(r["key"], who, r[f"failure_{who}"]) for r in rows for who in ("pipe", "pipe_off", "direct", "direct_130", "hxt") if r[f"failure_{who}"]]
    if not found:
        return ["No run failed.", ""]
    return ["## Failures", "", "Cells are category, order, radius-edge, dihedral, volume.", "", *table(["cell", "who", "what"], found)]


def page(header, rows, groups, series, large, fits, pictures):
    """The page's text."""
    lines = introduction(header, rows)
    for name in pictures:
        lines += [f"![{CAPTIONS[name]}]({name})", ""]
    if rows:
        lines += ["## Table", "", *main_table(groups), *variants(groups, rows), *stages(groups, rows), *hxt(groups, rows), *failures(rows)]
    return "\n".join(lines + scaling(series, fits) + shares(large)).rstrip() + "\n"

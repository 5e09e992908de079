"""The benchmark's plots."""

import quality
import svg
from cells import ORDERS, TITLES

COLOURS = {"A": "#6b7280", "B": "#1d6fb8", "C": "#d9480f", "P": "#2b8a3e"}
STAGE_COLOURS = {"symdetect": "#1d6fb8", "wedgecut": "#2b8a3e", "tetwedge": "#d9480f", "rotassemble": "#9c36b5"}


def speedup_by_order(table, practical):
    """Speed-up against order: geometric mean, with a band from minimum to maximum."""
    rows = [r for r in table if r["category"] in "ABC" and r["speedup"]]
    values = [r["speedup"][k] for r in rows for k in ("min", "max")]
    values += [v for v, _ in practical] + [1.0]
    panel = svg.Panel(
        (70, 40, 560, 380), (3.5, 146), svg.around(values), "Pipe against direct mesh, whole processes",
        "order of the rotation", "times faster", ORDERS,
    )
    panel.line([(3.5, 1), (146, 1)], "#888", "4 3")
    for category in "ABC":
        mine = [r for r in rows if r["category"] == category]
        get = lambda what: [(r["order"], r["speedup"][what]) for r in mine]
        if mine:
            panel.band(get("min"), get("max"), COLOURS[category])
            panel.line(get("geomean"), COLOURS[category])
            panel.dots(get("geomean"), COLOURS[category])
    for value, bound in practical:
        panel.dots([(24, value)], COLOURS["P"], 5)
        if bound:
            panel.text(panel.x.at(24) + 8, panel.y.at(value) + 4, "at least")
    shown = [c for c in "ABC" if any(r["category"] == c for r in rows)] + ["P"] * bool(practical)
    panel.legend([(COLOURS[c], TITLES[c]) for c in shown], 84, 480)
    return svg.picture(660, 550, [panel])


def speedup_by_elements(cells):
    """Speed-up of every cell against the direct mesh's number of elements."""
    points = {c: [(x["tets_direct"], x["speedup"]) for x in cells if x["category"] == c and x["speedup"] and x["tets_direct"]] for c in "ABCP"}
    flat = [p for group in points.values() for p in group]
    panel = svg.Panel(
        (70, 40, 560, 380), svg.around([x for x, _ in flat]), svg.around([y for _, y in flat] + [1.0]),
        "Pipe against direct mesh, every cell", "elements of the direct mesh", "times faster",
    )
    panel.line([(panel.x.low, 1), (panel.x.high, 1)], "#888", "4 3")
    for category, group in points.items():
        panel.dots(group, COLOURS[category], 3, 0.6)
    panel.legend([(COLOURS[c], TITLES[c]) for c in "ABCP" if points[c]], 84, 480)
    return svg.picture(660, 550, [panel])


NAMES = {
    "min_dihedral_deg": "smallest dihedral angle, degrees",
    "max_dihedral_deg": "largest dihedral angle, degrees",
    "radius_edge_ratio": "radius-edge ratio",
}


def quality_histograms(means):
    """Histograms over all runs side by side; `means`: title to metric to share per bin."""
    panels, width, height = [], 250, 150
    for row, (metric, (first, last, number)) in enumerate(quality.BINS.items()):
        edges = [first + (last - first) * k / number for k in range(number + 1)]
        top = 1.1 * max(100 * max(m[metric]) for m in means.values())
        for column, (title, mean) in enumerate(means.items()):
            box = (60 + column * (width + 55), 40 + row * (height + 70), width, height)
            panel = svg.Panel(
                box, (first, last), (0, top), title if row == 0 else "", NAMES[metric],
                "% of elements" if column == 0 else "", log=(False, False),
            )
            panel.bars(edges, [100 * share for share in mean[metric]], "#6b7280" if "direct" in title else "#1d6fb8")
            panels.append(panel)
    return svg.picture(60 + len(means) * (width + 55), 40 + 3 * (height + 70), panels)


def scaling(series):
    """Time against order, triangles and elements; `series`: name to (label, points)."""
    panels = []
    for column, (_, (label, points)) in enumerate(series.items()):
        if not points:
            continue
        times = [p["pipe"] for p in points] + [s for p in points for s in p["stages"].values()]
        box = (70 + column * 370, 40, 290, 300)
        panel = svg.Panel(box, svg.around([p["x"] for p in points]), svg.around(times), "", label, "seconds")
        panel.line([(p["x"], p["pipe"]) for p in points], "#222")
        panel.dots([(p["x"], p["pipe"]) for p in points], "#222")
        for stage, colour in STAGE_COLOURS.items():
            line = [(p["x"], p["stages"][stage]) for p in points if stage in p["stages"]]
            panel.line(line, colour, "5 3")
        panels.append(panel)
    if panels:
        panels[0].legend([("#222", "pipe"), *((c, s) for s, c in STAGE_COLOURS.items())], 84, 405)
    return svg.picture(70 + 370 * len(series), 490, panels)

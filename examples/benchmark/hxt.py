"""Meshes a whole body with Gmsh's HXT: `hxt.py CATEGORY ORDER MAX_VOLUME OUTPUT`.

Gmsh takes sizes, not bounds on the shape of elements, and does not refine surfaces for thin layers
by itself: so points of thin layers get twice the thickness, about what refinement for shape leads to,
and all other points the edge of a regular tetrahedron of the volume. All processors are used.
"""

import math
import os
import sys

import gmsh

from cells import THICKNESS

# Circumradii of the concentric polygons from outside in; whether the innermost is a hole.
BODIES = {"A": ((1.0,), False), "B": ((1.0, 0.5, 0.5), True), "C": ((1.0, 0.2, 0.2), False)}


def mesh(category, order, volume, output):
    radii, hole = BODIES[category]
    radii = list(radii)
    if len(radii) == 3:
        radii[1] += THICKNESS / math.cos(math.pi / order)
    edge = (6 * math.sqrt(2) * volume) ** (1 / 3)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", len(os.sched_getaffinity(0)))
    gmsh.option.setNumber("Mesh.Algorithm3D", 10)
    geo = gmsh.model.geo
    loops = []
    for k, radius in enumerate(radii):
        size = edge if k == 0 else min(edge, 2 * THICKNESS)
        angles = [2 * math.pi * j / order for j in range(order)]
        points = [geo.addPoint(radius * math.cos(a), radius * math.sin(a), 0, size) for a in angles]
        lines = [geo.addLine(p, q) for p, q in zip(points, points[1:] + points[:1])]
        loops.append(geo.addCurveLoop(lines))
    sections = [geo.addPlaneSurface([outer, inner]) for outer, inner in zip(loops, loops[1:])]
    if not hole:
        sections.append(geo.addPlaneSurface([loops[-1]]))
    geo.extrude([(2, s) for s in sections], 0, 0, 1)
    geo.removeAllDuplicates()
    geo.synchronize()
    for _, tag in gmsh.model.getEntities(3):
        gmsh.model.addPhysicalGroup(3, [tag])
    gmsh.model.mesh.generate(3)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.write(output)
    gmsh.finalize()


if __name__ == "__main__":
    mesh(sys.argv[1], int(sys.argv[2]), float(sys.argv[3]), sys.argv[4])

#!/usr/bin/env python3
"""A thick cylinder under pressure against Lame's solution: how fast elements of either order converge.

    python3 examples/convergence/lame.py --bin target/release/

needs CalculiX (`ccx`, package calculix-ccx on Debian) and the generator of bodies (`cargo build --release -p body`). The
ring is drawn with 16, 32, ... facets and meshed with edges half as long each time; one sector between mirror planes is
solved in plane strain, and the table has the root of the mean squared error of the radial displacement over all nodes, relative to
that of the bore.
"""
import argparse
import math
import os
import subprocess
import tempfile

BORE, RADIUS, YOUNG, POISSON = 0.4, 1.0, 1000.0, 0.3
KINDS = {
    'first order': [],
    'second, straight edges': ['--second-order', '--straight-edges'],
    'second, on the shape': ['--second-order'],
}
# Corners of the faces of a tetrahedron, in CalculiX's numbering.
FACES = [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)]


def displacement(r):
    """Radial displacement in plane strain under the pressure 1 in the bore (Lame, 1852)."""
    stress = BORE**2 / (RADIUS**2 - BORE**2)
    return (1 + POISSON) / YOUNG * stress * ((1 - 2 * POISSON) * r + RADIUS**2 / r)


def deck(path):
    """Nodes, and number and nodes of each tetrahedron, of an INP file."""
    nodes, elements, into, line = {}, [], None, []
    for text in open(path):
        if text.startswith('*'):
            key = text.upper()
            into = 'node' if key.startswith('*NODE') else 'element' if 'TYPE=C3D' in key.replace(' ', '') else None
            continue
        line += [word for word in text.replace(',', ' ').split()]
        if text.rstrip().endswith(','):
            continue
        if into == 'node':
            nodes[int(line[0])] = tuple(map(float, line[1:4]))
        elif into == 'element':
            elements.append((line[0], list(map(int, line[1:]))))
        line = []
    return nodes, elements


def job(nodes, elements):
    """What CalculiX is to do with the sector."""
    used = {}
    for number, element in elements:
        for face, corners in enumerate(FACES, 1):
            key = tuple(sorted(element[i] for i in corners))
            used.setdefault(key, []).append(f'{number}, P{face}, 1.')
    in_bore = lambda v: math.hypot(*nodes[v][:2]) < 1.001 * BORE
    pressed = [u[0] for face, u in used.items() if len(u) == 1 and all(map(in_bore, face))]
    heights = [p[2] for p in nodes.values()]
    at_end = lambda z: min(abs(z - min(heights)), abs(z - max(heights))) < 1e-6
    ends = [str(v) for v, p in nodes.items() if at_end(p[2])]
    return '\n'.join([
        '*INCLUDE, INPUT=sector.inp', '*NSET, NSET=ends', *ends,
        '*MATERIAL, NAME=steel', '*ELASTIC', f'{YOUNG}, {POISSON}',
        '*SOLID SECTION, ELSET=all-elements, MATERIAL=steel',
        '*STEP', '*STATIC', '*BOUNDARY', 'ends, 3, 3', '*DLOAD', *pressed,
        '*NODE PRINT, NSET=all-nodes', 'U', '*END STEP', ''])


def error(mesh, options, folder, arguments):
    """Error of the mesh and its number of nodes."""
    rotassemble = [arguments.bin + 'rotassemble', '-q', mesh, '--sector', '--mirror', 'symmetric', *options]
    subprocess.run([*rotassemble, '-o', f'{folder}/sector.inp'], check=True)
    nodes, elements = deck(f'{folder}/sector.inp')
    with open(f'{folder}/job.inp', 'w') as file:
        file.write(job(nodes, elements))
    subprocess.run([arguments.ccx, 'job'], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    squares = []
    for line in open(f'{folder}/job.dat'):
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            x, y, _ = nodes[int(words[0])]
            r = math.hypot(x, y)
            radial = (float(words[1]) * x + float(words[2]) * y) / r
            squares.append((radial - displacement(r))**2)
    return math.sqrt(sum(squares) / len(squares)) / displacement(BORE), len(nodes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('--bin', default='', help='folder of the tools, with a slash')
    parser.add_argument('--ccx', default='ccx', help='CalculiX')
    parser.add_argument('--steps', type=int, default=3, help='number of meshes')
    arguments = parser.parse_args()
    last = {}
    with tempfile.TemporaryDirectory() as folder:
        for step in range(arguments.steps):
            facets, edge, mesh = 16 * 2**step, 0.4 / 2**step, os.path.join(folder, 'ring.tmesh')
            pipe = (f'{arguments.bin}body prism --order {facets} --bore {BORE}'
                    f' | {arguments.bin}symdetect -q'
                    f' | {arguments.bin}wedgecut -q --order 8 --horizontal-mirror off --edge-length {edge}'
                    f' | {arguments.bin}tetwedge -q -o {mesh}')
            subprocess.run(pipe, shell=True, check=True)
            for kind, options in KINDS.items():
                found, nodes = error(mesh, options, folder, arguments)
                order = f'{math.log2(last[kind] / found):.2f}' if kind in last else ''
                print(f'{facets:4} facets  {kind:24}{nodes:8} nodes  error {found:.2e}  {order}', flush=True)
                last[kind] = found


main()

#!/usr/bin/env python3
"""A thick cylinder and a thick sphere under pressure against Lame's solutions: how fast elements of either order converge.

    python3 examples/convergence/lame.py --bin target/release/

needs CalculiX (`ccx`, package calculix-ccx on Debian) and the generator of bodies (`cargo build --release -p body`). The
bodies are drawn with 16, 32, ... facets around, which are kept, and meshed with edges half as long each time; one sector between mirror
planes is solved, the cylinder's in plane strain, and the table has the root of the mean squared error of the radial
displacement over all nodes, relative to that of the bore.
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


def of_cylinder(r):
    """Radial displacement in plane strain under the pressure 1 in the bore (Lame, 1852)."""
    stress = BORE**2 / (RADIUS**2 - BORE**2)
    return (1 + POISSON) / YOUNG * stress * ((1 - 2 * POISSON) * r + RADIUS**2 / r)


def of_sphere(r):
    """Radial displacement under the pressure 1 in the hollow (Lame, 1852)."""
    stress = BORE**3 / (RADIUS**3 - BORE**3)
    return stress / YOUNG * ((1 - 2 * POISSON) * r + (1 + POISSON) * RADIUS**3 / (2 * r**2))


def draw_cylinder(facets, path, arguments):
    """Draws the thick cylinder."""
    command = [arguments.bin + 'body', 'prism', '--order', str(facets), '--bore', str(BORE), '-o', path, '--to', 'tmesh']
    subprocess.run(command, check=True)


def draw_sphere(facets, path, _):
    """Draws the hollow sphere by meridians and parallels."""
    rows = facets // 2

    def at(radius, row, column):
        up, around = math.pi * row / rows, 2 * math.pi * (column % facets) / facets
        across = math.sin(up) if 0 < row < rows else 0.
        return radius * across * math.cos(around), radius * across * math.sin(around), radius * math.cos(up)

    with open(path, 'w') as file:
        file.write('solid ball\n')
        for radius, turn in [(RADIUS, 1), (BORE, -1)]:
            for row in range(rows):
                for column in range(facets):
                    a, b = at(radius, row, column), at(radius, row, column + 1)
                    c, d = at(radius, row + 1, column + 1), at(radius, row + 1, column)
                    for corners in [(a, d, c)] * (row < rows - 1) + [(a, c, b)] * (row > 0):
                        # Below the pole and above the other one a triangle has the corner that is left.
                        corners = [a, d, c] if row == 0 else [a, d, b] if row == rows - 1 else corners
                        file.write('facet normal 0 0 0\nouter loop\n')
                        for p in corners[::turn]:
                            file.write('vertex %.17g %.17g %.17g\n' % p)
                        file.write('endloop\nendfacet\n')
        file.write('endsolid\n')


def at_ends(heights):
    """The heights of the faces of the cylinder."""
    return [min(heights), max(heights)]


def at_equator(_):
    """The height of the plane that a sphere stays symmetric about."""
    return [0.]


# How the body is drawn and cut, in how many dimensions points are away from its middle, its solution, and where nothing
# moves along the axis.
BODIES = {
    'cylinder': (draw_cylinder, '--order 8 --horizontal-mirror off', 2, of_cylinder, at_ends),
    'sphere': (draw_sphere, '--order 8 --hub none', 3, of_sphere, at_equator),
}


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


def job(nodes, elements, dimensions, held):
    """What CalculiX is to do with the sector."""
    used = {}
    for number, element in elements:
        for face, corners in enumerate(FACES, 1):
            key = tuple(sorted(element[i] for i in corners))
            used.setdefault(key, []).append(f'{number}, P{face}, 1.')
    in_bore = lambda v: math.hypot(*nodes[v][:dimensions]) < 1.001 * BORE
    pressed = [u[0] for face, u in used.items() if len(u) == 1 and all(map(in_bore, face))]
    heights = held([p[2] for p in nodes.values()])
    still = [str(v) for v, p in nodes.items() if min(abs(p[2] - z) for z in heights) < 1e-6]
    return '\n'.join([
        '*INCLUDE, INPUT=sector.inp', '*NSET, NSET=still', *still,
        '*MATERIAL, NAME=steel', '*ELASTIC', f'{YOUNG}, {POISSON}',
        '*SOLID SECTION, ELSET=all-elements, MATERIAL=steel',
        '*STEP', '*STATIC', '*BOUNDARY', 'still, 3, 3', '*DLOAD', *pressed,
        '*NODE PRINT, NSET=all-nodes', 'U', '*END STEP', ''])


def error(body, mesh, options, folder, arguments):
    """Error of the mesh and its number of nodes."""
    _, _, dimensions, displacement, held = BODIES[body]
    rotassemble = [arguments.bin + 'rotassemble', '-q', mesh, '--sector', '--mirror', 'symmetric', *options]
    subprocess.run([*rotassemble, '-o', f'{folder}/sector.inp'], check=True)
    nodes, elements = deck(f'{folder}/sector.inp')
    with open(f'{folder}/job.inp', 'w') as file:
        file.write(job(nodes, elements, dimensions, held))
    subprocess.run([arguments.ccx, 'job'], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    squares = []
    for line in open(f'{folder}/job.dat'):
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            place = nodes[int(words[0])][:dimensions]
            r = math.hypot(*place)
            radial = sum(float(u) * x for u, x in zip(words[1:], place)) / r
            squares.append((radial - displacement(r))**2)
    return math.sqrt(sum(squares) / len(squares)) / displacement(BORE), len(nodes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('--bin', default='', help='folder of the tools, with a slash')
    parser.add_argument('--ccx', default='ccx', help='CalculiX')
    parser.add_argument('--steps', type=int, default=3, help='number of meshes')
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for body, (draw, cut, *_) in BODIES.items():
            last = {}
            for step in range(arguments.steps):
                facets, edge = 16 * 2**step, 0.4 / 2**step
                drawn, mesh = os.path.join(folder, 'drawn'), os.path.join(folder, 'mesh.tmesh')
                draw(facets, drawn, arguments)
                pipe = (f'{arguments.bin}symdetect -q {drawn}'
                        f' | {arguments.bin}wedgecut -q {cut} --edge-length {edge} --deviation 0'
                        f' | {arguments.bin}tetwedge -q -o {mesh}')
                subprocess.run(pipe, shell=True, check=True)
                for kind, options in KINDS.items():
                    found, nodes = error(body, mesh, options, folder, arguments)
                    order = f'{math.log2(last[kind] / found):.2f}' if kind in last else ''
                    print(f'{body:10}{facets:4} facets  {kind:24}{nodes:8} nodes  error {found:.2e}  {order}',
                          flush=True)
                    last[kind] = found


main()

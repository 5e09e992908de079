"""Reads meshes for solvers with other programs' readers and prints what each holds as JSON.

    su2 FILE           meshio
    unv FILE           Gmsh, and the groups as they are listed
    polymesh CASE      VTK's reader of OpenFOAM cases, and the lists of faces as they are
"""

import json
import os
import re
import sys

import numpy as np


def volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum('ij,ij->i', np.cross(b - a, c - a), d - a) / 6


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def su2(path):
    import meshio
    mesh = meshio.read(path)
    with open(path) as text:
        names = re.findall(r'MARKER_TAG= (\S+)', text.read())
    tets = mesh.cells_dict['tetra']
    v = volumes(mesh.points, tets)
    found = {}
    for block, tags in zip(mesh.cells, mesh.cell_data['su2:tag']):
        if block.type == 'triangle':
            for tag in np.unique(tags):
                found[names[tag - 1]] = float(areas(mesh.points, block.data[tags == tag]).sum())
    return {'points': len(mesh.points), 'tetrahedra': len(tets), 'volume': float(v.sum()), 'least': float(v.min()),
            'areas': found}


def unv(path):
    import gmsh
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber('General.Terminal', 0)
    gmsh.merge(path)
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    points = np.zeros((int(max(tags)) + 1, 3))
    points[np.array(tags, int)] = np.array(xyz).reshape(-1, 3)

    def elements(dim, corners):
        types, _, nodes = gmsh.model.mesh.getElements(dim)
        assert len(types) == 1, types
        return np.array(nodes[0], int).reshape(-1, corners)
    tets, triangles = elements(3, 4), elements(2, 3)
    gmsh.finalize()
    v = volumes(points, tets)
    groups = {}
    with open(path) as file:
        lines = file.read().split('\n')
    at = lines.index('  2467') + 1
    elements = {}
    start = lines.index('  2412') + 1
    while lines[start] != '    -1':
        elements[int(lines[start].split()[0])] = [int(x) for x in lines[start + 1].split()]
        start += 2
    while lines[at] != '    -1':
        count = int(lines[at].split()[7])
        rows = lines[at + 2:at + 2 + (count + 1) // 2]
        words = np.array(' '.join(rows).split(), int).reshape(-1, 4)
        assert len(words) == count and np.all(words[:, 0] == 8)
        corners = np.array([elements[i] for i in words[:, 1]])
        size = volumes if corners.shape[1] == 4 else areas
        groups[lines[at + 1]] = float(size(points, corners).sum())
        at += 2 + len(rows)
    return {'points': len(tags), 'tetrahedra': len(tets), 'triangles': len(triangles), 'volume': float(v.sum()),
            'least': float(v.min()), 'groups': groups}


def listed(path):
    """The text of a list in a file, between its parentheses."""
    with open(path) as file:
        text = file.read().split('}', 1)[1]
    return text[text.index('(') + 1:text.rindex(')')]


def polymesh(case):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader
    folder = os.path.join(case, 'constant', 'polyMesh')
    os.makedirs(os.path.join(case, 'system'), exist_ok=True)
    with open(os.path.join(case, 'system', 'controlDict'), 'w') as file:
        file.write('FoamFile{version 2.0; format ascii; class dictionary; object controlDict;}\n'
                   'startTime 0;\nendTime 1;\ndeltaT 1;\nwriteControl timeStep;\nwriteInterval 1;\n')
    with open(os.path.join(case, 'case.foam'), 'w'):
        pass
    reader = vtkOpenFOAMReader()
    reader.SetFileName(os.path.join(case, 'case.foam'))
    reader.UpdateInformation()
    reader.EnableAllPatchArrays()
    reader.ReadZonesOn()
    reader.Update()
    blocks = {}

    def walk(block, name):
        if hasattr(block, 'GetNumberOfBlocks'):
            for i in range(block.GetNumberOfBlocks()):
                child = block.GetMetaData(i)
                inner = child.Get(block.NAME()) if child else str(i)
                if block.GetBlock(i):
                    walk(block.GetBlock(i), name + [inner])
        else:
            blocks['/'.join(name)] = block
    walk(reader.GetOutput(), [])
    grid = blocks['internalMesh']
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    v = volumes(points, cells)
    counts = {name: block.GetNumberOfCells() for name, block in blocks.items()}
    # What the reader does not check: both faces of a cyclic pair, corner by corner; normals out of the owner; order.
    exact = np.array(re.findall(r'[^\s()]+', listed(os.path.join(folder, 'points'))), float).reshape(-1, 3)
    faces = np.array(re.findall(r'3\((\d+) (\d+) (\d+)\)', listed(os.path.join(folder, 'faces'))), int)
    owner = np.array(listed(os.path.join(folder, 'owner')).split(), int)
    neighbour = np.array(listed(os.path.join(folder, 'neighbour')).split(), int)
    inner = len(neighbour)
    assert np.all(owner[:inner] < neighbour)
    keys = owner[:inner].astype(np.int64) * len(cells) + neighbour
    assert np.all(np.diff(keys) > 0), 'upper triangular order'
    sums, volume = np.zeros((len(cells), 3)), np.zeros(len(cells))
    a, b, c = (exact[faces[:, i]] for i in range(3))
    normals, middles = np.cross(b - a, c - a) / 2, (a + b + c) / 3
    for cell, sign, rows in ((owner, 1, slice(None)), (neighbour, -1, slice(0, inner))):
        np.add.at(sums, cell, sign * normals[rows])
        np.add.at(volume, cell, sign * np.einsum('ij,ij->i', normals[rows], middles[rows]) / 3)
    size = np.abs(normals).max()
    patches = {}
    text = listed(os.path.join(folder, 'boundary'))
    for name, body in re.findall(r'(\S+)\s*\{([^}]*)\}', text):
        entries = dict(re.findall(r'(\w+)\s+([^;]+);', body))
        start, count = int(entries['startFace']), int(entries['nFaces'])
        patches[name] = {'type': entries['type'], 'faces': count, 'start': start,
                         'area': float(np.linalg.norm(normals[start:start + count], axis=1).sum())}
        if entries['type'] == 'cyclic':
            vector = lambda key: np.array(entries[key].strip('()').split(), float)
            patches[name].update(other=entries['neighbourPatch'], axis=vector('rotationAxis'),
                                 centre=vector('rotationCentre'))
    worst = 0.0
    for name, patch in patches.items():
        if patch['type'] == 'cyclic':
            other = patches[patch['other']]
            assert other['other'] == name and other['faces'] == patch['faces']
            rows = np.arange(patch['faces'])
            here, there = faces[patch['start'] + rows], faces[other['start'] + rows][:, [0, 2, 1]]
            axis = patch['axis'] / np.linalg.norm(patch['axis'])
            p, q = (exact[f].reshape(-1, 3) - patch['centre'] for f in (here, there))
            worst = max(worst, float(np.abs(p @ axis - q @ axis).max()),
                        float(np.abs(np.linalg.norm(np.cross(p, axis), axis=1)
                                     - np.linalg.norm(np.cross(q, axis), axis=1)).max()))
            # One angle for all of them.
            u, w = p - np.outer(p @ axis, axis), q - np.outer(q @ axis, axis)
            far = np.linalg.norm(u, axis=1) > 1e-3 * np.linalg.norm(u, axis=1).max()
            angle = np.arctan2(np.einsum('ij,ij->i', np.cross(u, w), axis[None]), np.einsum('ij,ij->i', u, w))[far]
            worst = max(worst, float(np.ptp(angle)))
            patch['turn'] = float(angle.mean() / (2 * np.pi))
            patch.pop('axis'), patch.pop('centre')
    for patch in list(patches.values()):
        patch.pop('axis', None), patch.pop('centre', None)
    return {'points': len(points), 'tetrahedra': len(cells), 'volume': float(v.sum()), 'least': float(v.min()),
            'counts': counts, 'patches': patches, 'open': float(np.abs(sums).max() / size),
            'least_by_faces': float(volume.min()), 'volume_by_faces': float(volume.sum()), 'off': worst,
            'zones': re.findall(r'(\S+)\s*\{\s*type cellZone', listed(os.path.join(folder, 'cellZones')))}


if __name__ == '__main__':
    kind, path = sys.argv[1:]
    print(json.dumps({'su2': su2, 'unv': unv, 'polymesh': polymesh}[kind](path)))

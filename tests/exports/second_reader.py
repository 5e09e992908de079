"""Checks the reader in formats/tmesh/python; called by second_reader.rs with a task and files.

    same EXPANDED DOCUMENT       expanding the document gives what the other file holds, to the bit
    angles FILE                  rows k, n, bits of cosine and sine agree
    copy FROM TO                 reads and writes
    refused FILE...              each is refused; prints why
    libraries DOCUMENT           meshio, VTK, pyvista and the plugin find the same mesh; prints counts and volume as JSON
"""

import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '../../formats/tmesh/python'))
import tmesh  # noqa: E402


def bits(values):
    values = np.ascontiguousarray(values)
    return values.view(np.uint64) if values.dtype == float else values


def same(expected, path):
    whole = tmesh.read(expected)
    template = whole.templates[0]
    mesh = tmesh.expand(tmesh.read(path))
    for what, found, other in (
            ('points', mesh.points, template.vertices), ('tetrahedra', mesh.tets, template.tets),
            ('regions', mesh.regions, template.regions), ('triangles', mesh.triangles, template.triangles),
            ('markers', mesh.markers, template.markers), ('front', mesh.front, template.front),
            ('back', mesh.back, template.back)):
        assert np.array_equal(bits(found), bits(other)), f'{path}: {what} differ'
    print(len(mesh.points), len(mesh.tets), len(mesh.triangles))


def angles(path):
    rows = np.fromfile(path, '<u8').reshape(-1, 4)
    for k, n, cosine, sine in rows.tolist():
        found = np.array(tmesh.cos_sin(k, n)).view(np.uint64).tolist()
        assert found == [cosine, sine], f'{k}/{n}'
    print(len(rows))


def copy(source, target):
    tmesh.write(tmesh.read(source), target)


def refused(*paths):
    for path in paths:
        try:
            tmesh.read(path)
        except tmesh.TmeshError as error:
            print(os.path.basename(path), error)
        else:
            raise AssertionError(f'{path} is accepted')


def volume(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return float(np.einsum('ij,ij->i', np.cross(b - a, c - a), d - a).sum() / 6)


def libraries(path):
    import meshio
    import pyvista
    from vtkmodules.util.numpy_support import vtk_to_numpy
    import paraview_tmesh
    mesh = tmesh.expand(tmesh.read(path))
    tmesh.register_meshio()
    read = meshio.read(path)
    tets = read.cells_dict['tetra']
    result = {'meshio': [len(read.points), len(tets), volume(read.points, tets)]}
    sets = {}
    for name, blocks in read.cell_sets.items():
        sets[name] = [len(block) for block in blocks]
    result['sets'] = sets
    source = paraview_tmesh.TmeshReader()
    source.SetFileName(path)
    source.Update()
    grid = source.GetOutputDataObject(0)
    names = grid.GetFieldData().GetAbstractArray('region_names')
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    count = int((np.diff(vtk_to_numpy(grid.GetCells().GetOffsetsArray())) == 4).sum())
    result['vtk'] = [len(points), count, volume(points, cells[:4 * count].reshape(-1, 4))]
    result['names'] = [names.GetValue(i) for i in range(names.GetNumberOfValues())]
    source.SetBoundary(False)
    source.Update()
    assert source.GetOutputDataObject(0).GetNumberOfCells() == count
    whole = tmesh.to_pyvista(mesh, boundary=False)
    assert isinstance(whole, pyvista.UnstructuredGrid)
    result['pyvista'] = [whole.n_points, whole.n_cells, float(whole.volume)]
    print(json.dumps(result))


if __name__ == '__main__':
    tasks = {f.__name__: f for f in (same, angles, copy, refused, libraries)}
    tasks[sys.argv[1]](*sys.argv[2:])

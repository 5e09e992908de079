"""Reads mesh files with other programs' readers and prints what each holds as JSON.

Arguments: reader kind path, as often as wanted. Every volume, area and name is computed here from what
the reader delivers.
"""
import json, sys
import numpy as np


def volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return np.einsum('ij,ij->i', np.cross(b - a, c - a), d - a) / 6


def areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def total(values, labels, names):
    found = {}
    for label in np.unique(labels):
        if names is None or label in names:
            name = str(label) if names is None else names[label]
            found[name] = found.get(name, 0.0) + float(values[labels == label].sum())
    return found


def result(points, tets, regions, region_names, triangles, markers, marker_names):
    v = volumes(points, tets)
    return {
        'points': len(points), 'tetrahedra': len(tets), 'triangles': len(triangles),
        'least': float(v.min()) if len(v) else None,
        'volumes': total(v, regions, region_names),
        'areas': total(areas(points, triangles), markers, marker_names) if len(triangles) else {},
    }


def with_gmsh(path, kind):
    import gmsh
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber('General.Terminal', 0)
    gmsh.logger.start()
    gmsh.merge(path)
    bad = gmsh.logger.get()
    gmsh.logger.stop()
    bad = [m for m in bad if m.startswith(('Warning', 'Error'))]
    assert not bad, bad
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    points = np.zeros((int(max(tags)) + 1, 3))
    points[np.array(tags, int)] = np.array(xyz).reshape(-1, 3)
    def elements(dim, kinds):
        cells, labels, names = [], [], {}
        for d, entity in gmsh.model.getEntities(dim):
            physical = gmsh.model.getPhysicalGroupsForEntity(dim, entity)
            label = int(physical[0]) if len(physical) else -1
            if len(physical):
                names[label] = gmsh.model.getPhysicalName(dim, label)
            elif kind == 'mesh':
                # References become entities.
                label = entity
                names[label] = str(entity)
            types, _, nodes = gmsh.model.mesh.getElements(dim, entity)
            for t, n in zip(types, nodes):
                corners, per = kinds[int(t)]
                n = np.array(n, int).reshape(-1, per)[:, :corners]
                cells.append(n)
                labels.append(np.full(len(n), label))
        if not cells:
            return np.zeros((0, 4), int), np.zeros(0, int), {}
        return np.concatenate(cells), np.concatenate(labels), names
    tets, regions, rn = elements(3, {4: (4, 4), 11: (4, 10)})
    triangles, markers, mn = elements(2, {2: (3, 3), 9: (3, 6)})
    r = result(points, tets, regions, rn, triangles, markers, mn)
    r['points'] = len(tags)
    r['axis_edges'] = sum(len(n) // 2 for _, e in gmsh.model.getEntities(1)
                          for n in gmsh.model.mesh.getElements(1, e)[2])
    periodic = []
    for _, entity in gmsh.model.getEntities(2):
        master, nodes, masters, affine = gmsh.model.mesh.getPeriodicNodes(2, entity, True)
        if master == entity or len(nodes) == 0:
            continue
        m = np.array(affine).reshape(4, 4)
        low = points[np.array(masters, int)]
        high = points[np.array(nodes, int)]
        error = np.linalg.norm(low @ m[:3, :3].T + m[:3, 3] - high, axis=1).max()
        name = lambda e: gmsh.model.getPhysicalName(2, gmsh.model.getPhysicalGroupsForEntity(2, e)[0])
        periodic.append({'dependent': name(entity), 'master': name(master),
                         'pairs': len(nodes), 'error': float(error)})
    r['periodic'] = periodic
    r['size'] = float(np.linalg.norm(points[1:].max(axis=0) - points[1:].min(axis=0)))
    gmsh.finalize()
    return r


def with_meshio(path, kind):
    import meshio
    form = {'msh2': 'gmsh', 'msh': 'gmsh', 'mesh': 'medit', 'inp': 'abaqus', 'bdf': 'nastran',
            'node': 'tetgen'}.get(kind, kind)
    mesh = meshio.read(path, file_format=form)
    p = mesh.points
    def of(types):
        blocks = [(i, c.data) for i, c in enumerate(mesh.cells) if c.type in types]
        return blocks
    tb, fb = of(('tetra', 'tetra10')), of(('triangle', 'triangle6'))
    tets = np.concatenate([d[:, :4] for _, d in tb]) if tb else np.zeros((0, 4), int)
    tris = np.concatenate([d[:, :3] for _, d in fb]) if fb else np.zeros((0, 3), int)
    if kind == 'inp':
        region = np.full(len(tets), -1)
        names = {}
        offset, first = {}, 0
        for i, d in tb:
            offset[i] = first
            first += len(d)
        for k, (name, blocks) in enumerate(sorted(mesh.cell_sets.items())):
            if name.lower() == 'all-elements':
                continue
            names[k] = name
            for i, ids in enumerate(blocks):
                if i in offset and ids is not None:
                    region[offset[i] + np.array(ids, int)] = k
        assert (region >= 0).all()
        r = result(p, tets, region, names, tris, np.zeros(0, int), {})
        r['node_sets'] = {k: len(v) for k, v in mesh.point_sets.items()}
        return r
    def data(key, blocks):
        return np.concatenate([mesh.cell_data[key][i] for i, _ in blocks]).ravel() if blocks else np.zeros(0, int)
    if kind in ('msh', 'msh2'):
        names = {d: {int(v[0]): k for k, v in mesh.field_data.items() if v[1] == d} for d in (2, 3)}
        return result(p, tets, data('gmsh:physical', tb), names[3], tris, data('gmsh:physical', fb), names[2])
    if kind in ('vtu', 'vtk'):
        markers = data('marker', fb) if fb else np.zeros(0, int)
        return result(p, tets, data('region', tb), None, tris, markers, None)
    if kind == 'bdf':
        comments = [line.split(' ', 3)[1:] for line in open(path) if line.startswith(('$ PSOLID ', '$ PSHELL '))]
        names = {k: {int(n): name.strip() for card, n, name in comments if card == k} for k in ('PSOLID', 'PSHELL')}
        key = 'nastran:ref'
        return result(p, tets, data(key, tb), names['PSOLID'], tris, data(key, fb), names['PSHELL'])
    key = {'mesh': 'medit:ref', 'node': 'tetgen:ref'}[kind]
    return result(p, tets, data(key, tb), None, tris, data(key, fb), None)


def with_vtk(path, kind):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    reader = {'vtk': vtk.vtkUnstructuredGridReader, 'vtu': vtk.vtkXMLUnstructuredGridReader,
              'pvtu': vtk.vtkXMLPUnstructuredGridReader}[kind]()
    if kind == 'vtk':
        reader.ReadAllScalarsOn()
        reader.ReadAllFieldsOn()
    reader.SetFileName(path)
    reader.Update()
    g = reader.GetOutput()
    p = vtk_to_numpy(g.GetPoints().GetData()).astype(float)
    types = np.array([g.GetCellType(i) for i in range(g.GetNumberOfCells())])
    offsets = vtk_to_numpy(g.GetCells().GetOffsetsArray())
    conn = vtk_to_numpy(g.GetCells().GetConnectivityArray())
    ids = None
    if kind == 'pvtu':
        ids = vtk_to_numpy(g.GetPointData().GetGlobalIds())
        n = int(ids.max()) + 1
        merged = np.full((n, 3), np.nan)
        merged[ids] = p
        assert not np.isnan(merged).any()
        assert (merged[ids] == p).all(), 'copies of a point differ'
        p, conn = merged, ids[conn]
    def cells(kinds, k):
        at = np.flatnonzero(np.isin(types, kinds))
        return at, np.stack([conn[offsets[at] + i] for i in range(k)], axis=1) if len(at) else np.zeros((0, k), int)
    at, tets = cells((10, 24), 4)
    fat, tris = cells((5, 22), 3)
    data = lambda n: vtk_to_numpy(g.GetCellData().GetArray(n))
    field = g.GetFieldData()
    def names(n):
        a = field.GetArray(n)
        if a is None:
            return None
        return {int(a.GetComponent(0, i)): a.GetComponentName(i) for i in range(a.GetNumberOfComponents())}
    markers = data('marker')[fat] if len(fat) else np.zeros(0, int)
    r = result(p, tets, data('region')[at], names('region_names'), tris, markers, names('marker_names'))
    if kind == 'pvtu':
        faces = np.sort(np.concatenate([tets[:, c] for c in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])]), axis=1)
        _, counts = np.unique(faces, axis=0, return_counts=True)
        assert counts.max() <= 2
        r['boundary_faces'] = int((counts == 1).sum())
    return r


FACES = {'S1': (0, 1, 2), 'S2': (0, 3, 1), 'S3': (1, 3, 2), 'S4': (2, 3, 0)}


def with_manual(path):
    """Input of CalculiX, by its manual."""
    points, tets, regions, sets, surfaces, ties, model = {}, {}, {}, {}, {}, {}, None
    keyword, options = None, {}
    for line in open(path):
        line = line.strip()
        assert len(line) <= 132
        if line.startswith('**'):
            continue
        if line.startswith('*'):
            words = [w.strip() for w in line[1:].split(',')]
            keyword = words[0].upper()
            options = {k.strip().upper(): v.strip() for k, _, v in (w.partition('=') for w in words[1:])}
            continue
        values = [v.strip() for v in line.split(',') if v.strip()]
        if keyword == 'NODE':
            assert all(len(v) <= 20 for v in values), line
            points[int(values[0])] = [float(v) for v in values[1:]]
        elif keyword == 'ELEMENT':
            assert options['TYPE'] in ('C3D4', 'C3D10')
            tets[int(values[0])] = [int(v) for v in values[1:]]
            regions[int(values[0])] = options['ELSET']
        elif keyword == 'NSET':
            sets.setdefault(options['NSET'], []).extend(int(v) for v in values)
        elif keyword == 'SURFACE':
            surfaces.setdefault(options['NAME'], []).append((int(values[0]), values[1]))
        elif keyword == 'TIE':
            ties[options['NAME']] = values
        elif keyword == 'CYCLIC SYMMETRY MODEL':
            model = {'sectors': int(options['N']), 'tie': options['TIE'], 'axis': [float(v) for v in values]}
    n = len(points)
    assert sorted(points) == list(range(1, n + 1)) and sorted(tets) == list(range(1, len(tets) + 1))
    p = np.array([points[i + 1] for i in range(n)])
    t = np.array([tets[i + 1][:4] for i in range(len(tets))]) - 1
    names = sorted(set(regions.values()))
    labels = np.array([names.index(regions[i + 1]) for i in range(len(tets))])
    faces, markers, marker_names = [], [], sorted(surfaces)
    for name, sides in surfaces.items():
        nodes = {int(v) for e, f in sides for v in t[e - 1][list(FACES[f])] + 1}
        assert nodes <= set(sets[name]) and len(sets[name]) == len(set(sets[name]))
        for element, face in sides:
            faces.append(t[element - 1][list(FACES[face])])
            markers.append(marker_names.index(name))
    r = result(p, t, labels, dict(enumerate(names)), np.array(faces), np.array(markers), dict(enumerate(marker_names)))
    r.update(ties=ties, model=model, axis=len(sets.get('axis', [])), per_element=len(tets[1]))
    return r


def with_ranks(path, ranks=4):
    """The pieces of a mesh read by several processes at once, then merged by global id."""
    import multiprocessing
    with multiprocessing.get_context('spawn').Pool(ranks) as pool:
        parts = pool.starmap(one_rank, [(path, rank, ranks) for rank in range(ranks)])
    n = max(int(ids.max()) for _, ids, _, _ in parts) + 1
    merged = np.full((n, 3), np.nan)
    for points, ids, _, _ in parts:
        known = ~np.isnan(merged[ids, 0])
        assert (merged[ids[known]] == points[known]).all(), 'copies of a point differ'
        merged[ids] = points
    assert not np.isnan(merged).any()
    tets = np.concatenate([ids[tets] for _, ids, tets, _ in parts])
    regions = np.concatenate([region for _, _, _, region in parts])
    r = result(merged, tets, regions, None, np.zeros((0, 3), int), np.zeros(0, int), None)
    faces = np.sort(np.concatenate([tets[:, c] for c in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3])]), axis=1)
    _, counts = np.unique(faces, axis=0, return_counts=True)
    assert counts.max() <= 2
    r['boundary_faces'] = int((counts == 1).sum())
    r['shares'] = [len(tets) for _, _, tets, _ in parts]
    return r


def one_rank(path, rank, ranks):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(path)
    reader.UpdatePiece(rank, ranks, 0)
    g = reader.GetOutput()
    tets = vtk_to_numpy(g.GetCells().GetConnectivityArray()).reshape(-1, 4)
    return (vtk_to_numpy(g.GetPoints().GetData()).astype(float), vtk_to_numpy(g.GetPointData().GetGlobalIds()),
            tets, vtk_to_numpy(g.GetCellData().GetArray('region')))


def main():
    import contextlib, io
    found = []
    jobs = sys.argv[1:]
    for reader, kind, path in zip(jobs[::3], jobs[1::3], jobs[2::3]):
        read = {
            'gmsh': lambda: with_gmsh(path, kind),
            'meshio': lambda: with_meshio(path, kind),
            'vtk': lambda: with_vtk(path, kind),
            'manual': lambda: with_manual(path),
            'ranks': lambda: with_ranks(path),
        }
        with contextlib.redirect_stdout(io.StringIO()):
            try:
                out = read[reader]()
            except BaseException as error:
                sys.exit(f'{reader} on {path}: {error!r}')
        found.append(out)
    json.dump(found, sys.stdout)


if __name__ == '__main__':
    main()

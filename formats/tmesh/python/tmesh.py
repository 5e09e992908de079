"""Reads, writes and expands `.tmesh` documents with numpy alone. The format is defined in SPEC.md beside this folder.

    import tmesh
    document = tmesh.read('part.tet.tmesh')     # templates, gluings, instances as they are stored
    mesh = tmesh.expand(document)               # the whole mesh, the same bits that rotassemble writes
    tmesh.write(document, 'copy.tmesh')

    tmesh.register_meshio()                     # then meshio.read('part.tet.tmesh')
    tmesh.to_pyvista(mesh).plot(scalars='region')

ParaView opens documents with the plugin `paraview_tmesh.py` beside this file.

Nothing here is shared with the Rust code: it was written from SPEC.md, whose sections the comments name.
"""

import dataclasses
import io
import json
import math
import struct
import typing
import zlib

import numpy as np

MAGIC = b'\x89TMESH\r\n'
VERSION = (1, 0)
NONE = 0xFFFFFFFF
MAX_TURN = 65536
ROUNDING = 2.0 ** -46
DIRECTION_ROUNDING = 2.0 ** -23

JSON_CHUNKS = {b'SYMM': 'symmetry', b'PROM': 'promise', b'WISH': 'wishes', b'srch': 'search', b'REGN': 'regions',
               b'MARK': 'markers', b'RMAP': 'region_maps', b'srce': 'source', b'hist': 'history'}
SIZE_FIELD = {b'FPTS': ('size_points', '<f8', 4), b'FTET': ('size_tets', '<u4', 4), b'FTRI': ('size_triangles', '<u4', 3)}
LISTS = ('regions', 'markers', 'region_maps', 'history')


class TmeshError(ValueError):
    """A document that is malformed, or breaks a rule of SPEC.md."""


def require(condition, text):
    if not condition:
        raise TmeshError(text)


class Isometry(typing.NamedTuple):
    """R(k/n) M^mirrored H^flipped of section 8; the fraction is reduced. Compared by n, k, mirrored, flipped."""
    n: int = 1
    k: int = 0
    mirrored: bool = False
    flipped: bool = False

    @classmethod
    def reduced(cls, k, n, mirrored, flipped):
        common = math.gcd(k % n, n)
        return cls(n // common, k % n // common, bool(mirrored), bool(flipped))

    def __mul__(self, other):
        """The product: first the other, then this one."""
        n = math.lcm(self.n, other.n)
        turn = other.k * (n // other.n)
        k = self.k * (n // self.n) + (-turn if self.mirrored else turn)
        return Isometry.reduced(k, n, self.mirrored != other.mirrored, self.flipped != other.flipped)

    def inverse(self):
        return Isometry.reduced(self.k if self.mirrored else -self.k, self.n, self.mirrored, self.flipped)

    def is_reflection(self):
        return self.mirrored != self.flipped and (self.mirrored or self.k == 0)

    def reverses(self):
        """Whether it reverses orientation."""
        return self.mirrored != self.flipped

    def apply(self, points):
        """Images of an array of points, to the bit of section 8."""
        c, s = cos_sin(self.k, self.n)
        x, z = points[:, 0], (-1.0 if self.flipped else 1.0) * points[:, 2]
        y = (-1.0 if self.mirrored else 1.0) * points[:, 1]
        return np.stack([c * x - s * y, s * x + c * y, z], axis=1)


C = [4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05,
     -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11]
S = [-1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04,
     2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10]


def cos_sin(k, n):
    """Cosine and sine of k/n of a turn, section 8."""
    q, r = divmod(4 * k, n)
    if r == 0:
        c, s = 1.0, 0.0
    elif 2 * r == n:
        c = s = 0.7071067811865476
    elif 2 * r < n:
        c, s = first_octant(r, n)
    else:
        s, c = first_octant(n - r, n)
    return [(c, s), (-s, c), (-c, -s), (s, -c)][q]


def first_octant(r, n):
    if 3 * r == n:
        return 0.8660254037844386, 0.5
    t = 1.5707963267948966 * (r / n)
    z = t * t
    w = z * z
    h = 0.5 * z
    a = 1.0 - h
    cosine = a + (((1.0 - a) - h) + z * (z * (C[0] + z * (C[1] + z * C[2])) + (w * w) * (C[3] + z * (C[4] + z * C[5]))))
    sine = t + (z * t) * (S[0] + z * ((S[1] + z * (S[2] + z * S[3])) + (z * w) * (S[4] + z * S[5])))
    return cosine, sine


def empty(columns, kind=np.uint32):
    return np.zeros((0, columns) if columns else 0, kind)


@dataclasses.dataclass
class Gluing:
    """Section 7. Pairs are (here, there)."""
    name: str
    other: int
    step: Isometry
    vertex_pairs: np.ndarray
    triangle_pairs: np.ndarray


@dataclasses.dataclass
class Template:
    """Section 6; `regions` are those of the tetrahedra."""
    vertices: np.ndarray = dataclasses.field(default_factory=lambda: empty(3, float))
    triangles: np.ndarray = dataclasses.field(default_factory=lambda: empty(3))
    markers: np.ndarray = dataclasses.field(default_factory=lambda: empty(0))
    front: np.ndarray = dataclasses.field(default_factory=lambda: empty(0))
    back: np.ndarray = dataclasses.field(default_factory=lambda: empty(0))
    tets: np.ndarray = dataclasses.field(default_factory=lambda: empty(4))
    regions: np.ndarray = dataclasses.field(default_factory=lambda: empty(0))
    axis: np.ndarray = dataclasses.field(default_factory=lambda: empty(0))
    gluings: list = dataclasses.field(default_factory=list)


class Instance(typing.NamedTuple):
    """Section 8. Region map 0 is none, i > 0 the entry i - 1 of `region_maps`."""
    template: int
    isometry: Isometry
    region_map: int = 0


@dataclasses.dataclass
class Document:
    """All of a document. What is JSON in the file is dictionaries and lists here, with the keys of section 5."""
    templates: list = dataclasses.field(default_factory=list)
    instances: list = dataclasses.field(default_factory=list)
    rotation: np.ndarray = dataclasses.field(default_factory=lambda: np.eye(3))
    origin: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(3))
    symmetry: dict = None
    promise: dict = None
    wishes: dict = None
    search: dict = None
    source: dict = None
    size_points: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros((0, 4)))
    size_tets: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros((0, 4), np.uint32))
    size_triangles: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros((0, 3), np.uint32))
    regions: list = dataclasses.field(default_factory=list)
    markers: list = dataclasses.field(default_factory=list)
    region_maps: list = dataclasses.field(default_factory=list)
    history: list = dataclasses.field(default_factory=list)

    def placed_regions(self, instance, regions):
        """Region ids of a template as an instance has them."""
        regions = np.asarray(regions, np.uint32)
        if instance.region_map == 0:
            return regions
        placed = regions.copy()
        for old, new in self.region_maps[instance.region_map - 1]['pairs']:
            placed[regions == old] = new
        return placed

    def world(self, points):
        """World coordinates of canonical points, to the bit of section 8."""
        q = self.rotation
        x, y, z = points[:, 0], points[:, 1], points[:, 2]
        return np.stack([((q[i, 0] * x + q[i, 1] * y) + q[i, 2] * z) + self.origin[i] for i in range(3)], axis=1)


# ------------------------------------------------------------------------------------------------ reading

def read(file, check=True):
    """The document in a file: a path or a binary stream. Raises TmeshError for what is no valid document."""
    if hasattr(file, 'read'):
        return parse(file.read(), check)
    with open(file, 'rb') as stream:
        return parse(stream.read(), check)


def parse(data, check=True):
    """The document that some bytes are."""
    document, met = Document(), set()
    for name, scope, payload in chunks(memoryview(data)):
        known = True
        if name in JSON_CHUNKS:
            setattr(document, JSON_CHUNKS[name], parse_json(name, payload))
        elif name == b'FRAM':
            frame = array(name, payload, '<f8', 12)
            require(len(frame) == 1, 'FRAM: not 12 numbers')
            document.rotation, document.origin = frame[0, :9].reshape(3, 3), frame[0, 9:]
        elif name in SIZE_FIELD:
            attribute, kind, columns = SIZE_FIELD[name]
            setattr(document, attribute, array(name, payload, kind, columns))
        elif name == b'INST':
            document.instances = [parse_instance(row) for row in array(name, payload, '<u4', 6).tolist()]
        elif name == b'VERT':
            require(scope == len(document.templates), f'template {scope} begins out of turn')
            document.templates.append(Template(vertices=array(name, payload, '<f8', 3)))
        elif name in (b'TRIS', b'TETS', b'AXIS', b'GLUE'):
            require(scope == len(document.templates) - 1, f'{name.decode()} of template {scope} is out of place')
            parse_part(document.templates[-1], name, payload)
        else:
            require(name[:1].islower(), f'chunk {name!r} is required, and not known')
            known = False
        of_document = name in JSON_CHUNKS or name in (b'FRAM', b'INST', *SIZE_FIELD)
        require(not of_document or scope == 0, f'{name!r} has the scope {scope}')
        require(not known or name == b'GLUE' or (name, scope) not in met, f'{name!r} is there twice')
        met.add((name, scope))
    if check:
        validate(document)
    return document


def chunks(data):
    """Id, scope and payload of all chunks before the end marker. Sections 2 and 3."""
    require(bytes(data[:8]) == MAGIC[:len(data[:8])] and len(data) > 0, 'not a tmesh document')
    require(len(data) >= 16, 'the document is cut off')
    major, _, checksum = struct.unpack('<HHI', data[8:16])
    require(checksum == zlib.crc32(data[:12]), 'the checksum of the file header differs')
    require(major == VERSION[0], f'the document has version {major}, this reads version {VERSION[0]}')
    at, count = 16, 0
    while True:
        require(len(data) >= at + 24, f'the document is cut off at byte {len(data)}')
        name, scope, length, checksum, zero = struct.unpack('<4sIQII', data[at:at + 24])
        require(checksum == zlib.crc32(data[at:at + 16]), f'the checksum of the chunk header at byte {at} differs')
        end = at + 24 + length
        tail = end + -length % 8
        require(len(data) >= tail + 8, f'the document is cut off at byte {len(data)}')
        payload = data[at + 24:end]
        checksum, last = struct.unpack('<II', data[tail:tail + 8])
        require(checksum == zlib.crc32(payload), f'the checksum of {name!r} at byte {at} differs')
        require(zero == 0 and last == 0 and not any(data[end:tail]), f'padding of {name!r} at byte {at} is not zero')
        if name == b'END ':
            require(scope == 0 and length == 16, 'the end marker is malformed')
            require(struct.unpack('<QQ', payload) == (count, at), 'the end marker counts otherwise')
            require(len(data) == tail + 8, 'there are bytes after the end marker')
            return
        yield name, scope, payload
        at, count = tail + 8, count + 1


def array(name, payload, kind, columns):
    size = np.dtype(kind).itemsize * columns
    require(len(payload) % size == 0, f'{name.decode()}: not a whole number of entries')
    return np.frombuffer(payload, kind).reshape(-1, columns)


def parse_json(name, payload):
    def unique(pairs):
        require(len(pairs) == len(dict(pairs)), f'{name.decode()}: a key comes twice')
        return dict(pairs)

    def refuse(word):
        raise TmeshError(f'{name.decode()}: {word} is no JSON')
    try:
        text = bytes(payload).decode('utf-8')
        return json.loads(text, object_pairs_hook=unique, parse_constant=refuse)
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise TmeshError(f'{name.decode()}: {error}') from error


def parse_isometry(k, n, flags):
    require(0 < n <= MAX_TURN and k < n and flags < 4, f'{k}/{n} with flags {flags} is no isometry')
    return Isometry.reduced(k, n, flags & 1, flags & 2)


def parse_instance(row):
    template, k, n, flags, region_map, zero = row
    require(zero == 0, 'INST: a reserved field is not zero')
    return Instance(template, parse_isometry(k, n, flags), region_map)


def parse_part(template, name, payload):
    if name == b'TRIS':
        rows = array(name, payload, '<u4', 6)
        template.triangles, (template.markers, template.front, template.back) = rows[:, :3], rows[:, 3:].T
    elif name == b'TETS':
        rows = array(name, payload, '<u4', 5)
        template.tets, template.regions = rows[:, :4], rows[:, 4]
    elif name == b'AXIS':
        template.axis = array(name, payload, '<u4', 1)[:, 0]
    else:
        require(len(payload) >= 32 and len(payload) % 4 == 0, 'GLUE: too short')
        other, k, n, flags, length, vertices, triangles, zero = struct.unpack('<8I', payload[:32])
        words = -(-length // 4)
        require(len(payload) == 4 * (8 + words + 2 * (vertices + triangles)), 'GLUE: its counts are not its size')
        require(zero == 0, 'GLUE: a reserved field is not zero')
        text, rest = bytes(payload[32:32 + 4 * words]), payload[32 + 4 * words:]
        require(not any(text[length:]), 'GLUE: the padding of its name is not zero')
        try:
            text = text[:length].decode('utf-8')
        except UnicodeDecodeError as error:
            raise TmeshError('GLUE: its name is not UTF-8') from error
        pairs = array(name, rest, '<u4', 2)
        template.gluings.append(
            Gluing(text, other, parse_isometry(k, n, flags), pairs[:vertices], pairs[vertices:]))


# ------------------------------------------------------------------------------------------------ checking

def validate(document):
    """Raises TmeshError for the first rule of SPEC.md that a document breaks."""
    require(document.templates, 'there is no template')
    q = document.rotation
    require(np.all(np.abs(q.T @ q - np.eye(3)) <= ROUNDING) and np.linalg.det(q) > 0
            and np.all(np.isfinite(document.origin)), 'the frame is no rotation')
    regions = increasing([r['id'] for r in document.regions], 'region')
    increasing([m['id'] for m in document.markers], 'marker')
    for entry in document.region_maps:
        increasing([pair[0] for pair in entry['pairs']], 'region map')
        require(all(pair[1] in regions for pair in entry['pairs']), 'a region map leads to no region')
    names = [r['name'] for r in document.regions] + [m['name'] for m in document.markers]
    names += [g.name for t in document.templates for g in t.gluings]
    require(not any(ord(c) < 32 or 127 <= ord(c) < 160 for name in names for c in name), 'a name has control characters')
    steps = [g.step for t in document.templates for g in t.gluings]
    turns = math.lcm(1, *(i.n for i in steps), *(i.isometry.n for i in document.instances))
    require(turns <= MAX_TURN, 'the turns have no common denominator in range')
    if document.symmetry is not None:
        axis, reference = (np.array(d) for d in (document.symmetry['axis']['direction'], document.symmetry['reference']))
        off = [np.linalg.norm(axis) - 1, np.linalg.norm(reference) - 1, axis @ reference]
        require(np.all(np.abs(off) <= DIRECTION_ROUNDING), 'the directions of the symmetry are not orthonormal')
    validate_size_field(document)
    known = np.array(sorted(regions | {NONE}), np.uint32)
    for index, template in enumerate(document.templates):
        validate_template(index, template, known)
    for index, template in enumerate(document.templates):
        for gluing in template.gluings:
            validate_gluing(document, index, gluing)
    validate_instances(document)


def validate_size_field(document):
    points, elements = document.size_points, (document.size_tets, document.size_triangles)
    require(np.all(np.isfinite(points)) and np.all(points[:, 3] > 0), 'the size field has a length that is none')
    require(not len(points) or any(map(len, elements)), 'the size field has no elements')
    for ids in elements:
        require(not np.any(ids >= len(points)), 'an element of the size field names a point that is not there')
        ordered = np.sort(ids, axis=1)
        require(not np.any(ordered[:, 1:] == ordered[:, :-1]), 'an element of the size field names a point twice')


def increasing(ids, what):
    require(all(type(i) is int and 0 <= i < NONE for i in ids), f'an id of a {what} is out of range')
    require(all(a < b for a, b in zip(ids, ids[1:])), f'ids of the table of {what}s are not increasing')
    return set(ids)


def validate_template(index, template, known):
    count = len(template.vertices)
    require(np.all(np.isfinite(template.vertices)), f'template {index}: a coordinate is not finite')
    for what, ids in (('triangle', template.triangles), ('tetrahedron', template.tets), ('axis', template.axis)):
        require(not np.any(ids >= count), f'template {index}: a {what} names a vertex that is not there')
        if ids.ndim == 2:
            ordered = np.sort(ids, axis=1)
            require(not np.any(ordered[:, 1:] == ordered[:, :-1]), f'template {index}: a {what} names a vertex twice')
    for ids in (template.front, template.back, template.regions):
        require(np.all(np.isin(ids, known)), f'template {index}: an element has an unknown region')
    require(not np.any(template.regions == NONE), f'template {index}: a tetrahedron has no region')
    require(np.all(np.diff(template.axis.astype(np.int64)) > 0), f'template {index}: AXIS is not increasing')
    require(not np.any(template.vertices[template.axis][:, :2]), f'template {index}: a vertex is off the axis')


def validate_gluing(document, index, gluing):
    text = f"gluing '{gluing.name}' of template {index}: "
    require(gluing.other < len(document.templates), text + 'it names a template that is not there')
    here, there = document.templates[index], document.templates[gluing.other]
    for pairs, counts in ((gluing.vertex_pairs, (len(here.vertices), len(there.vertices))),
                          (gluing.triangle_pairs, (len(here.triangles), len(there.triangles)))):
        require(not np.any(pairs >= np.array(counts)), text + 'a pair names what is not there')
        require(np.all(np.diff(pairs[:, 0].astype(np.int64)) > 0), text + 'pairs are not increasing')
    extent = np.max(np.abs(here.vertices), initial=0.0)
    own, step = gluing.other == index, gluing.step
    v, w = gluing.vertex_pairs.T
    if own and step.is_reflection():
        for pairs in (gluing.vertex_pairs, gluing.triangle_pairs):
            require(np.all(pairs[:, 0] == pairs[:, 1]), text + 'a reflection pairs what is different')
        # A point moves by twice its distance from the plane.
        off = np.linalg.norm(step.apply(here.vertices[v]) - here.vertices[v], axis=1) / 2
        require(np.all(off <= ROUNDING * extent), text + 'a vertex is off the plane')
    else:
        off = np.max(np.abs(step.apply(there.vertices[w]) - here.vertices[v]), axis=1, initial=0.0)
        allowed = np.where(own & (v != w), 0.0, ROUNDING * extent)
        require(np.all(off <= allowed), text + 'a vertex is not the image of its partner')
    partner = np.full(len(here.vertices), NONE, np.uint32)
    partner[v] = w
    a = partner[here.triangles[gluing.triangle_pairs[:, 0]]]
    b = there.triangles[gluing.triangle_pairs[:, 1]]
    b = b if step.reverses() else b[:, [0, 2, 1]]
    same = np.zeros(len(a), bool)
    for shift in range(3):
        same |= np.all(a == np.roll(b, shift, axis=1), axis=1)
    require(np.all(same), text + 'paired triangles do not face each other')


def validate_instances(document):
    placed = [set() for _ in document.templates]
    for instance in document.instances:
        require(instance.template < len(placed), 'an instance names a template that is not there')
        require(instance.region_map <= len(document.region_maps), 'an instance names a region map that is not there')
        require(instance.isometry not in placed[instance.template], 'a template is placed twice by the same isometry')
        placed[instance.template].add(instance.isometry)
    if all(len(p) <= 1 for p in placed):
        return
    for index, template in enumerate(document.templates):
        for gluing in template.gluings:
            require(all(g * gluing.step in placed[gluing.other] for g in placed[index]),
                    f"beyond the gluing '{gluing.name}' of template {index} a neighbour is missing")


# ------------------------------------------------------------------------------------------------ writing

def write(document, file):
    """Writes a document to a path or a binary stream; raises TmeshError for one that is not valid."""
    validate(document)
    if not hasattr(file, 'write'):
        data = io.BytesIO()
        write(document, data)
        with open(file, 'wb') as stream:
            stream.write(data.getvalue())
        return
    writer = Writer(file)
    writer.chunk(b'FRAM', 0, np.concatenate([document.rotation.ravel(), document.origin]).astype('<f8').tobytes())
    for name, field in JSON_CHUNKS.items():
        value = getattr(document, field)
        if value or (field in LISTS and field != 'region_maps'):
            text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(',', ':'))
            writer.chunk(name, 0, text.encode('utf-8'))
    for name, (field, kind, _) in SIZE_FIELD.items():
        value = getattr(document, field)
        if len(value):
            writer.chunk(name, 0, value.astype(kind).tobytes())
    for index, template in enumerate(document.templates):
        write_template(writer, index, template)
    rows = [(i.template, *stored(i.isometry), i.region_map, 0) for i in document.instances]
    writer.chunk(b'INST', 0, np.array(rows, '<u4').tobytes())
    end = struct.pack('<QQ', writer.count, writer.at)
    writer.chunk(b'END ', 0, end)


class Writer:
    """Writes the file header, then chunks."""

    def __init__(self, out):
        header = MAGIC + struct.pack('<HH', *VERSION)
        self.out, self.count, self.at = out, 0, 16
        out.write(header + struct.pack('<I', zlib.crc32(header)))

    def chunk(self, name, scope, payload):
        header = struct.pack('<4sIQ', name, scope, len(payload))
        padding = bytes(-len(payload) % 8)
        self.out.write(header + struct.pack('<II', zlib.crc32(header), 0))
        self.out.write(payload)
        self.out.write(padding + struct.pack('<II', zlib.crc32(payload), 0))
        self.count, self.at = self.count + 1, self.at + 32 + len(payload) + len(padding)


def stored(isometry):
    return isometry.k, isometry.n, int(isometry.mirrored) | 2 * int(isometry.flipped)


def write_template(writer, index, template):
    writer.chunk(b'VERT', index, template.vertices.astype('<f8').tobytes())
    rows = np.column_stack([template.triangles, template.markers, template.front, template.back])
    writer.chunk(b'TRIS', index, rows.astype('<u4').tobytes())
    if len(template.tets):
        writer.chunk(b'TETS', index, np.column_stack([template.tets, template.regions]).astype('<u4').tobytes())
    if len(template.axis):
        writer.chunk(b'AXIS', index, template.axis.astype('<u4').tobytes())
    for gluing in template.gluings:
        name = gluing.name.encode('utf-8')
        counts = len(name), len(gluing.vertex_pairs), len(gluing.triangle_pairs), 0
        payload = struct.pack('<8I', gluing.other, *stored(gluing.step), *counts) + name + bytes(-len(name) % 4)
        pairs = gluing.vertex_pairs.astype('<u4').tobytes() + gluing.triangle_pairs.astype('<u4').tobytes()
        writer.chunk(b'GLUE', index, payload + pairs)


# ------------------------------------------------------------------------------------------------ expanding

@dataclasses.dataclass
class Mesh:
    """A mesh in world coordinates, with an instance's index on each element."""
    points: np.ndarray
    tets: np.ndarray
    regions: np.ndarray
    tet_instances: np.ndarray
    triangles: np.ndarray
    markers: np.ndarray
    front: np.ndarray
    back: np.ndarray
    triangle_instances: np.ndarray
    region_names: dict
    marker_names: dict


def expand(document):
    """The whole mesh that the instances of a valid document make, welded by the gluings. Section 9."""
    weld = Weld(document)
    tets, regions, tet_instances, surface = [empty(4)], [empty(0)], [empty(0)], []
    for i, instance in enumerate(document.instances):
        template, ids = document.templates[instance.template], weld.ids(i)
        reverses = instance.isometry.reverses()
        tets.append(ids[template.tets][:, [0, 1, 3, 2] if reverses else [0, 1, 2, 3]])
        regions.append(document.placed_regions(instance, template.regions))
        tet_instances.append(np.full(len(template.tets), i, np.uint32))
        for rows, front, back in surface_of(document, weld, i):
            corners = ids[template.triangles[rows]][:, [0, 2, 1] if reverses else [0, 1, 2]]
            numbers = np.full(len(rows), i, np.uint32)
            surface.append((corners, template.markers[rows], front, back, numbers))
    surface.append((empty(3), empty(0), empty(0), empty(0), empty(0)))
    names = [{e['id']: e['name'] for e in table} for table in (document.regions, document.markers)]
    return Mesh(weld.points(), *map(np.concatenate, (tets, regions, tet_instances)),
                *map(np.concatenate, zip(*surface)), *names)


def surface_of(document, weld, i):
    """Rows of the triangles of an instance that come into the mesh, with the regions on their sides."""
    instance = document.instances[i]
    template = document.templates[instance.template]
    rows = np.flatnonzero(~weld.on_closed[instance.template])
    yield rows, *(document.placed_regions(instance, side[rows]) for side in (template.front, template.back))
    for index, gluing in enumerate(template.gluings):
        if (instance.template, index) not in weld.closed:
            continue
        beyond = weld.index[gluing.other, instance.isometry * gluing.step]
        there = document.instances[beyond]
        other = document.templates[gluing.other]
        if gluing.other == instance.template and gluing.step.is_reflection():
            skipped = beyond < i or there.region_map == instance.region_map
        else:
            back = gluing.step.inverse()
            twice = any(g.other == instance.template and g.step == back for g in other.gluings)
            skipped = gluing.other < instance.template and twice
        if skipped:
            continue
        rows, others = gluing.triangle_pairs.T
        inner = document.placed_regions(instance, inner_region(template, rows))
        outer = document.placed_regions(there, inner_region(other, others))
        kept = inner != outer
        rows, inner, outer = rows[kept], inner[kept], outer[kept]
        outward = template.back[rows] != NONE
        yield rows, np.where(outward, outer, inner), np.where(outward, inner, outer)


def inner_region(template, rows):
    return np.where(template.back[rows] == NONE, template.front[rows], template.back[rows])


class Weld:
    """Which vertices of the copies are one point, and which copy gives its coordinates."""

    def __init__(self, document):
        self.document = document
        self.index = {(i.template, i.isometry): at for at, i in enumerate(document.instances)}
        self.placed = [[i for i in document.instances if i.template == t] for t in range(len(document.templates))]
        self.closed, self.on_closed = set(), [np.zeros(len(t.triangles), bool) for t in document.templates]
        for t, template in enumerate(document.templates):
            for index, gluing in enumerate(template.gluings):
                if self.placed[t] and all((gluing.other, i.isometry * gluing.step) in self.index for i in self.placed[t]):
                    self.closed.add((t, index))
                    self.on_closed[t][gluing.triangle_pairs[:, 0]] = True
                    self.on_closed[gluing.other][gluing.triangle_pairs[:, 1]] = True
        self.parent, self.generators = {}, {}
        self.relate_all()
        self.sort_into_classes()
        self.number()

    def find(self, node):
        """The root of a vertex and the offset: (g, node) is (g offset, root)."""
        path = []
        while node in self.parent:
            path.append(node)
            node = self.parent[node][0]
        offset = Isometry()
        for other in reversed(path):
            offset = self.parent[other][1] * offset
            self.parent[other] = (node, offset)
        return node, offset

    def relate_all(self):
        for t, template in enumerate(self.document.templates):
            for index, gluing in enumerate(template.gluings):
                if (t, index) in self.closed:
                    for here, there in gluing.vertex_pairs.tolist():
                        self.relate((t, here), gluing.step, (gluing.other, there))

    def relate(self, x, step, y):
        """(g, x) is (g step, y) for every g."""
        for node in (x, y):
            if node not in self.parent:
                self.generators.setdefault(node, ())
        (x, a), (y, b) = self.find(x), self.find(y)
        link = a.inverse() * step * b
        if x == y:
            self.stabilize(x, link)
            return
        if len(self.placed[x[0]]) > len(self.placed[y[0]]):
            x, y, link = y, x, link.inverse()
        self.parent[x] = (y, link)
        for generator in self.generators.pop(x):
            self.stabilize(y, link.inverse() * generator * link)

    def stabilize(self, root, generator):
        if generator != Isometry():
            generator = min(generator, generator.inverse())
            self.generators[root] = tuple(sorted({*self.generators[root], generator}))

    def sort_into_classes(self):
        """Class and position in it of each vertex that is a root or on no closed gluing; else -1."""
        self.members, self.template_of, self.sets = [], [], []
        self.classes = [[] for _ in self.document.templates]
        self.of, self.position = [], []
        nodes = [{} for _ in self.document.templates]
        for (t, v) in [*self.parent, *self.generators]:
            nodes[t][v] = self.generators.get((t, v))
        for t, template in enumerate(self.document.templates):
            count = len(template.vertices)
            of = np.zeros(count, np.int64)
            kinds, first = {}, {}
            free = np.ones(count, bool)
            for v, generators in sorted(nodes[t].items()):
                free[v] = False
                of[v] = -1 if generators is None else kinds.setdefault(generators, len(kinds) + 1)
                first.setdefault(of[v], v)
            if free.any():
                # Those without generators are one class with the inner vertices.
                alone = kinds.get(())
                of[free] = 0
                if alone is not None:
                    of[of == alone] = 0
                    first.pop(alone)
                    kinds.pop(())
                first[0] = int(np.flatnonzero(of == 0)[0])
                kinds[()] = 0
            named = {number: generators for generators, number in kinds.items()}
            renumbered, position = np.full(count, -1), np.zeros(count, np.int64)
            if self.placed[t]:
                for number in sorted(named, key=first.get):
                    members = np.flatnonzero(of == number)
                    renumbered[members] = len(self.members)
                    position[members] = np.arange(len(members))
                    self.classes[t].append(len(self.members))
                    self.members.append(members)
                    self.template_of.append(t)
                    self.sets.append(named[number])
            self.of.append(renumbered)
            self.position.append(position)

    def number(self):
        """First id of each class per instance, and who owns it."""
        self.owner = [self.owners(c) for c in range(len(self.members))]
        self.start, self.count, self.owned = {}, 0, []
        for i, instance in enumerate(self.document.instances):
            for c in self.classes[instance.template]:
                if self.owner[c][i] == i:
                    self.start[c, i] = self.count
                    self.count += len(self.members[c])
                    self.owned.append((i, c))

    def owners(self, c):
        """The first of the instances that share the members of a class, for each instance of its template."""
        t = self.template_of[c]
        owner = {}
        for first in (i for i, instance in enumerate(self.document.instances) if instance.template == t):
            if first in owner:
                continue
            owner[first], waiting = first, [first]
            while waiting:
                here = self.document.instances[waiting.pop()].isometry
                for generator in self.sets[c]:
                    for moved in (here * generator, here * generator.inverse()):
                        require((t, moved) in self.index, 'the instances do not close up')
                        at = self.index[t, moved]
                        if at not in owner:
                            owner[at] = first
                            waiting.append(at)
        return owner

    def ids(self, i):
        """The point of each vertex of an instance."""
        instance = self.document.instances[i]
        t = instance.template
        if not hasattr(self, 'links'):
            self.links = [[] for _ in self.document.templates]
            for node in list(self.parent):
                self.links[node[0]].append((node[1], *self.find(node)))
        ids = np.zeros(len(self.of[t]), np.int64)
        for c in self.classes[t]:
            members = self.members[c]
            ids[members] = self.start[c, self.owner[c][i]] + np.arange(len(members))
        starts = {}
        for v, (root_t, root), offset in self.links[t]:
            c = self.of[root_t][root]
            if (c, offset) not in starts:
                place = root_t, instance.isometry * offset
                require(place in self.index, 'the instances do not close up')
                starts[c, offset] = self.start[c, self.owner[c][self.index[place]]]
            ids[v] = starts[c, offset] + self.position[root_t][root]
        return ids.astype(np.uint32)

    def points(self):
        """All points in world coordinates, in the order of their ids."""
        points = np.zeros((self.count, 3))
        for i, c in self.owned:
            instance, members = self.document.instances[i], self.members[c]
            placed = instance.isometry.apply(self.document.templates[instance.template].vertices[members])
            start = self.start[c, i]
            points[start:start + len(members)] = self.document.world(placed)
        return points


# ------------------------------------------------------------------------------------------------ other libraries

def to_meshio(mesh):
    """The mesh as meshio's: tetrahedra and triangles, with `region`, `marker`, `front`, `back`, `instance` as cell data
    (-1 where there is none), and regions and markers as cell sets of their names."""
    import meshio
    number = lambda ids: np.asarray(ids).astype(np.uint32).astype(np.int32)
    inner = np.where(mesh.back == NONE, mesh.front, mesh.back)
    blocks, data = [], {key: [] for key in ('region', 'marker', 'front', 'back', 'instance')}
    if len(mesh.tets):
        none = np.full(len(mesh.tets), NONE, np.uint32)
        blocks.append(('tetra', mesh.tets.astype(np.int64)))
        for key, values in zip(data, (mesh.regions, none, none, none, mesh.tet_instances)):
            data[key].append(number(values))
    if len(mesh.triangles):
        blocks.append(('triangle', mesh.triangles.astype(np.int64)))
        for key, values in zip(data, (inner, mesh.markers, mesh.front, mesh.back, mesh.triangle_instances)):
            data[key].append(number(values))
    sets = {}
    for table, key, kind in ((mesh.region_names, 'region', 'tetra'), (mesh.marker_names, 'marker', 'triangle')):
        for i, name in table.items():
            if any(block[0] == kind for block in blocks):
                sets[name] = [np.flatnonzero(values == i) if block[0] == kind else np.zeros(0, int)
                              for block, values in zip(blocks, data[key])]
    return meshio.Mesh(mesh.points, blocks, cell_data=data, cell_sets=sets)


def register_meshio():
    """Makes `meshio.read` open `.tmesh` documents."""
    import meshio
    meshio.register_format('tmesh', ['.tmesh'], lambda path: to_meshio(expand(read(path))), {})


def to_vtk(mesh, boundary=True):
    """The mesh as a `vtkUnstructuredGrid`, with the triangles of the surface unless `boundary` is false; cell arrays as in
    `to_meshio`, and names as the string arrays `region_names` and `marker_names` with their ids in `region_ids` and
    `marker_ids`."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
    triangles = mesh.triangles if boundary or not len(mesh.tets) else mesh.triangles[:0]
    count = len(triangles)
    grid, points, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(mesh.points), deep=True))
    grid.SetPoints(points)
    sizes = np.concatenate([[0], np.full(len(mesh.tets), 4), np.full(count, 3)])
    connectivity = np.concatenate([mesh.tets.ravel(), triangles.ravel()]).astype(np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(np.cumsum(sizes).astype(np.int64), deep=True),
                  numpy_to_vtkIdTypeArray(connectivity, deep=True))
    types = np.concatenate([np.full(len(mesh.tets), 10, np.uint8), np.full(count, 5, np.uint8)])
    grid.SetCells(numpy_to_vtk(types, deep=True), cells)
    inner = np.where(mesh.back == NONE, mesh.front, mesh.back)
    none = np.full(len(mesh.tets), NONE, np.uint32)
    for name, of_tets, of_triangles in (('region', mesh.regions, inner), ('marker', none, mesh.markers),
                                        ('front', none, mesh.front), ('back', none, mesh.back),
                                        ('instance', mesh.tet_instances, mesh.triangle_instances)):
        values = numpy_to_vtk(np.concatenate([of_tets, of_triangles[:count]]).astype(np.uint32).view(np.int32), deep=True)
        values.SetName(name)
        grid.GetCellData().AddArray(values)
    for what, table in (('region', mesh.region_names), ('marker', mesh.marker_names)):
        names = vtkStringArray()
        names.SetName(f'{what}_names')
        for name in table.values():
            names.InsertNextValue(name)
        ids = numpy_to_vtk(np.array(list(table), np.uint32).view(np.int32), deep=True)
        ids.SetName(f'{what}_ids')
        grid.GetFieldData().AddArray(names)
        grid.GetFieldData().AddArray(ids)
    return grid


def to_pyvista(mesh, boundary=True):
    """The mesh as pyvista's `UnstructuredGrid`, with the arrays of `to_vtk`."""
    import pyvista
    return pyvista.wrap(to_vtk(mesh, boundary))

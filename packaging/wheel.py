#!/usr/bin/env python3
"""Packs a folder of installed tools (bin, lib, share) and the reader of documents as a Python wheel.

    wheel.py FOLDER VERSION OUTPUT_FOLDER MODULE.py...

The tools become scripts of the environment that the wheel is installed in; lib/symtet, where they look for TetGen's
library, and the manual pages come beside them. Same input, same bytes.
"""
import base64, hashlib, pathlib, re, subprocess, sys, sysconfig, zipfile

folder, version, output, *modules = sys.argv[1:]
folder = pathlib.Path(folder)

# A wheel's name says which C library its programs need: the newest version that one of them asks for.
programs = sorted(p for p in [*(folder / 'bin').iterdir(), *(folder / 'lib').rglob('*.so*')] if p.read_bytes()[:4] == b'\x7fELF')
symbols = subprocess.run(['objdump', '-T', *programs], check=True, capture_output=True, text=True).stdout
major, minor = max(tuple(map(int, found)) for found in re.findall(r'GLIBC_(\d+)\.(\d+)', symbols))
machine = sysconfig.get_platform().split('-')[-1]
tag = f'py3-none-manylinux_{major}_{minor}_{machine}'

info, data = f'symtet-{version}.dist-info', f'symtet-{version}.data'
files = {pathlib.Path(module).name: (pathlib.Path(module).read_bytes(), 0o644) for module in modules}
for path in sorted(p for p in folder.rglob('*') if p.is_file()):
    place = path.relative_to(folder)
    if place.parts[0] == 'bin':
        files[f'{data}/scripts/{place.name}'] = (path.read_bytes(), 0o755)
    elif place.parts[0] in ('lib', 'share'):
        files[f'{data}/data/{place}'] = (path.read_bytes(), 0o644)
    elif place.name.startswith('LICENSE'):
        files[f'{info}/licenses/{place.name}'] = (path.read_bytes(), 0o644)
readme = (folder / 'README.md').read_text() if (folder / 'README.md').exists() else ''
files[f'{info}/METADATA'] = (f"""Metadata-Version: 2.1
Name: symtet
Version: {version}
Summary: Tetrahedral meshes that keep the symmetry of a body
License: (MIT OR Apache-2.0) AND AGPL-3.0-or-later
Requires-Python: >=3.9
Provides-Extra: reader
Requires-Dist: numpy; extra == 'reader'
Description-Content-Type: text/markdown

{readme}""".encode(), 0o644)
files[f'{info}/WHEEL'] = (f'Wheel-Version: 1.0\nGenerator: symtet\nRoot-Is-Purelib: false\nTag: {tag}\n'.encode(), 0o644)
record = ''.join(
    f'{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()},{len(content)}\n'
    for name, (content, _) in files.items())
files[f'{info}/RECORD'] = ((record + f'{info}/RECORD,,\n').encode(), 0o644)

target = pathlib.Path(output) / f'symtet-{version}-{tag}.whl'
with zipfile.ZipFile(target, 'w', zipfile.ZIP_DEFLATED) as wheel:
    for name, (content, mode) in files.items():
        entry = zipfile.ZipInfo(name)
        entry.external_attr, entry.compress_type = (0o100000 | mode) << 16, zipfile.ZIP_DEFLATED
        wheel.writestr(entry, content)
print(target)

#!/usr/bin/env python3
"""Makes a wheel of the package for Python as it is installed by CMake: the module, and in pintle/modules what it loads.

usage: wheel.py VERSION STAGE OUT      STAGE: a folder that the components program and python have been installed to
"""

import base64
import hashlib
import sys
import sysconfig
import zipfile
from pathlib import Path

metadata = """Metadata-Version: 2.1
Name: pintle
Version: {version}
Summary: Planar flexible mechanisms with real joints
License: GPL-3.0-or-later
Requires-Python: =={python}.*
Requires-Dist: numpy
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: Python :: 3
Classifier: Topic :: Scientific/Engineering :: Physics

The libraries that it links are those of the Debian release that it was built on: SuiteSparse, OpenBLAS, NLopt, libyaml, VTK, Gmsh.
"""


def main(version, stage, out):
    stage, out = Path(stage), Path(out)
    package = next(stage.rglob("dist-packages/pintle/__init__.py")).parent
    modules = next(stage.rglob("libpintle_vtk.so")).parent
    files = {f"pintle/{f.name}": f for f in package.iterdir() if f.is_file()}
    files |= {f"pintle/modules/{f.name}": f for f in modules.iterdir() if f.name not in ("libpintle_cairo.so", "libpintle_fmu.so", "libpintle_mpi.so")}  # which the program alone loads
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{tag}-{tag}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    info = f"pintle-{version}.dist-info"
    texts = {
        f"{info}/METADATA": metadata.format(version=version, python=f"{sys.version_info.major}.{sys.version_info.minor}"),
        f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: pintle\nRoot-Is-Purelib: false\nTag: {tag}\n",
        f"{info}/LICENSE": (Path(__file__).parent.parent / "LICENSE").read_text(),
    }
    record = ""
    wheel = out / f"pintle-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w") as archive:

        def add(name, data, mode=0o644):
            entry = zipfile.ZipInfo(name)  # of 1980: the same bytes whenever it is made
            entry.external_attr = (0o100000 | mode) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)

        for name, source in sorted((files | texts).items()):
            data = source.read_bytes() if isinstance(source, Path) else source.encode()
            add(name, data, source.stat().st_mode & 0o777 if isinstance(source, Path) else 0o644)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(data)}\n"
        add(f"{info}/RECORD", record + f"{info}/RECORD,,\n")
    print(wheel)


if __name__ == "__main__":
    main(*sys.argv[1:])

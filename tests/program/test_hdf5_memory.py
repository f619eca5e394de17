"""A table of 2·10⁶ rows becomes HDF5 in the memory of a block of rows.

usage: test_hdf5_memory.py PINTLE"""

import os
import sys
import tempfile
from pathlib import Path

pintle = os.path.realpath(sys.argv[1])
if not (Path(pintle).parent / "pintle-hdf5").exists():
    sys.exit(print("skipped: pintle-hdf5 was not built; apt-get install libhdf5-dev pkgconf") or 77)
columns = 12


def peak_megabytes(rows):
    with tempfile.TemporaryDirectory() as place:
        with open(f"{place}/t.csv", "w") as table:
            table.write(",".join(f"c{k} [m]" for k in range(columns)) + ",name\n")
            for i in range(0, rows, 100):
                table.write("".join(f"{0.1 * j}," + f"{j / 7}," * (columns - 1) + f"pin {j % 10}\n" for j in range(i, i + 100)))
        _, status, used = os.wait4(os.spawnv(os.P_NOWAIT, pintle, [pintle, "hdf5", place, "-q"]), 0)
        assert status == 0, status
        return used.ru_maxrss / 1024


few, many = peak_megabytes(200_000), peak_megabytes(2_000_000)
block = 65_536 * (columns * 8 + 40) / 1e6  # MB: numbers, and texts with their pointers
print(f"at most {few:.0f} MB for 2e5 rows, {many:.0f} MB for 2e6; a block has {block:.0f} MB, all numbers have {2 * columns * 8} MB")
assert many < 3 * block + 30, "more than a block, as it grows, and the program"
assert many < few + 10, "grows with the rows"

"""tests/python/repeat.py under valgrind: what is lost for good must be none of ours.

Ours: allocated below the module _core, or lost as often as something was repeated. The rest, some dozens of blocks, CPython and NumPy
lose while modules are imported, which happens once however often something is repeated.    python3 tests/python/under_valgrind.py [ROUNDS]"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 8  # each five times
with tempfile.TemporaryDirectory() as place:
    log = Path(place) / "log"
    done = subprocess.run(
        ["valgrind", "--leak-check=full", "--show-leak-kinds=definite", "--num-callers=60", f"--log-file={log}",
         sys.executable, str(Path(__file__).with_name("repeat.py")), str(rounds)],
        env={**os.environ, "PYTHONMALLOC": "malloc", "GLIBC_TUNABLES": "glibc.malloc.tcache_count=0:glibc.malloc.arena_max=1", "OPENBLAS_NUM_THREADS": "1"})
    text = re.sub(r"(?m)^==\d+== ?", "", log.read_text())

lost = [record for record in re.split(r"\n\s*\n", text) if "definitely lost in" in record]


def of_an_import(record):
    return record.count("PyEval_EvalCode") > 1  # one is of the script itself


often = [record for record in lost if int(re.search(r"in ([\d,]+) blocks", record)[1].replace(",", "")) >= rounds and not of_an_import(record)]
ours = [record for record in lost if "_core." in record or record in often]
wrong = [record for record in re.split(r"\n\s*\n", text) if re.match(r"\s*(Invalid|Conditional|Use of|Mismatched)", record) and "_core." in record]
print(f"{len(lost)} places where memory is lost, {len(ours)} of them ours; {len(wrong)} accesses of ours are wrong", *ours, *wrong, sep="\n\n")
sys.exit(1 if ours or wrong or done.returncode or "LEAK SUMMARY" not in text and "All heap blocks were freed" not in text else 0)

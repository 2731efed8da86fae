"""Types are shipped, and none is missing."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).parents[1]


@pytest.mark.slow
def test_every_name_of_every_module_has_a_type_that_is_known():
    # It looks for the package with the first Python on the path, whatever runs it.
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    command = [sys.executable, "-m", "pyright", "--verifytypes", "modeviz", "--ignoreexternal"]
    done = subprocess.run(
        [*command, "--outputjson"],
        cwd=CHECKOUT,
        env={**os.environ, "PATH": path, "PYRIGHT_PYTHON_IGNORE_WARNINGS": "1"},
        capture_output=True,
        text=True,
    )
    found = json.loads(done.stdout)["typeCompleteness"]
    assert found["pyTypedPath"] == str(CHECKOUT / "modeviz" / "py.typed")
    unknown = [s["name"] for s in found["symbols"] if s["isExported"] and not s["isTypeKnown"]]
    assert unknown == []
    assert found["completenessScore"] == 1

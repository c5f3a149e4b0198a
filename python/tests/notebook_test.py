"""samples/talker.ipynb runs from its first cell to its last. --keep FOLDER keeps its pictures."""

import base64
import os
import pathlib

import pytest
from conftest import BUILD, SOURCE

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")

PICTURES = 6


def test_the_notebook_runs(monkeypatch, request):
    notebook = nbformat.read(SOURCE / "samples/talker.ipynb", as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells), "it is committed without what it shows"
    nbformat.validate(notebook)
    for name, value in {"FBS_BUILD": BUILD, "TALKER_SIZE": "176x144", "TALKER_PICTURES": 60}.items():
        monkeypatch.setenv(name, os.environ.get(name, str(value)))
    run_in = {"metadata": {"path": SOURCE / "samples"}}
    nbclient.NotebookClient(notebook, timeout=240, kernel_name="python3", resources=run_in).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pictures = [base64.b64decode(o.data["image/png"]) for o in outputs if "image/png" in o.get("data", {})]
    assert len(pictures) == PICTURES
    assert all(len(picture) > 5000 for picture in pictures)
    assert not [o for o in outputs if o.output_type == "stream" and o.name == "stderr"]
    if keep := request.config.getoption("keep"):
        for number, picture in enumerate(pictures):
            pathlib.Path(keep, f"notebook_{number}.png").write_bytes(picture)
        for cell in notebook.cells:
            for output in cell.get("outputs", []):
                print(output.get("text") or output.get("data", {}).get("text/plain"))

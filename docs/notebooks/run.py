"""Runs a notebook from its first cell to its last: `run.py NOTEBOOK [--write]`.

What it shows must be what it holds; with --write it is what it holds from now on. Pictures are not compared.
"""

import os
import pathlib
import sys

import nbclient
import nbformat


def texts(notebook):
    """What cells show, as text."""
    for number, cell in enumerate(notebook.cells):
        for output in cell.get("outputs", []):
            text = output.get("text") or output.get("data", {}).get("text/plain", "")
            yield number, text.strip()


def main(words):
    path = pathlib.Path(words[0])
    notebook = nbformat.read(path, as_version=4)
    before = list(texts(notebook))
    client = nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}})
    # What is not ours (tqdm, fonts) says nothing.
    os.environ.setdefault("PYTHONWARNINGS", "ignore")
    client.execute()
    if "--write" in words:
        for cell in notebook.cells:
            cell.get("metadata", {}).pop("execution", None)
        nbformat.write(notebook, path)
        return
    after = list(texts(notebook))
    if before != after:
        for (number, old), (_, new) in zip(before, after):
            if old != new:
                print(f"cell {number} shows\n{new}\nwhere the notebook holds\n{old}", file=sys.stderr)
        sys.exit(f"{path}: what it shows has changed; look at it, then say --write")


if __name__ == "__main__":
    main(sys.argv[1:])

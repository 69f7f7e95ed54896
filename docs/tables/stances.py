#!/usr/bin/env python3
"""Measures one body in twelve stances and writes how alike its girths come out (`docs/lab/girths.md`).

    docs/tables/stances.py TAILOR FOLDER > docs/tables/stances.json

FOLDER is what `models/made/stances.py` wrote. Beside each girth is the template's tape in that stance, at the true plane. Wants numpy,
scipy and trimesh.
"""

import json
import pathlib
import sys

import strangers
import timed


def main(tailor, folder):
    """All stances."""
    rows = []
    for file in sorted(pathlib.Path(folder).glob("**/*.json")):
        truth = json.loads(file.read_text())
        given, missing = strangers.girths(tailor, file.with_suffix(".ply"))
        girths = [strangers.row(n, given, missing, truth["planes"][p]["tape_clean"]) for n, p in strangers.PLANES.items()]
        if "WC" in given or "WC" in missing:
            girths.append(strangers.row("WC", given, missing, None))
        rows.append({"stance": truth["name"], "rows": girths})
        print(truth["name"], file=sys.stderr, flush=True)
    result = {**timed.made_with(tailor), "stances": rows}
    print(json.dumps(result).replace('{"stance"', '\n{"stance"'))


if __name__ == "__main__":
    main(*sys.argv[1:])

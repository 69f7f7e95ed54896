"""Values as files of the documented formats: how something of one's own gets into a pipeline."""

import json
import os
import shutil
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping

from . import _native
from ._errors import Error


def write(kind: str, value: Any, folder: Path, names: Callable[[], List[str]]) -> None:
    """Writes a value as files of a kind into an empty folder; masks are named by `names`.

    Raises
    ------
    Error
        The value is not of the kind: another form, another type of numbers.
    """
    writers: Dict[str, Callable[[Any, Path], None]] = {
        "masks": lambda value, folder: _masks(value, folder, names),
        "mesh": _mesh,
        "cameras": _cameras,
        "photos": _photos,
        "document": _document,
    }
    if kind not in writers:
        raise Error(f"{kind} cannot be written from Python; known: {', '.join(writers)}")
    writers[kind](value, folder)


def _pixels(value: Any, what: str, channels: int) -> bytes:
    """A picture as PNG."""
    import numpy

    array = numpy.asarray(value)
    shape = "(h, w)" if channels == 1 else "(h, w, 3)"
    if array.dtype == bool:
        array = array.astype(numpy.uint8) * 255
    if array.dtype != numpy.uint8:
        raise Error(f"{what} has numbers of type {array.dtype}: make it uint8 (0 to 255) or bool")
    if array.ndim != (2 if channels == 1 else 3) or (channels == 3 and array.shape[2] != 3) or 0 in array.shape:
        raise Error(f"{what} has the shape {array.shape}: it must be {shape}")
    return _native.png(array.tobytes(), array.shape[1], array.shape[0], channels)


def _masks(value: Any, folder: Path, names: Callable[[], List[str]]) -> None:
    known = names()
    if not isinstance(value, Mapping):
        value = list(value)
        if len(value) != len(known):
            raise Error(f"there are {len(value)} masks and {len(known)} photos: give one per photo, or a dict by place or name")
        value = dict(enumerate(value))
    if not value:
        raise Error("there is no mask")
    for photo, mask in value.items():
        if isinstance(photo, str):
            stem = Path(photo).stem
            if stem not in {Path(name).stem for name in known}:
                raise Error(f"there is no photo `{photo}`; they are {', '.join(known)}")
        else:
            if not 0 <= photo < len(known):
                raise Error(f"there is no photo {photo}; they are 0 to {len(known) - 1}")
            stem = Path(known[photo]).stem
        (folder / f"{stem}.png").write_bytes(_pixels(mask, f"the mask of {stem}", 1))


def _rows(value: Any, what: str, dtype: str, width: int) -> bytes:
    """Rows of numbers, as bytes."""
    import numpy

    array = numpy.asarray(value)
    if array.ndim != 2 or array.shape[1] != width:
        raise Error(f"{what} have the shape {array.shape}: it must be (n, {width})")
    if array.dtype.kind not in "iuf" or (array.dtype.kind == "f") != (dtype == "<f4"):
        raise Error(f"{what} are of type {array.dtype}: they must be {'numbers' if dtype == '<f4' else 'whole numbers'}")
    if dtype == "<f4" and not numpy.isfinite(array).all():
        raise Error(f"{what} hold {int((~numpy.isfinite(array)).sum())} numbers that are none (NaN or infinite)")
    if dtype == "<u4" and array.size and (array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise Error(f"{what} name a vertex below 0 or beyond 2³²")
    return array.astype(dtype).tobytes()


def _mesh(value: Any, folder: Path) -> None:
    import numpy

    colors = getattr(value, "colors", None)
    if hasattr(value, "vertices") and hasattr(value, "faces"):
        vertices, faces = value.vertices, value.faces
    else:
        try:
            vertices, faces = value
        except (TypeError, ValueError):
            raise Error("a mesh is a pair of vertices and faces, or has `vertices` and `faces`") from None
    vertices, faces = numpy.asarray(vertices), numpy.asarray(faces)
    if vertices.dtype.kind in "iu":
        vertices = vertices.astype(float)
    points, corners = _rows(vertices, "vertices", "<f4", 3), _rows(faces, "faces", "<u4", 3)
    if len(faces) and int(faces.max()) >= len(vertices):
        raise Error(f"faces name vertex {int(faces.max())}, but there are {len(vertices)}")
    paint = b"" if colors is None else numpy.asarray(colors, numpy.uint8)[:, :3].tobytes()
    (folder / "mesh.ply").write_bytes(_native.ply(points, corners, paint))


def _cameras(value: Any, folder: Path) -> None:
    if hasattr(value, "write_text") and hasattr(value, "cameras"):
        value.write_text(str(folder))
        for name in os.listdir(folder):
            if name not in ("cameras.txt", "images.txt", "points3D.txt"):
                os.remove(folder / name)
        return
    document = getattr(value, "document", value)
    if not isinstance(document, Mapping) or "views" not in document:
        raise Error("cameras are a dict as cameras.json has it (with `views`), a pycolmap.Reconstruction, or a result")

    def plain(x: Any) -> Any:
        if hasattr(x, "tolist"):
            return x.tolist()
        raise Error(f"cameras hold a {type(x).__name__}: say numbers, texts, lists")

    try:
        text = json.dumps(document, default=plain, allow_nan=False)
    except ValueError:
        raise Error("cameras hold a number that is none (NaN or infinite)") from None
    (folder / "cameras.json").write_text(text)


def _photos(value: Any, folder: Path) -> None:
    if not isinstance(value, Mapping):
        value = {f"{i:04}.png": photo for i, photo in enumerate(value)}
    if not value:
        raise Error("there is no photo")
    for name, photo in value.items():
        if isinstance(photo, (str, os.PathLike)):
            shutil.copyfile(photo, folder / str(name))
            continue
        (folder / f"{Path(str(name)).stem}.png").write_bytes(_pixels(photo, f"the photo {name}", 3))


def _document(value: Any, folder: Path) -> None:
    if isinstance(value, Mapping) or not isinstance(value, (tuple, list)):
        raise Error('a document is a pair of a name with its ending and its text: ("table.csv", "a,b\\n1,2\\n")')
    try:
        name, data = value
    except ValueError:
        raise Error('a document is a pair: ("table.csv", "a,b\\n1,2\\n")') from None
    if not isinstance(data, (str, bytes)):
        data = json.dumps(data)
    (folder / Path(str(name)).name).write_bytes(data.encode() if isinstance(data, str) else bytes(data))

"""Results as Python sees them: a class a kind. Arrays look into the result and are not copied."""

import json
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Tuple

from . import _native
from ._errors import Error, Missing
from .frames import flat, frame


class Artifact:
    """A result of any kind: its arrays by name, and all else as JSON.

    Attributes
    ----------
    kind : str
        What it is called: ``mesh``.
    """

    def __init__(self, native: "_native.Artifact", run: Optional[Mapping] = None) -> None:
        import numpy

        self._native = native
        self._run = run
        self.kind = native.kind
        self._bytes = numpy.asarray(native)
        self._places = {name: (size, at, end) for name, size, at, end in native.sections()}
        self._document: Any = None

    def array(self, name: str, dtype: str = "u1", width: int = 1) -> Any:
        """An array, without a copy; nobody may write to it.

        Parameters
        ----------
        name : str
            One of `arrays`.
        dtype : str
            As numpy calls it, such as ``<f4``.
        width : int
            Numbers a row; 1 is a flat array.
        """
        try:
            _, at, end = self._places[name]
        except KeyError:
            raise Error(f"{self.kind} has no array `{name}`; known: {', '.join(self._places)}") from None
        flat = self._bytes[at:end].view(dtype)
        return flat if width == 1 else flat.reshape(-1, width)

    @property
    def arrays(self) -> List[str]:
        """The names of its arrays."""
        return list(self._places)

    @property
    def document(self) -> Any:
        """All but its arrays."""
        if self._document is None:
            self._document = json.loads(self._native.document())
        return self._document

    @property
    def nbytes(self) -> int:
        """Its size. [bytes]"""
        return len(self._native)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.kind}, {self.nbytes} bytes>"


class Mesh(Artifact):
    """A surface.

    Attributes
    ----------
    vertices : numpy.ndarray, (n, 3) float32
        In ``unit``, z up.
    unit : str
        ``"mm"``, or ``"relative"`` where nothing of known length was given: 1000 are then the radius of the camera ring.
    faces : numpy.ndarray, (m, 3) uint32
        Vertices of each face, counter-clockwise seen from outside.
    colors : numpy.ndarray, (n, 3) uint8, or None
        Colour of each vertex.
    """

    @property
    def vertices(self) -> Any:
        return self.array("positions", "<f4", 3)

    @property
    def unit(self) -> str:
        return str(self.document["unit"])

    @property
    def faces(self) -> Any:
        return self.array("faces", "<u4", 3)

    @property
    def colors(self) -> Any:
        colors = self.array("colors", "u1", 3)
        return colors if len(colors) else None

    def to_trimesh(self, process: bool = False) -> Any:
        """As a ``trimesh.Trimesh``; vertices stay as they are unless it may process them."""
        import trimesh

        return trimesh.Trimesh(self.vertices, self.faces, vertex_colors=self.colors, process=process)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self.vertices)} vertices, {len(self.faces)} faces>"


class Textured(Mesh):
    """A surface with a picture on it.

    Attributes
    ----------
    corners : numpy.ndarray, (m, 3, 2) float32
        Where each corner of each face lies in the atlas: shares of its width and height, origin at the top left.
    atlas : numpy.ndarray, (h, w, 3) uint8
        The picture, sRGB.
    """

    @property
    def corners(self) -> Any:
        return self.array("corners", "<f4").reshape(-1, 3, 2)

    @property
    def atlas(self) -> Any:
        width, height = self.document["width"], self.document["height"]
        return self.array("atlas").reshape(height, width, 3)


class _ByPhoto(Artifact, Mapping):
    """One value a photo: by the photo's place in the turn."""

    _ids: Tuple[int, ...] = ()

    def __iter__(self) -> Iterator[int]:
        return iter(self._ids)

    def __len__(self) -> int:
        return len(self._ids)

    __hash__ = object.__hash__
    __eq__ = object.__eq__


class Masks(_ByPhoto):
    """Masks by the photo's place: ``masks[3]`` is a (h, w) uint8 array, 255 is body, less is its border."""

    def __init__(self, native: "_native.Artifact", run: Optional[Mapping] = None) -> None:
        super().__init__(native, run)
        self._sizes = {photo: (height, width) for photo, width, height in self.document}
        self._ids = tuple(self._sizes)

    def __getitem__(self, photo: int) -> Any:
        import numpy

        if photo not in self._sizes:
            raise Missing(f"there is no mask of photo {photo}; there are {', '.join(map(str, self))}")
        runs = self.array(f"mask {photo}", "u1", 4).astype(numpy.uint32)
        counts = runs[:, 1] | runs[:, 2] << 8 | runs[:, 3] << 16
        return numpy.repeat(runs[:, 0].astype(numpy.uint8), counts).reshape(self._sizes[photo])


class Photos(_ByPhoto):
    """Photos by place in the turn: ``photos[3]`` is a (h, w, 3) uint8 array, upright, sRGB; decoded when asked for."""

    def __init__(self, native: "_native.Artifact", run: Optional[Mapping] = None) -> None:
        super().__init__(native, run)
        self._ids = tuple(range(len(self.document["photos"])))

    def __getitem__(self, photo: int) -> Any:
        import numpy

        if photo not in self._ids:
            raise Missing(f"there is no photo {photo}; they are 0 to {len(self) - 1}")
        return numpy.asarray(self._native.pixels(photo))

    @property
    def names(self) -> List[str]:
        """The files' names, in turning order."""
        return [photo["name"] for photo in self.document["photos"]]

    @property
    def plate(self) -> Any:
        """The scene without the subject, or None."""
        import numpy

        return numpy.asarray(self._native.pixels(-1)) if self.document["plate"] else None

    @property
    def rig(self) -> dict:
        """What is known of the capture."""
        return self.document["rig"]


class Camera(dict):
    """A camera: ``K``, ``R``, ``t``, ``distortion``, ``width``, ``height``, ``image`` and how sure it is.

    ``x_in_camera = R @ x_in_world + t``; x right, y down, z forward.
    """

    def __getattr__(self, name: str) -> Any:
        import numpy

        try:
            value = self[name]
        except KeyError:
            raise AttributeError(f"a camera has no `{name}`; known: {', '.join(self)}") from None
        return numpy.array(value) if name in ("K", "R", "t", "distortion") else value

    @property
    def centre(self) -> Any:
        """Where it stood, in the world."""
        return -self.R.T @ self.t


class Cameras(Artifact):
    """Cameras: ``cameras.views`` in turning order.

    Attributes
    ----------
    points : numpy.ndarray, (n, 3) float32
        Points of the scene that the cameras were found by.
    """

    @classmethod
    def of(cls, document: dict) -> "Cameras":
        """Cameras as ``cameras.json`` has them: without points."""
        cameras = cls.__new__(cls)
        cameras.kind, cameras._document, cameras._run, cameras._places = "cameras", document, None, {}
        return cameras

    def __repr__(self) -> str:
        return f"<Cameras: {len(self)}, {self.unit}>"

    @property
    def views(self) -> List[Camera]:
        return [Camera(view) for view in self.document["views"]]

    @property
    def points(self) -> Any:
        return self.array("points", "<f4", 3)

    @property
    def unit(self) -> str:
        """``mm``, or ``relative`` where nothing of known length was given."""
        return self.document["unit"]

    def __len__(self) -> int:
        return len(self.document["views"])

    def __iter__(self) -> Iterator[Camera]:
        return iter(self.views)

    def to_pycolmap(self) -> Any:
        """As a ``pycolmap.Reconstruction``: lens ``OPENCV``, pixels with their centres at (0.5, 0.5), the points."""
        import tempfile

        import pycolmap

        with tempfile.TemporaryDirectory() as folder:
            for name, data in self._native.files("colmap-binary"):
                with open(f"{folder}/{name}", "wb") as file:
                    file.write(data)
            return pycolmap.Reconstruction(folder)


class Named(Artifact, Mapping):
    """A table by name, such as the girths: ``girths["WC"]["tape_cm"]``."""

    _rows = "girths"

    @property
    def rows(self) -> List[dict]:
        """The rows."""
        return self.document[self._rows]

    def __getitem__(self, name: str) -> dict:
        for row in self.rows:
            if row["name"] == name:
                return row
        for row in self.document.get("missing", []):
            if row["name"] == name:
                raise Missing(f"{name} was not measured: {row.get('why') or row.get('reason')}")
        raise Missing(f"there is no `{name}`; known: {', '.join(self)}")

    def __iter__(self) -> Iterator[str]:
        return (row["name"] for row in self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __contains__(self, name: object) -> bool:
        return name in list(self)

    def frame(self, kind: Optional[str] = None) -> Any:
        """As a flat table (pandas, polars or a list of dicts): ``interval_cm.lo``, ``sigma_cm.surface``; what was refused has
        ``refused`` True and its reason."""
        given = [{**flat(row), "refused": False} for row in self.rows]
        missing = [{**flat(row), "refused": True} for row in self.document.get("missing", [])]
        rows = given + missing
        keys = {key: None for row in rows for key in row}
        return frame([{key: row.get(key) for key in keys} for row in rows], kind)

    __hash__ = object.__hash__
    __eq__ = object.__eq__


class Girths(Named):
    """Girths by name: ``girths["WC"]["tape_cm"]``; ``document`` is ``girths.json``."""


class Landmarks(Named):
    """Where girths are taken, by name.

    Attributes
    ----------
    parts : numpy.ndarray, (n,) uint8
        The part of the body that each vertex of the surface belongs to.
    """

    _rows = "landmarks"

    @property
    def parts(self) -> Any:
        return self.array("parts")


class Document(Artifact):
    """A file: a page, a table, a picture."""

    @property
    def media(self) -> str:
        """What it is: ``text/html``."""
        return self.document

    @property
    def bytes(self) -> Any:
        """Its bytes."""
        return self.array("bytes").tobytes()

    @property
    def text(self) -> str:
        """Its text."""
        return self.bytes.decode()

    def json(self) -> Any:
        """What it says, where it is JSON."""
        return json.loads(self.bytes)

    def frame(self, kind: Optional[str] = None) -> Any:
        """Its rows, where it is CSV."""
        import csv

        return frame(list(csv.DictReader(self.text.splitlines())), kind)


class Tags(Artifact):
    """Marker tags on photos; ``document`` as ``show --as json`` writes it."""


class People(Artifact):
    """People on photos, and whether the turn shows one; ``document`` as ``show --as json`` writes it."""


class Keypoints(_ByPhoto):
    """Features by the photo's place: a pair of arrays.

    Points are (n, 4) float32: x, y, scale in pixels, angle in radians. Descriptors are (n, 128) uint8.
    """

    def __init__(self, native: "_native.Artifact", run: Optional[Mapping] = None) -> None:
        super().__init__(native, run)
        self._ids = tuple(self.document)

    def __getitem__(self, photo: int) -> Tuple[Any, Any]:
        if photo not in self._ids:
            raise Missing(f"there are no features of photo {photo}")
        return self.array(f"points {photo}", "<f4", 4), self.array(f"descriptors {photo}", "u1", 128)


class Tracks(Artifact):
    """Features that were seen in several photos.

    Attributes
    ----------
    lengths : numpy.ndarray, (n,) uint32
        In how many photos each was seen.
    photos : numpy.ndarray, (sum of lengths,) uint32
        The photo of each sight, track by track.
    places : numpy.ndarray, (sum of lengths, 3) float32
        Where: x, y and scale in pixels.
    """

    @property
    def lengths(self) -> Any:
        return self.array("lengths", "<u4")

    @property
    def photos(self) -> Any:
        return self.array("photos", "<u4")

    @property
    def places(self) -> Any:
        return self.array("places", "<f4", 3)

    def __len__(self) -> int:
        return len(self.lengths)


class Warps(_ByPhoto):
    """What the body did besides, by the photo's place: a cell's size in pixels, and (rows, columns, 2) offsets."""

    def __init__(self, native: "_native.Artifact", run: Optional[Mapping] = None) -> None:
        super().__init__(native, run)
        self._cells = {photo: (cell, columns) for photo, cell, columns in self.document}
        self._ids = tuple(self._cells)

    def __getitem__(self, photo: int) -> Tuple[float, Any]:
        if photo not in self._cells:
            raise Missing(f"there is no warp of photo {photo}")
        cell, columns = self._cells[photo]
        return cell, self.array(f"warp {photo}", "<f4", 2).reshape(-1, columns, 2)


class Aligned(Artifact):
    """How photos lie in one common place; ``tones N`` are 3 × 256 levels of photo N where its exposure is changed."""


class Scene(Artifact):
    """The scene without the body: ``still`` and ``disk`` are colours, row by row."""


class Evidence(Artifact):
    """What speaks for background on each reduced photo, in nats, packed: see formats.md."""


class Labels(Artifact):
    """Body or background of each reduced photo, packed as masks are."""


class Sway(Artifact):
    """How the body moved against the disk: ``document`` has ``photo``, ``R``, ``t`` of each photo."""


class BodyFeatures(Artifact):
    """What a surface shows of a body: ``document`` as ``show --as json`` writes it."""


class LostParts(Artifact):
    """Parts of a person that masks leave out; ``document`` as ``show --as json`` writes it."""


class Person(Artifact):
    """Who is measured: ``document`` has ``sex``, ``born`` and ``age_months``, each None where nobody said it."""


class Solid(Artifact):
    """A made body, as formulas: ``document`` has its parts."""


class Files(Artifact):
    """Files of the user's: ``document`` has the name, content and size of each."""


#: The class of each kind.
READERS: Dict[str, Callable[..., Artifact]] = {
    "aligned": Aligned,
    "body_features": BodyFeatures,
    "cameras": Cameras,
    "document": Document,
    "evidence": Evidence,
    "files": Files,
    "girths": Girths,
    "keypoints": Keypoints,
    "labels": Labels,
    "landmarks": Landmarks,
    "lost_parts": LostParts,
    "masks": Masks,
    "mesh": Mesh,
    "people": People,
    "person": Person,
    "photos": Photos,
    "scene": Scene,
    "solid": Solid,
    "sway": Sway,
    "tags": Tags,
    "textured": Textured,
    "tracks": Tracks,
    "warps": Warps,
}


def read(native: "_native.Artifact", run: Optional[Mapping] = None) -> Artifact:
    """A result as the class of its kind."""
    return READERS.get(native.kind, Artifact)(native, run)

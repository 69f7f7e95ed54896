"""Reads the cache of `tailor` in Python alone: runs, records, artifacts (docs/formats.md).

    python3 read_store.py CACHE                  the nodes of the last run
    python3 read_store.py CACHE NODE             an artifact's kind, format, metadata and sections
    python3 read_store.py CACHE NODE -o FOLDER   its sections as files; masks, meshes, cameras also as JSON

Records are believed only if their hash and their key are right, blobs only with --verify (slow here).
"""

import json
import pathlib
import struct
import sys

IV = (0x6A09E667, 0xBB67AE85, 0x3C6EF372, 0xA54FF53A, 0x510E527F, 0x9B05688C, 0x1F83D9AB, 0x5BE0CD19)
ORDER = (2, 6, 3, 10, 7, 0, 4, 13, 1, 11, 12, 5, 9, 14, 15, 8)
MIX = ((0, 4, 8, 12), (1, 5, 9, 13), (2, 6, 10, 14), (3, 7, 11, 15), (0, 5, 10, 15), (1, 6, 11, 12), (2, 7, 8, 13), (3, 4, 9, 14))
ALL = 0xFFFFFFFF


def compress(chain, words, counter, length, flags):
    """BLAKE3's compression: 16 words; the first eight are the next chaining value."""
    s = [*chain, *IV[:4], counter & ALL, counter >> 32, length, flags]
    turn = lambda x, n: (x >> n | x << (32 - n)) & ALL
    for _ in range(7):
        for i, (a, b, c, d) in enumerate(MIX):
            for word, r1, r2 in ((words[2 * i], 16, 12), (words[2 * i + 1], 8, 7)):
                s[a] = (s[a] + s[b] + word) & ALL
                s[d] = turn(s[d] ^ s[a], r1)
                s[c] = (s[c] + s[d]) & ALL
                s[b] = turn(s[b] ^ s[c], r2)
        words = [words[i] for i in ORDER]
    return [s[i] ^ s[i + 8] for i in range(8)]


def blake3(data):
    """The hash of some bytes, hexadecimal."""

    def chunk(at, root):
        chain, part = list(IV), data[at * 1024 : (at + 1) * 1024]
        blocks = [part[i : i + 64] for i in range(0, len(part), 64)] or [b""]
        for i, block in enumerate(blocks):
            last = i == len(blocks) - 1
            flags = (i == 0) | 2 * last | 8 * (last and root)
            chain = compress(chain, struct.unpack("<16I", block.ljust(64, b"\0")), at, len(block), flags)
        return chain

    def tree(first, count, root):
        if count == 1:
            return chunk(first, root)
        left = 1 << (count - 1).bit_length() - 1
        both = tree(first, left, False) + tree(first + left, count - left, False)
        return compress(IV, both, 0, 64, 4 | 8 * root)

    return struct.pack("<8I", *tree(0, max(1, -(-len(data) // 1024)), True)).hex()


class Bincode:
    """bincode 1: fixed sizes, little-endian. `read("u32")`, `read(["u32"])` a list, `read(("u32", "text"))`
    a tuple, `read({"maybe": "f64"})` an option."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, n):
        if not 0 <= n <= len(self.data) - self.at:
            raise ValueError("metadata is cut short")
        self.at += n
        return self.data[self.at - n : self.at]

    def read(self, form):
        if isinstance(form, tuple):
            return [self.read(part) for part in form]
        if isinstance(form, list):
            count = self.read("u64")
            return self.take(count) if form == ["u8"] else [self.read(form[0]) for _ in range(count)]
        if isinstance(form, dict):
            return self.read(form["maybe"]) if self.take(1) == b"\1" else None
        if form == "text":
            return self.take(self.read("u64")).decode()
        code, size = {"u8": ("B", 1), "u32": ("<I", 4), "u64": ("<Q", 8), "f64": ("<d", 8)}[form]
        return struct.unpack(code, self.take(size))[0]


LENS = ("u32", "u32", *["f64"] * 6)
VIEW = ("text", LENS, *["f64"] * 12, {"maybe": "f64"}, {"maybe": "f64"}, "u32")
META = {
    "masks": [("u32", "u32", "u32")],
    "document": "text",
    "cameras": ([("u32", VIEW)], "u32", {"maybe": "f64"}, {"maybe": "f64"}, "f64"),
    "files": [("text", *["u64"] * 4, "u64")],
}


class Artifact:
    """Kind, format, metadata (None where its form is not known here), sections by name as bytes."""

    def __init__(self, data):
        container, length, total = struct.unpack_from("<IIQ", data, 8)
        if data[:8] != b"TAILORAF" or container != 1 or total != len(data):
            raise ValueError("no whole artifact")
        header = Bincode(data[24 : 24 + length])
        self.kind, self.format, self.raw_meta, sections = header.read(("text", "u32", ["u8"], [("text", "u32", "u64", "u64")]))
        self.sections = {name: data[at : at + size] for name, _, at, size in sections}
        self.meta = Bincode(self.raw_meta).read(META[self.kind]) if self.kind in META else None

    def mask(self, photo):
        """A mask's width and pixels."""
        width = next(w for p, w, _ in self.meta if p == photo)
        runs = self.sections[f"mask {photo}"]
        return width, b"".join(runs[i : i + 1] * int.from_bytes(runs[i + 1 : i + 4], "little") for i in range(0, len(runs), 4))

    def mesh(self):
        """Positions and faces, three numbers each."""
        return [list(struct.iter_unpack(code, self.sections[name])) for code, name in (("<3f", "positions"), ("<3I", "faces"))]


class Store:
    """A cache."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        if (self.root / "format").read_text() not in ("stage store 1\n", "tailor store 1\n"):
            raise ValueError(f"{root} is no cache of a layout known here")

    def run(self):
        """The nodes of the last run, by name."""
        names = sorted(p.name for p in (self.root / "runs").glob("*.json"))
        if not names:
            raise ValueError("no run yet")
        lines = self.lines(names[-1])
        if lines[0].get("same_as"):
            lines = self.lines(lines[0]["same_as"] + ".json")
        return {node["node"]: node for node in lines[2:]}

    def lines(self, name):
        return [json.loads(line) for line in (self.root / "runs" / name).read_text().splitlines()]

    def record(self, key):
        """The record of a key, whose hash and key are right."""
        file = (self.root / "ac" / key[:2] / key).read_bytes()
        told, body = file.split(b"\n", 1)
        record = json.loads(body)
        texts = [text.encode() for line in record["provenance"] for text in line]
        own = b"".join(struct.pack("<Q", len(text)) + text for text in texts)
        if blake3(body) != told.decode() or blake3(own) != key:
            raise ValueError(f"the record {key} is not whole, or another's")
        return record

    def artifact(self, content, verify=False):
        data = (self.root / "cas" / content[:2] / content).read_bytes()
        if verify and blake3(data) != content:
            raise ValueError(f"the blob {content} is not whole")
        return Artifact(data)


def main(words):
    store, verify = Store(words[0]), "--verify" in words
    nodes = store.run()
    if len(words) == 1:
        for name, node in nodes.items():
            print(f"{node['status']:<9} {name:<14} {node['stage']}  {node['content']}")
        return
    node = nodes.get(words[1])
    if not node or not node["content"]:
        sys.exit(f"the last run has no result of `{words[1]}`; there are {', '.join(n for n in nodes if nodes[n]['content'])}")
    artifact = store.artifact(store.record(node["key"])["content"], verify)
    sizes = {name: len(data) for name, data in artifact.sections.items()}
    print(json.dumps({"kind": artifact.kind, "format": artifact.format, "meta": repr(artifact.meta)[:2000], "sections": sizes}))
    if "-o" in words:
        out = pathlib.Path(words[words.index("-o") + 1])
        out.mkdir(parents=True, exist_ok=True)
        for name, data in artifact.sections.items():
            (out / name.replace("/", "_")).write_bytes(data)
        if artifact.kind == "masks":
            for photo, width, height in artifact.meta:
                pixels = artifact.mask(photo)[1]
                (out / f"{photo:04}.pgm").write_bytes(b"P5 %d %d 255\n" % (width, height) + pixels)
        if artifact.kind == "mesh":
            (out / "mesh.json").write_text(json.dumps(dict(zip(("positions", "faces"), artifact.mesh()))))
        if artifact.kind == "cameras":
            (out / "cameras.json").write_text(json.dumps(artifact.meta))


if __name__ == "__main__":
    main(sys.argv[1:])

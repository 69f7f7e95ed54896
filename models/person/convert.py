"""Reads the two networks of the package `mediapipe` and writes them as flat files.

    pip download --no-deps mediapipe==0.10.9
    python convert.py mediapipe-0.10.9-*.whl .

What a flat file holds is told in README.md. The same package gives the same bytes.
"""

import hashlib
import sys
import zipfile
from pathlib import Path

import numpy as np
import tflite

# Name of the flat file; the network in the package; names of its outputs that are kept; whether zeros are left out.
NETWORKS = [
    (
        "detector.net",
        "mediapipe/modules/pose_detection/pose_detection.tflite",
        {"boxes": ["Identity"], "scores": ["Identity_1"]},
        True,
    ),
    (
        "landmarks.net",
        "mediapipe/modules/pose_landmark/pose_landmark_full.tflite",
        {"landmarks": ["Identity"], "presence": ["Identity_1"], "mask": ["Identity_2"]},
        False,
    ),
]
CONV, DEPTHWISE, ADD, MAX_POOL, DOUBLE, TO_SPACE = range(6)
NONE = 0xFFFFFFFF
LINEAR, RELU6 = 0, 3
NAMES = {v: k for k, v in vars(tflite.BuiltinOperator).items() if isinstance(v, int)}
OPTIONS = {
    "CONV_2D": tflite.Conv2DOptions,
    "DEPTHWISE_CONV_2D": tflite.DepthwiseConv2DOptions,
    "MAX_POOL_2D": tflite.Pool2DOptions,
    "ADD": tflite.AddOptions,
    "RESIZE_BILINEAR": tflite.ResizeBilinearOptions,
    "DEPTH_TO_SPACE": tflite.DepthToSpaceOptions,
}


class Network:
    """A graph of tflite, and what each tensor is."""

    def __init__(self, data):
        self.model = tflite.Model.GetRootAs(data, 0)
        self.graph = self.model.Subgraphs(0)
        # Which operator makes a tensor; which operators read it.
        self.maker = {}
        for i in range(self.graph.OperatorsLength()):
            for out in self.graph.Operators(i).OutputsAsNumpy():
                self.maker[int(out)] = i

    def op(self, i):
        op = self.graph.Operators(i)
        code = self.model.OperatorCodes(op.OpcodeIndex())
        name = NAMES[max(code.BuiltinCode(), code.DeprecatedBuiltinCode())]
        options = None
        if name in OPTIONS:
            options = OPTIONS[name]()
            table = op.BuiltinOptions()
            options.Init(table.Bytes, table.Pos)
        return name, [int(t) for t in op.InputsAsNumpy()], [int(t) for t in op.OutputsAsNumpy()], options

    def shape(self, tensor):
        return [int(n) for n in self.graph.Tensors(tensor).ShapeAsNumpy()]

    def raw(self, tensor):
        t = self.graph.Tensors(tensor)
        kinds = {tflite.TensorType.FLOAT32: np.float32, tflite.TensorType.FLOAT16: np.float16, tflite.TensorType.INT32: np.int32}
        return np.frombuffer(self.model.Buffers(t.Buffer()).DataAsNumpy().tobytes(), kinds[t.Type()])

    def constant(self, tensor):
        """The values of a constant, as halves; `None` where an operator computes it from what flows."""
        if tensor not in self.maker:
            values = self.raw(tensor).reshape(self.shape(tensor))
            if values.dtype != np.float32:
                return values
            halves = values.astype(np.float16)
            assert (halves.astype(np.float32) == values).all(), "a weight that is no half"
            return halves
        name, inputs, _, _ = self.op(self.maker[tensor])
        if name == "DEQUANTIZE":
            return self.constant(inputs[0])
        if name == "DENSIFY":
            return self.dense(inputs[0])
        return None

    def dense(self, tensor):
        """A sparse constant: rows of the last axis, each with the places of its values."""
        sparsity = self.graph.Tensors(tensor).Sparsity()
        shape = self.shape(tensor)
        assert sparsity.BlockMapLength() == 0 and sparsity.DimMetadataLength() == len(shape) == 4
        assert list(sparsity.TraversalOrderAsNumpy()) == [0, 1, 2, 3]
        assert [sparsity.DimMetadata(k).Format() for k in range(4)] == [0, 0, 0, 1]
        last = sparsity.DimMetadata(3)

        def indices(kind, table):
            vector = {1: tflite.Int32Vector, 2: tflite.Uint16Vector, 3: tflite.Uint8Vector}[kind]()
            vector.Init(table.Bytes, table.Pos)
            return vector.ValuesAsNumpy().astype(np.int64)

        starts = indices(last.ArraySegmentsType(), last.ArraySegments())
        places = indices(last.ArrayIndicesType(), last.ArrayIndices())
        rows = int(np.prod(shape[:3]))
        assert len(starts) == rows + 1 and starts[-1] == len(places)
        of_row = np.repeat(np.arange(rows), np.diff(starts))
        values = np.zeros((rows, shape[3]), np.float16)
        values[of_row, places] = self.raw(tensor)
        return values.reshape(shape)


class Writer:
    """The flat file as it grows, from what is wanted back to the input."""

    def __init__(self, net):
        self.net = net
        self.ops = []
        self.values = []
        self.count = 0
        self.number = {int(net.graph.InputsAsNumpy()[0]): 0}

    def store(self, values):
        at = self.count
        flat = np.ascontiguousarray(values, np.float16).ravel()
        assert np.isfinite(flat.astype(np.float32)).all()
        self.values.append(flat)
        self.count += flat.size
        return at

    def plain(self, tensor):
        """The tensor without the reshapes behind which it stands."""
        while tensor in self.net.maker:
            name, inputs, _, _ = self.net.op(self.net.maker[tensor])
            if name not in ("RESHAPE", "LOGISTIC"):
                break
            tensor = inputs[0]
        return tensor

    def parts(self, tensor):
        tensor = self.plain(tensor)
        name, inputs, _, _ = self.net.op(self.net.maker[tensor])
        return [self.plain(t) for t in inputs] if name == "CONCATENATION" else [tensor]

    def padded(self, tensor, top_left_bottom_right):
        """The tensor before a PAD, and the zeros around it."""
        if tensor in self.net.maker:
            name, inputs, _, _ = self.net.op(self.net.maker[tensor])
            if name == "PAD":
                (n0, n1), (top, bottom), (left, right), (c0, c1) = self.net.constant(inputs[1]).tolist()
                assert [n0, n1, c0, c1] == [0, 0, 0, 0] and top_left_bottom_right == [0, 0, 0, 0]
                return inputs[0], [top, left, bottom, right]
        return tensor, top_left_bottom_right

    def window(self, size, kernel, stride, out, padding):
        """Zeros around, as `SAME` (0) and `VALID` (1) have it."""
        pads = []
        for n, k, o in zip(size, kernel, out):
            total = max((o - 1) * stride + k - n, 0) if padding == 0 else 0
            pads.append((total // 2, total - total // 2))
        (top, bottom), (left, right) = pads
        return [top, left, bottom, right]

    def write(self, i):
        name, inputs, outputs, options = self.net.op(i)
        if name in ("DEQUANTIZE", "DENSIFY", "PAD", "RESHAPE", "LOGISTIC", "CONCATENATION"):
            return
        shape = self.net.shape
        out = outputs[0]
        row = dict(code=0, a=0, b=NONE, act=LINEAR, stride=1, kh=1, kw=1, pads=[0, 0, 0, 0], weights=NONE, bias=NONE)
        if name in ("CONV_2D", "DEPTHWISE_CONV_2D"):
            weights, bias = self.net.constant(inputs[1]), self.net.constant(inputs[2])
            kernel = weights.shape[1:3]
            assert options.StrideH() == options.StrideW() and options.DilationHFactor() == options.DilationWFactor() == 1
            pads = self.window(shape(inputs[0])[1:3], kernel, options.StrideH(), shape(out)[1:3], options.Padding())
            source, pads = self.padded(inputs[0], pads)
            if name == "CONV_2D":
                weights = weights.transpose(1, 2, 3, 0)
            else:
                assert options.DepthMultiplier() == 1
            row.update(code=CONV if name == "CONV_2D" else DEPTHWISE, a=source, stride=options.StrideH(), pads=pads)
            row.update(kh=kernel[0], kw=kernel[1], act=options.FusedActivationFunction())
            row.update(weights=self.store(weights), bias=self.store(bias))
        elif name == "ADD":
            assert shape(inputs[0]) == shape(inputs[1])
            row.update(code=ADD, a=inputs[0], b=inputs[1], act=options.FusedActivationFunction())
        elif name == "MAX_POOL_2D":
            assert options.FilterHeight() == options.FilterWidth() == options.StrideH() == options.StrideW() == 2
            assert all(n % 2 == 0 for n in shape(inputs[0])[1:3])
            row.update(code=MAX_POOL, a=inputs[0], stride=2, kh=2, kw=2)
        elif name == "RESIZE_BILINEAR":
            assert options.HalfPixelCenters() and not options.AlignCorners()
            assert [2 * n for n in shape(inputs[0])[1:3]] == shape(out)[1:3]
            row.update(code=DOUBLE, a=inputs[0])
        elif name == "DEPTH_TO_SPACE":
            assert options.BlockSize() == 2
            row.update(code=TO_SPACE, a=inputs[0])
        else:
            raise SystemExit(f"an operator that is not known: {name}")
        assert row["act"] in (LINEAR, RELU6), row["act"]
        self.number[out] = len(self.ops) + 1
        words = [row["code"], self.number[row["a"]], NONE if row["b"] == NONE else self.number[row["b"]]]
        words += [int(row["act"] == RELU6), row["stride"], row["kh"], row["kw"], *row["pads"]]
        words += [shape(out)[3], row["weights"], row["bias"]]
        self.ops.append(words)


def needed(net, wanted):
    """The operators that the wanted outputs depend on, in the order of the graph."""
    open_tensors, found = list(wanted), set()
    while open_tensors:
        maker = net.maker.get(open_tensors.pop())
        if maker is not None and maker not in found:
            found.add(maker)
            open_tensors += net.op(maker)[1]
    return sorted(found)


def flat(data, outputs, sparse):
    net = Network(data)
    writer = Writer(net)
    named = {net.graph.Tensors(int(t)).Name().decode(): int(t) for t in net.graph.OutputsAsNumpy()}
    wanted = [part for names in outputs.values() for name in names for part in writer.parts(named[name])]
    for i in needed(net, wanted):
        writer.write(i)
    ends = [writer.number[t] for t in wanted]
    values = np.concatenate(writer.values)
    head = [*net.shape(int(net.graph.InputsAsNumpy()[0]))[1:], len(writer.ops), len(ends), values.size, int(sparse)]
    file = b"TAILNET1" + np.array(head + ends + [w for op in writer.ops for w in op], "<u4").tobytes()
    bits = values.view(np.uint16)
    if sparse:
        file += np.packbits(bits != 0, bitorder="little").tobytes()
        bits = bits[bits != 0]
    return file + bits.astype("<u2").tobytes()


def main():
    package, folder = Path(sys.argv[1]), Path(sys.argv[2])
    with zipfile.ZipFile(package) as wheel:
        for name, path, outputs, sparse in NETWORKS:
            data = wheel.read(path)
            made = flat(data, outputs, sparse)
            (folder / name).write_bytes(made)
            for what, content in [(path, data), (name, made)]:
                print(hashlib.sha256(content).hexdigest(), len(content), what)
        (folder / "LICENSE").write_bytes(wheel.read("mediapipe-0.10.9.dist-info/LICENSE"))


main()

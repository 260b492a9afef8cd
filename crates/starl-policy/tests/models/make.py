"""Makes the models of the tests, and what ONNX Runtime computes for them.

    pip install numpy onnx onnxruntime
    python make.py

Writes NAME.onnx for each model, expected.txt with lines `NAME: inputs -> outputs` and broken/NAME.onnx for models that cannot
be read.
"""

from pathlib import Path

import numpy as np
import onnxruntime
from onnx import TensorProto, helper, numpy_helper

HERE = Path(__file__).parent
RANDOM = np.random.default_rng(7)


def weights(*shape):
    return RANDOM.normal(0, 0.6, shape).astype(np.float32)


def model(name, nodes, constants=(), inputs=(("x", ["batch", 4]),), outputs=(("y", None),), opset=17, folder=HERE):
    value = helper.make_tensor_value_info
    graph = helper.make_graph(
        nodes,
        name,
        [value(input, TensorProto.FLOAT, shape) for input, shape in inputs],
        [value(output, TensorProto.FLOAT, shape) for output, shape in outputs],
        [constant if isinstance(constant, TensorProto) else numpy_helper.from_array(constant[1], constant[0]) for constant in constants],
    )
    made = helper.make_model(graph, opset_imports=[helper.make_opsetid("", opset)], ir_version=8)
    (folder / f"{name}.onnx").write_bytes(made.SerializeToString())
    return made


node = helper.make_node
good = {}

# A stack of dense layers as exporters write it, `Gemm` with transposed weights.
good["dense"] = model(
    "dense",
    [
        node("Flatten", ["x"], ["flat"]),
        node("Gemm", ["flat", "w1", "b1"], ["h1"], transB=1),
        node("Tanh", ["h1"], ["t1"]),
        node("Gemm", ["t1", "w2", "b2"], ["h2"], transB=1, alpha=0.5, beta=2.0),
        node("Relu", ["h2"], ["t2"]),
        node("MatMul", ["t2", "w3"], ["h3"]),
        node("Add", ["h3", "b3"], ["y"]),
    ],
    [("w1", weights(16, 4)), ("b1", weights(16)), ("w2", weights(8, 16)), ("b2", weights(1, 8)), ("w3", weights(8, 2)), ("b3", weights(2))],
)

UNARY = ["Abs", "Elu", "Exp", "LeakyRelu", "Neg", "Relu", "Selu", "Sigmoid", "Softplus", "Tanh"]
good["activations"] = model(
    "activations",
    [
        *(node(operator, ["x"], [operator]) for operator in UNARY),
        node("Elu", ["x"], ["Elu2"], alpha=0.3),
        node("LeakyRelu", ["x"], ["LeakyRelu2"], alpha=0.2),
        node("Sqrt", ["Abs"], ["Sqrt"]),
        node("Log", ["Exp"], ["Log"]),
        node("Softmax", ["x"], ["Softmax"], axis=-1),
        node("Concat", [*UNARY, "Elu2", "LeakyRelu2", "Sqrt", "Log", "Softmax"], ["y"], axis=1),
    ],
)

good["arithmetic"] = model(
    "arithmetic",
    [
        node("Constant", [], ["two"], value_float=2.0),
        node("Constant", [], ["row"], value=numpy_helper.from_array(weights(1, 4))),
        node("Div", ["two", "x"], ["a"]),
        node("Sub", ["row", "x"], ["b"]),
        node("Mul", ["a", "b"], ["c"]),
        node("Sub", ["c", "two"], ["d"]),
        node("Max", ["d", "row"], ["e"]),
        node("Min", ["e", "two"], ["f"]),
        node("Clip", ["x", "low", "high"], ["g"]),
        node("Clip", ["x", "", "high"], ["h"]),
        node("Transpose", ["w"], ["wt"], perm=[1, 0]),
        node("MatMul", ["f", "wt"], ["i"]),
        node("Squeeze", ["i"], ["j"]),
        node("Concat", ["f", "g", "h", "i"], ["k"], axis=-1),
        node("Reshape", ["k", "shape"], ["l"]),
        node("Cast", ["l"], ["m"], to=TensorProto.FLOAT),
        node("Dropout", ["m"], ["n"]),
        node("Identity", ["n"], ["y"]),
    ],
    [("low", np.float32(-0.5)), ("high", np.float32(0.25)), ("w", weights(3, 4)), ("shape", np.array([-1, 15]))],
)

good["two_inputs_two_outputs"] = model(
    "two_inputs_two_outputs",
    [
        node("Concat", ["a", "b"], ["ab"], axis=1),
        node("Gemm", ["ab", "w", "b0"], ["mean"]),
        node("Softmax", ["mean"], ["chance"], axis=1),
    ],
    [("w", weights(5, 3)), ("b0", weights(1))],
    inputs=(("a", [1, 2]), ("b", [1, 3])),
    outputs=(("mean", None), ("chance", None)),
)

good["clip_by_attributes"] = model("clip_by_attributes", [node("Clip", ["x"], ["y"], min=-0.5, max=0.5)], opset=7)

good["best"] = model("best", [node("ArgMax", ["x"], ["i"], axis=1), node("Cast", ["i"], ["y"], to=TensorProto.FLOAT)])

(HERE / "broken").mkdir(exist_ok=True)


def broken(name, nodes, constants=(), **more):
    model(name, nodes, constants, folder=HERE / "broken", **more)


broken("operator", [node("LSTM", ["x", "w", "w"], ["y"], name="memory")], [("w", weights(1))])
broken("domain", [node("Gelu", ["x"], ["y"], domain="com.example")])
broken("batch", [node("Relu", ["x"], ["y"])], inputs=(("x", [3, 4]),))
broken("unknown_size", [node("Relu", ["x"], ["y"])], inputs=(("x", [1, "n"]),))
broken("image", [node("Relu", ["x"], ["y"])], inputs=(("x", [1, 3, 8]),))
broken("missing", [node("Relu", ["z"], ["y"])])
broken("unfit", [node("MatMul", ["x", "w"], ["y"])], [("w", weights(5, 2))])
broken("broadcast", [node("Add", ["x", "column"], ["y"])], [("column", weights(4, 1))])
broken("axis", [node("Softmax", ["x"], ["y"], axis=0)])
broken("reshape", [node("Reshape", ["x", "shape"], ["y"])], [("shape", np.array([2, 2]))])
broken("whole_numbers", [node("Cast", ["x"], ["y"], to=TensorProto.INT64)])
broken("half", [node("Add", ["x", "c"], ["y"])], [("c", weights(4).astype(np.float16))])
elsewhere = numpy_helper.from_array(weights(4), "c")
elsewhere.data_location = TensorProto.EXTERNAL
broken("elsewhere", [node("Add", ["x", "c"], ["y"])], [elsewhere])
short = numpy_helper.from_array(weights(4), "c")
short.dims[0] = 5
broken("short", [node("Add", ["x", "c"], ["y"])], [short])
broken("empty", [], outputs=())
broken("old", [node("Clip", ["x"], ["y"], min=-0.5, max=0.5)], opset=6)
doubling = [node("Concat", [f"x{i}" if i else "x"] * 2, [f"x{i + 1}"], axis=1) for i in range(40)]
broken("doubling", [*doubling, node("Relu", ["x40"], ["y"])])

lines = []
for name, made in good.items():
    session = onnxruntime.InferenceSession(made.SerializeToString(), providers=["CPUExecutionProvider"])
    for scale in (0.1, 1.0, 1.0, 10.0):
        inputs = {each.name: (RANDOM.normal(0, scale, (1, each.shape[1]))).astype(np.float32) for each in session.get_inputs()}
        outputs = session.run(None, inputs)
        numbers = [" ".join(repr(float(number)) for value in values for number in value.ravel()) for values in (inputs.values(), outputs)]
        lines.append(f"{name}: {numbers[0]} -> {numbers[1]}")
(HERE / "expected.txt").write_text("\n".join(lines) + "\n")

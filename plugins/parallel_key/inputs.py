"""Inputs of the parallel key."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

from diecut_report.api import POINTS, Annotated, Block, CurveInput, FromTable, Inputs, OneOf, Quantity, Text

# fmt: off


class KeyLoadCase(Block):
    """A load case beside the run."""

    name: Annotated[Literal["engage", "start", "stop"], Text("Engagement of the clutch, start of the motor, or stop by the brake")]
    torque: Annotated[float, Quantity("T_j", "N*m", "Torque of the load case, its size", ge=0)]


class ParallelKey(Inputs):
    """Keys of ``parallel_key``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("torque", "application_factor"), ("torque_curve",), shared=("application_factor",)),
        OneOf(("width", "height", "depth_shaft", "depth_hub"), optional=True),
        OneOf(("load_direction_factor",), ("flank_changes",), ("required_life", "cycle_speed"), optional=True),
    )
    curve_keys: ClassVar[dict[str, str]] = {"torque": "torque_curve"}
    from_tables: ClassVar[tuple[FromTable, ...]] = (
        FromTable(
            "key",
            "keys",
            {name: name for name in ("width", "height", "depth_shaft", "depth_hub", "chamfer", "yield_key")},
        ),
    )

    shaft_diameter: Annotated[float, Quantity("d", "mm", "Diameter of the shaft; the table has keys for 10 (not included) to 200 mm", gt=0)]
    key: Annotated[str | None, Text("Key: an entry of keys in a table of your own, in place of its dimensions")] = None
    key_length: Annotated[float | None,
        Quantity("l", "mm", "Length of the key; if omitted, the smallest sufficient standard length is selected", gt=0)] = None
    form: Annotated[Literal["A", "B"], Text("Form of the key's ends: A round, B square")] = "A"
    key_count: Annotated[int, Quantity("i", "1", "Number of keys around the shaft", ge=1, le=2, integer=True)] = 1
    torque: Annotated[float | None, Quantity("T", "N*m", "Torque, signed; a reference to a curve over a cycle is used as torque_curve")] = None
    torque_curve: Annotated[Any | None, CurveInput("T_φ", "N*m", "Torque over a cycle, signed, in the place of torque")] = None
    torque_peak: Annotated[float | None, Quantity("T_max", "N*m", "Rare peak of the torque; default: the maximum absolute torque", gt=0)] = None
    load_cases: Annotated[list[KeyLoadCase], Text("Load cases beside the run, each as a maximum torque")] = []  # noqa: RUF012
    application_factor: Annotated[float | None,
        Quantity("K_A", "1", "Application factor; default 1 with a curve, which includes the dynamics", ge=1)] = None
    yield_shaft: Annotated[float, Quantity("R_eW", "MPa", "Yield strength of the shaft", gt=0)]
    yield_hub: Annotated[float, Quantity("R_eN", "MPa", "Yield strength of the hub; of a brittle one its tensile strength", gt=0)]
    yield_key: Annotated[float, Quantity("R_eP", "MPa", "Yield strength of the key (C45+C; set that of your own)", gt=0)] = 335
    brittle_hub: Annotated[bool, Text("Hub of grey cast iron")] = False
    load_peak_factor: Annotated[float, Quantity("f_L", "1", "Load peak factor: increases the allowable pressure for rare peaks", ge=1, le=1.5)] = 1.0
    load_distribution_factor: Annotated[float,
        Quantity("K_λ", "1",
            "Load distribution factor: unevenness of the load over the length; 1.2 is from one source only, give that of your joint with its "
                "basis", ge=1, le=2)] = 1.2
    load_direction_factor: Annotated[float | None,
        Quantity("f_wg", "1", "Load direction factor of a reversing torque, in place of the life", ge=0.2, le=1)] = None
    flank_changes: Annotated[float | None,
        Quantity("N_Wg", "1", "Number of load direction changes in the whole life, instead of the life", ge=0, plausible=("1", "1e12"))] = None
    required_life: Annotated[float | None,
        Quantity("L_h", "h", "Life for which the load direction changes of torque_curve are counted", gt=0)] = None
    cycle_speed: Annotated[float | None, Quantity("n_c", "rpm", "Cycle rate of the torque, as a speed: 1 r/min is one cycle per minute", gt=0)] = None
    chamfer: Annotated[float, Quantity("s", "mm", "Chamfer of the key, subtracted from the bearing heights in shaft and hub", ge=0)] = 0
    hub_length: Annotated[float | None, Quantity("l_H", "mm", "Length of the hub", gt=0)] = None
    width: Annotated[float | None, Quantity("b", "mm", "Width of the key; default: from the table", gt=0)] = None
    height: Annotated[float | None, Quantity("h", "mm", "Height of the key; default: from the table", gt=0)] = None
    depth_shaft: Annotated[float | None, Quantity("t_1", "mm", "Depth of the shaft keyway; default: from the table", gt=0)] = None
    depth_hub: Annotated[float | None, Quantity("t_2", "mm", "Depth of the hub keyway; default: from the table", gt=0)] = None
    n_points: Annotated[int, POINTS] = 360

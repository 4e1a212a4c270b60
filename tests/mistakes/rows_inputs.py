"""Inputs. The file of a plugin."""

from __future__ import annotations

from tests.mistakes.rows import load, tested

# fmt: off

INPUTS = (
    load("an input without a Quantity",
         'bulk_density: Annotated[float, Quantity("γ", "kg/m**3", "Density of the loose waste", gt=0)] = 120', "bulk_density: float = 120",
         "bulk_density", "Quantity"),
    load("a yes or no without a Text", "    height: Annotated[", "    closed: bool = True\n    height: Annotated[", "closed", "Text"),
    load("plausible sizes of another kind of quantity", '"Mass of the belt", gt=0', '"Mass of the belt", gt=0, plausible=("1 mm", "1 m")',
         "belt_mass", "1 mm", "kg/m"),
    load("plausible sizes without a unit", '"Mass of the belt", gt=0', '"Mass of the belt", gt=0, plausible=(0, 9)', "belt_mass",
         "plausible"),
    load("a default that is not a number", "gt=0, le=100)] = 75", 'gt=0, le=100)] = "most"', "filling", "most"),
    load("no value as default of what must have one", "gt=0, le=100)] = 75", "gt=0, le=100)] = None", "filling", "None"),
    load("bounds that nothing keeps", '"Share of a bucket that may be filled", gt=0, le=100',
         '"Share of a bucket that may be filled", gt=100, le=0', "filling", "100", "0"),
    load("bounds that nothing keeps of what has no default", '"Height of lift", gt=0, le=60', '"Height of lift", gt=60, le=0', "height",
         "60", "exchange"),
    load("a free text in a lookup", 'lagging: Annotated[Literal["bare", "rubber"]', "lagging: Annotated[str", "head_friction", "lagging",
         placed=False),
    load("an optional input without its default", 'Quantity("T_0", "N", "Pull of the take-up on each strand", ge=0)] = None',
         'Quantity("T_0", "N", "Pull of the take-up on each strand", ge=0)]', "pretension", "None"),
    load("a quantity without a description", 'Quantity("q_b", "kg/m", "Mass of the belt", gt=0)', 'Quantity("q_b", "kg/m", gt=0)',
         "Quantity", "description", placed=False),
    load("a misspelt bound", 'Quantity("q_b", "kg/m", "Mass of the belt", gt=0)', 'Quantity("q_b", "kg/m", "Mass of the belt", min=0)',
         "Quantity", "min", placed=False),
    load("a text as a bound", '"Mass of the belt", gt=0', '"Mass of the belt", gt="0 kg/m"', "belt_mass", "0 kg/m"),
    load("inputs that are not Inputs", "class Elevator(Inputs):", "class Elevator(Block):", "Elevator", "Inputs"),
    load("inputs of no class at all", "class Elevator(Inputs):", "class Elevator:", "Elevator", "Inputs"),
    load("like parts that are not a Block", "class Pulley(Block):", "class Pulley:", "Pulley|pulleys", "Block"),
    load("like parts that are a model of pydantic", "class Pulley(Block):", "class Pulley(BaseModel):", "pulleys", "Block",
         also=(("import numpy as np\n", "import numpy as np\nfrom pydantic import BaseModel\n"),)),
    load("inputs as an object", "inputs=Elevator,", "inputs=Elevator(),", "Elevator|inputs"),
    load("a whole number that is not declared whole", "height: Annotated[float", "height: Annotated[int", "height", "integer"),
    load("an input that is named as a key of the program", "    height: Annotated[",
         '    kind: Annotated[float, Quantity("k", "1", "Kind")] = 1\n    height: Annotated[', "kind"),
    load("a temperature in degrees Celsius", "    height: Annotated[",
         '    warmth: Annotated[float, Quantity("t", "degC", "Warmth")] = 20\n    height: Annotated[', "warmth", "degC"),
    tested("symbol and unit exchanged", 'Quantity("H", "m", "Height of lift"', 'Quantity("m", "H", "Height of lift"',
         "height|hanging_weight"),
    tested("an input that nothing takes", "    height: Annotated[",
         '    slope: Annotated[float, Quantity("β", "deg", "Slope", ge=0)] = 0\n    height: Annotated[', "slope"),
)

MODULE = (
    load("no MECHANISM", "MECHANISM = Mechanism(", "ELEVATOR = Mechanism(", "MECHANISM", placed=False),
    load("another thing as MECHANISM", "MECHANISM = Mechanism(", "MECHANISM = dict(", "dict", "Mechanism", placed=False),
    load("a kind that is not the file's name", 'kind="bucket_elevator"', 'kind="elevator"', "'elevator'", "bucket_elevator", placed=False),
    load("no version", '    version="1.0",\n', "", "version"),
    load("a number as version", 'version="1.0"', "version=1.0", "version", "text"),
    load("a colon is missing", "class Pulley(Block):", "class Pulley(Block)", "SyntaxError", "expected ':'"),
    load("a bracket is not closed", 'CHECKS = (\n    Check(id="filling"', 'CHECKS = (\n    Check((id="filling"', "SyntaxError"),
    load("a tab among spaces", "    slope = np.arcsin", "\tslope = np.arcsin", "IndentationError|TabError"),
    load("a wrong indent", "    slope = np.arcsin", "  slope = np.arcsin", "IndentationError"),
    load("an unknown name of the api", "    Chapter,\n", "    Chaptre,\n", "Chaptre", r"diecut_report\.api"),
    load("a name that is not imported", "    Profile,\n", "", "NameError", "Profile", placed=False),
    load("an import of the engine", "import numpy as np\n", "import numpy as np\nfrom diecut_report.machine.steps.run import calculate\n",
         r"diecut_report\.machine\.steps\.run", r"diecut_report\.api"),
    load("an import of what the api has from elsewhere", "import numpy as np\n",
         "import numpy as np\nfrom diecut_report.mechanism.steps import Value\n", r"diecut_report\.mechanism\.steps",
         r"import Value from diecut_report\.api"),
    load("an import of a library that is not there", "import numpy as np\n", "import numpy as np\nimport sympie\n", "sympie"),
)

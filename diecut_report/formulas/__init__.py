"""A formula is written once, as a small Python function: it computes, and its own syntax tree prints.

A formula is a lambda or a function marked by ``@formula`` whose parameters are named for what it takes (SI), whose body holds
assignments of intermediate terms and one return, in plain NumPy. Calling it computes, on numbers and on arrays; ``.tree`` is
what prints. The tree is read on first use only, so that importing a plugin costs nothing for it.
"""

from typing import Any

from numpy.typing import NDArray

Array = NDArray[Any]

"""The machine's parts (``machine``, ``shafts``, ``meshes``, ``chains``, ``belts``): each dimension typed once, and the calculations made of them."""

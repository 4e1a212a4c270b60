"""The press as one machine: phases of its lines on the main shaft, their margins and offsets, torques that add up there.

All angles are radians of the main shaft, all times seconds, unless a docstring says otherwise; functions take one machine.
Source of all of it: the derivations of this method (cyclogram), with the sources named there.
"""

"""Robots that reach goals among moving people: plans, controllers, a simulator and its experiments (docs/python.md).

Units are SI, angles radians, positions [m] in the world frame. What comes in is copied, what goes out is numpy's.
Bad input raises ValueError (InputError from files) that names key, value and limit.
"""
from ._core import *  # noqa: F401,F403
from ._core import __version__  # noqa: F401

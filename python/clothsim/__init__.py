"""Cloth on the GPU and the CPU, the same to the bit.

>>> import clothsim
>>> sim = clothsim.Simulation("pinned2", backend="cpu", **{"cloth.ks": 500})
>>> sim.step_frames(30)
>>> sim.time, sim.positions.shape
(0.333..., (1024, 3))
"""

from ._clothsim import (
    Error,
    InputOutputError,
    OpenGlError,
    SceneError,
    Simulation,
    SimulationError,
    UsageError,
    __version__,
    scenes,
    set_threads,
)

__all__ = [
    "Error",
    "InputOutputError",
    "OpenGlError",
    "SceneError",
    "Simulation",
    "SimulationError",
    "UsageError",
    "__version__",
    "scenes",
    "set_threads",
]

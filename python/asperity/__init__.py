# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Asperity from Python: run scenes, load results, sweep, plot.

    import asperity
    result = asperity.run("scenes/first-contact.toml", {"surface.rms": 2.0}, out="results/rms-2")
    result.binding_energy / result.delta_gamma          # meV/Å² over meV/Å²
    result.series["force"], result.series.unit("force") # numpy array, "eV/Å"
    result.fields["relaxed"].pressure                 # GPa, [y, x]
    result.plot.separation()                            # draws into a matplotlib axes
    sweep = asperity.sweep("scene.toml", {"surface.rms": [0.5, 1, 2]}, jobs=2)
    sweep.table["binding_energy"]                       # numpy array, a value a point
    asperity.estimate("scene.toml").quote()             # "γ_eff = 1170 ± 14 mJ/m² ...": with its error and the causes
    asperity.theory("scene.toml"), .check, .plan, .surface, .cost  # as the commands
    sim = asperity.Simulation("scene.toml")             # the engine in a loop of your own (docs/howto/python-engine.md)
    sim.step(500); sim.force; sim.u.z                   # eV/Å; a view of the displacements, Å

The program reads and checks scenes and does the physics; this package starts the program, reads its results and draws
them. Errors of the program are the exceptions SceneError, PhysicsError, InputOutputError and Stopped.
"""

from typing import TYPE_CHECKING

from .errors import Error, InputOutputError, InternalError, PhysicsError, SceneError, SceneWarning, Stopped, UnknownName, WrongCall

if TYPE_CHECKING:
    from .commands.adhesion import Adhesion as Adhesion, adhesion as adhesion
    from .commands.cost import cost as cost
    from .commands.curve import curve as curve
    from .commands.export import export as export
    from .commands.stress import stress as stress
    from .commands.theory import theory as theory
    from .commands.tip import tip as tip
    from .functions import check as check, defaults as defaults, plan as plan, surface as surface
    from .maps.convert import convert as convert
    from .results.result import Result as Result, load as load
    from .running.engine import Simulation as Simulation, State as State, Statics as Statics
    from .running.runs import run as run
    from .studies.curves import Curves as Curves, load_curve as load_curve
    from .studies.estimate import Estimate as Estimate, load_estimate as load_estimate
    from .studies.estimates import estimate as estimate
    from .studies.prony import prony as prony
    from .studies.states import states as states
    from .studies.stress import Stress as Stress
    from .studies.sweeps import Sweep as Sweep, load_sweep as load_sweep, sweep as sweep
    from .studies.tip import Tip as Tip, load_tip as load_tip

_LAZY = {"run": ".running.runs", "load": ".results.result", "sweep": ".studies.sweeps", "load_sweep": ".studies.sweeps",
         "estimate": ".studies.estimates", "load_estimate": ".studies.estimate", "adhesion": ".commands.adhesion",
         "curve": ".commands.curve", "load_curve": ".studies.curves", "Curves": ".studies.curves", "tip": ".commands.tip",
         "load_tip": ".studies.tip", "stress": ".commands.stress", "Tip": ".studies.tip", "Stress": ".studies.stress",
         "Result": ".results.result", "Sweep": ".studies.sweeps", "Estimate": ".studies.estimate", "Adhesion": ".commands.adhesion",
         "Simulation": ".running.engine", "State": ".running.engine", "Statics": ".running.engine", "states": ".studies.states",
         "check": ".functions", "plan": ".functions", "surface": ".functions", "defaults": ".functions", "theory": ".commands.theory",
         "cost": ".commands.cost", "convert": ".maps.convert", "prony": ".studies.prony", "export": ".commands.export"}
"""Where each name is, in the order of the reference."""
_MODULES = {"crack": (".crack",), "plots": (".plots.style", ".plots"), "theories": (".theories.combined", ".theories")}
"""Modules that are there after `import asperity`, each with those that it is to hold."""
__all__ = ["Error", "InputOutputError", "InternalError", "PhysicsError", "SceneError", "SceneWarning", "Stopped", "UnknownName", "WrongCall",
           *(name for name, module in _LAZY.items() if module != ".running.engine" and name != "states")]


def __getattr__(name: str):
    # numpy and h5py are imported with the first name that needs them, so that --help needs neither.
    import importlib

    if name in _LAZY:
        return getattr(importlib.import_module(_LAZY[name], __name__), name)
    if name in _MODULES:
        return [importlib.import_module(module, __name__) for module in _MODULES[name]][-1]
    if name == "__version__":
        return importlib.import_module(".running.program", __name__).version()
    if name.startswith("_"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    raise UnknownName.among(__name__, name, [one for one in __dir__() if not one.startswith("_")])


def __dir__() -> list[str]:
    """Returns the names for dir(), help() and completion; Simulation, Statics and states if the compiled module exists."""
    import importlib

    names = {*__all__, *_MODULES, "__version__"}
    try:
        importlib.import_module(".running.engine", __name__)
        names |= _LAZY.keys()
    except ImportError:
        pass
    return sorted(names | {name for name in globals() if name.startswith("__")})

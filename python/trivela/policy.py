"""A policy written in Python, for simulation."""
from __future__ import annotations

from typing import Any, Callable, Mapping, Tuple

from . import _trivela
from ._trivela import Cycle, Output

#: Usual value, least and most of a setting.
Setting = Tuple[float, float, float]


def register_policy(
    name: str,
    evaluate: Callable[[Cycle, "dict[str, Any]"], Output],
    settings: "Mapping[str, Setting] | None" = None,
) -> None:
    """Makes a policy known, so that `simulate` has an arm of that name.

    name      1 to 31 of a-z, 0-9 and _, a letter first; no built-in policy's
    evaluate  called as evaluate(cycle, memory) in each cycle of 20 ms in which something may be decided; returns an Output
    settings  by their keys: usual value, least and most. An arm sets one by {"policy": {"own": {name: {key: value}}}}

    `cycle` says where the robot is, how it moves, and what it knows of opponents and keeper, with units in the names. It is valid while
    `evaluate` runs. `cycle.moving()`, `cycle.stopped()` and `cycle.predictive()` are the Outputs of the built-in policies in this cycle,
    `cycle.shot(target_x_m)` is power and predicted crossing of a kick at that point of the goal line, `cycle.setting(key)` a setting.

    `memory` is a dict that is empty when a possession begins. The Output acts by `reason` ("fire" kicks), `power`, `kick_kind`,
    `vx_mps`, `vy_mps` and `omega_radps` (the drive command, in the robot's frame); its other numbers are recorded.

    What holds for every policy stays around it: no kick while the game stands, without the ball, with the kicker not ready.
    The same name again replaces the function, as a notebook does; its settings cannot change.

    `evaluate` must depend on its arguments alone: no clock and no random numbers, or the same call gives other rows.
    What `evaluate` raises ends the play and is raised by `simulate`. Raises ValueError for a name or settings that cannot be.
    """
    if not callable(evaluate):
        raise ValueError(f"policy {name}: evaluate is no function")
    numbers: dict[str, tuple[float, ...]] = {}
    for key, values in dict(settings or {}).items():
        try:
            usual, least, most = values
            numbers[key] = (float(usual), float(least), float(most))
        except (TypeError, ValueError):
            raise ValueError(f"policy {name}: setting {key}: {values!r} is not (usual value, least, most)") from None
    _trivela.register_policy(str(name), numbers, evaluate)

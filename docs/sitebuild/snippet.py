"""How a part is written in a scene: its stated examples under the key where its kind stands."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import yaml

from clast.config.examples import example, stated
from clast.errors import PluginError
from clast.plugins.registered import Registered

_PLACES: dict[str, Callable[[Any], Any]] = {
    "generator": lambda part: {"particles": part},
    "bond_model": lambda part: {"bonds": {"model": part}},
    "bond_kinematics": lambda part: {"bonds": {"kinematics": part}},
    "contact_law": lambda part: {"contacts": {"law": part}},
    "integrator": lambda part: {"integrator": part},
    "damping": lambda part: {"damping": part},
    "neighbour_search": lambda part: {"neighbours": part},
    "wall": lambda part: {"walls": {"plate": part | {"material": "steel"}}},
    "motion": lambda part: {"walls": {"plate": {"motion": part}}},
    "body_force": lambda part: {"body_forces": [part]},
    "stop": lambda part: {"stop": [part]},
    "writer": lambda part: {"output": {"writers": [part]}},
}


def snippet(entry: Registered) -> str:
    """Return the YAML in fences; where the part states no examples, a sentence that says so and its bare name."""
    written = {"type": entry.name, **stated(entry.part.Params)}
    place = _PLACES.get(entry.kind, lambda part: part)
    shown = f"```yaml\n{_text(place(written))}```"
    try:
        example(entry.part.Params)
    except PluginError:
        return f"It states no examples of all that it needs; the parameters above say what else.\n\n{shown}"
    return shown


def _text(written: Any) -> str:
    return yaml.safe_dump(written, sort_keys=False, allow_unicode=True, default_flow_style=None, width=100)

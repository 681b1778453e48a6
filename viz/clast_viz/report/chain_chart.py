"""Force chains: the contact network of a bed seen from the side, and how its forces are distributed."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.results.run import Run
from clast_viz.chains import Chains, force_chains, pieces
from clast_viz.report.axes import finish
from clast_viz.report.grain_charts import Shown

Floats = NDArray[np.float64]
MOST = 3000
"""Links that are drawn: more would be a black field, and a page of megabytes."""
COLOUR = "#1f5f8b"
THICKEST = 3.5
"""Line width in points of links with the force that one of a hundred exceeds."""
CAPTION = (
    "Lines join the centres of grains or fragments in contact, and go on to where they touch walls; the stronger the "
    "force between them, the thicker and darker."
)


class Network(NamedTuple):
    """Links of the frame in which a bed is pressed most, and its strain and time in s."""

    links: Chains
    strain: float
    time: float


def network(run: Run) -> Network | None:
    """Return the network of the frame in which contacts press most; None where none press, or none are kept."""
    pressed = [_pressed(run, k) for k in range(run.n_frames)]
    if not max(pressed, default=0.0) > 0.0:
        return None
    k = int(np.argmax(pressed))
    frame, found = run.frame(k), run.contacts(k)
    assert found is not None
    links = force_chains(frame, found, pieces(run, frame), None)
    return Network(links, frame.strain, frame.time) if len(links.force) > 1 else None


def _pressed(run: Run, k: int) -> float:
    found = run.contacts(k)
    return 0.0 if found is None else float(np.abs(found.normal_force).sum())


def chain_chart(shown: Shown, found: Network) -> Any:
    """Draw the network from the side of the bed, and the distribution of its forces."""
    from matplotlib.figure import Figure

    figure: Any = Figure(figsize=(6.2, 5.6), layout="constrained")
    side, spread = figure.subplots(2, 1, height_ratios=[1.9, 1.0])
    _draw_links(side, shown, found.links)
    _draw_distribution(spread, found.links.force.astype(np.float64))
    return figure


def _draw_links(axes: Any, shown: Shown, links: Chains) -> None:
    """Draw the strongest links, the weaker ones first, in mm over the lower plate and from the axis."""
    from matplotlib.collections import LineCollection
    from matplotlib.colors import to_rgb

    bed = shown.found.bed
    across = np.linalg.svd(bed.axis[None])[2][1]
    ends = links.ends[:MOST].astype(np.float64) - bed.origin
    lines = 1e3 * np.stack([ends @ across, ends @ bed.axis], axis=-1)[::-1]
    share = np.clip(links.force[:MOST] / np.quantile(links.force, 0.99), 0.0, 1.0)[::-1]
    colours = [(*to_rgb(COLOUR), 0.15 + 0.85 * each) for each in share.tolist()]
    axes.add_collection(
        LineCollection(list(lines), linewidths=0.2 + THICKEST * share, colors=colours, capstyle="round")
    )
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_xlabel("aside of the axis [mm]")
    axes.set_ylabel("height [mm]")


def _draw_distribution(axes: Any, force: Floats) -> None:
    """Draw the probability density of the force over its mean."""
    relative = force / force.mean()
    edges = np.linspace(0.0, float(relative.max()), max(8, min(40, round(len(force) ** 0.5))))
    density = np.histogram(relative, edges, density=True)[0]
    axes.stairs(density, edges, color=COLOUR, fill=True, alpha=0.75)
    finish(axes, "force / mean force", "probability density")


def sentence(found: Network) -> str:
    """Return how unequally the forces are shared, as a caption tells it."""
    force = found.links.force.astype(np.float64)  # the strongest first
    half = int(np.searchsorted(np.cumsum(force), 0.5 * force.sum())) + 1
    drawn = f"; the strongest {MOST} are drawn" if len(force) > MOST else ""
    return (
        f"{len(force)} links with {force.mean():.3g} N on average; {half / len(force):.0%} of them carry half "
        f"of all force{drawn}. "
    )

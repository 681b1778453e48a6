"""Layout of a recording: what the viewer shows when it opens the file."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.run import Run
from clast_viz.damage import shows_damage
from clast_viz.recording_plot import HEIGHT, LINE, WIDTH, Plot
from clast_viz.recording_series import shown_series
from clast_viz.recording_time import Timelines

BACKGROUND = (249, 250, 252)
PLAYED_IN_S = 12.0  # seconds the whole run takes at the playback speed the file opens with
GRAIN_COLOURS = ((176, 184, 194), (214, 190, 150), (158, 188, 176), (190, 168, 190), (170, 178, 214))
BALL_SIZE = 0.4  # of the radius, so that bonds are seen between the particles


def layout(run: Run, timelines: Timelines, plot: Plot | None) -> Any:
    """Arrange the grain on the left, curves and events on the right."""
    import rerun.blueprint as rrb

    right = []
    if plot is not None:
        right.append(_plot_view(len(run.reference)))
    right += _series_views(run)
    if _has_events(run):
        columns = rrb.TextLogColumns(text_log_columns=["LogLevel", "Body"])
        right.append(rrb.TextLogView(origin="events", name="Events", columns=columns))
    scene = _scene_views(run)
    duration = float(timelines.time[-1] - timelines.time[0])
    panel = rrb.TimePanel(
        state="collapsed", timeline="time", playback_speed=duration / PLAYED_IN_S if duration > 0 else 1.0
    )
    return rrb.Blueprint(
        rrb.Horizontal(scene, rrb.Vertical(*right), column_shares=[3, 2]) if right else scene,
        panel,
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        auto_views=False,
    )


def _has_events(run: Run) -> bool:
    return len(run.bond_ends) > 0 or bool(np.isnan(run.frame(-1).position).any())


def magnification(run: Run) -> float:
    """Return by how many powers of ten the viewer shows the scene larger: its camera sees nothing below 1 cm.

    Positions in the file stay in m; a transform above them magnifies.
    """
    size = _bounds(run)[1]
    return float(10.0 ** np.ceil(-np.log10(size)))


def grain_colours(run: Run) -> NDArray[np.uint8]:
    """Return for each particle the colour that tells materials apart, or grains where there is one material only."""
    several = bool(np.any(run.material != run.material[0]))
    number = run.material.astype(np.intp) if several or len(run.bond_ends) == 0 else np.maximum(run.grain, 0)
    colours: NDArray[np.uint8] = np.array(GRAIN_COLOURS, np.uint8)[number % len(GRAIN_COLOURS)]
    return colours


def _scene_views(run: Run) -> Any:
    import rerun as rr
    import rerun.blueprint as rrb

    particles = "/scene/particles"
    only_spheres = ["- /scene/bonds", "- /scene/cracks", "- /scene/force_chains"]
    several = shows_damage(run)
    plain = rr.Points3D.from_fields(colors=grain_colours(run)) if several else None
    views = [_scene_view(run, "Grains" if several else "Grain", only_spheres, {particles: plain} if plain else {})]
    if len(run.bond_ends):
        small = (BALL_SIZE * run.radius).astype(np.float32)
        colours = {"colors": grain_colours(run)} if several else {}
        balls = {particles: rr.Points3D.from_fields(radii=small, **colours)}
        name = "Load in the bonds (red: tension, blue: compression)"
        views.insert(0, _scene_view(run, name, ["- /scene/force_chains"], balls))
    if run.contacts(0) is not None:
        name = "Force chains (thick and dark: strong)"
        views.append(_scene_view(run, name, ["- /scene/bonds", "- /scene/cracks", f"- {particles}"], {}))
    if several:
        views.insert(
            0, _scene_view(run, "Damage of the grains (grey: none, dark red: all bonds broken)", only_spheres, {})
        )
    return rrb.Tabs(*views, active_tab=0) if len(views) > 1 else views[0]


def _scene_view(run: Run, name: str, without: list[str], overrides: dict[str, Any]) -> Any:
    import rerun.blueprint as rrb

    centre, size = _bounds(run)
    centre, size = centre * magnification(run), size * magnification(run)
    return rrb.Spatial3DView(
        origin="/",
        contents=["+ /scene/**", *without],
        name=name,
        background=BACKGROUND,
        line_grid=False,
        overrides=overrides,
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital,
            position=centre + size * np.array([0.6, -1.2, 0.42]),
            look_target=centre,
            eye_up=(0.0, 0.0, 1.0),
        ),
    )


def _bounds(run: Run) -> tuple[np.ndarray[Any, np.dtype[np.float64]], float]:
    position = run.frame(0).position.astype(np.float64)
    if not np.isfinite(position).any():
        return np.zeros(3), 1.0
    low, high = np.nanmin(position, axis=0), np.nanmax(position, axis=0)
    return 0.5 * (low + high), float(np.linalg.norm(high - low)) + 2.0 * float(run.radius.max())


def _plot_view(references: int) -> Any:
    import rerun.blueprint as rrb

    return rrb.Spatial2DView(
        origin="stress_strain",
        name="Stress over strain",
        visual_bounds=rrb.VisualBounds2D(
            x_range=(-0.14 * WIDTH, 1.06 * WIDTH),
            y_range=(-1.18 * HEIGHT - LINE * max(references - 1, 0), 0.24 * HEIGHT),
        ),
    )


def _series_views(run: Run) -> list[Any]:
    import rerun.blueprint as rrb

    series = shown_series(run)
    views = []
    if len(run.bond_ends):
        views.append(("Bonds broken", [series["bonds_broken"].entity]))
    if "stress_Pa" in series:
        views.append(("Stress [MPa]", [series["stress_Pa"].entity]))
    forces = [entry.entity for column, entry in series.items() if column.startswith("force_")]
    if forces:
        views.append(("Forces on the walls [N]", forces))
    energies = [entry.entity for column, entry in series.items() if column.startswith("energy_")]
    if energies:
        views.append(("Energy [J]", energies))
    shown = [
        rrb.TimeSeriesView(origin="/", contents=[f"+ /{entity}" for entity in entities], name=name)
        for name, entities in views
    ]
    return [rrb.Tabs(*shown, active_tab=0)] if shown else []

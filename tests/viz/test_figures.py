"""Figures and pictures are drawn where there is something to draw, and say in one sentence where not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import clast_viz.picture
import clast_viz.picture_parts
import clast_viz.renderer
from clast.errors import RunError
from clast.results.run import Run
from clast_viz.compare import plot_stress_strain
from clast_viz.curves import peak, peak_frame
from clast_viz.figure import FigureParams, write_figure
from clast_viz.loads import colour_of, signed_load
from clast_viz.picture import PictureParams, write_picture
from clast_viz.renderer import RendererProbe

SMALL = PictureParams(width=320, height=240)


def pixels(path: Path) -> NDArray[np.float32]:
    from matplotlib.image import imread

    return np.asarray(imread(path), dtype=np.float32)[..., :3]


def has_colour(path: Path, rgb: str) -> bool:
    wanted = np.array([int(rgb[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    return bool((np.abs(pixels(path) - wanted).max(axis=-1) < 0.02).any())


def test_figure_shows_curve_reference_and_bonds(grain: Run, tmp_path: Path) -> None:
    path = tmp_path / "stress_strain.png"
    assert write_figure(grain, FigureParams(dpi=100), path).path == path
    assert has_colour(path, "#b2182b")
    assert has_colour(path, "#2166ac")
    assert has_colour(path, "#7f8792")


def test_figure_is_the_same_each_time(grain: Run, tmp_path: Path) -> None:
    for name in ("a.png", "b.png"):
        write_figure(grain, FigureParams(dpi=60), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_figure_is_skipped_without_a_curve(spheres: Run, tmp_path: Path) -> None:
    written = write_figure(spheres, FigureParams(), tmp_path / "stress_strain.png")
    assert written.path is None
    assert "no compression" in written.skipped
    assert not any(tmp_path.glob("*.png"))


def test_peak_and_its_frame(grain: Run, spheres: Run) -> None:
    top = peak(grain)
    assert top.strain == pytest.approx(0.18, abs=0.003)
    assert top.stress == pytest.approx(4.2e6, rel=0.02)
    assert grain.frame(peak_frame(grain)).strain <= top.strain < grain.frame(peak_frame(grain) + 1).strain
    assert peak_frame(spheres) == spheres.n_frames - 1


def test_comparison_draws_one_curve_per_run(grain: Run, tmp_path: Path) -> None:
    path = plot_stress_strain([grain, grain], ["Model 1", "Model 2"], tmp_path / "compare.png", dpi=60)
    assert has_colour(path, "#228833")


def test_comparison_refuses_runs_without_curve_and_missing_labels(grain: Run, spheres: Run, tmp_path: Path) -> None:
    with pytest.raises(RunError, match="no compression curve"):
        plot_stress_strain([grain, spheres], ["a", "b"], tmp_path / "compare.png")
    with pytest.raises(RunError, match="one label per run"):
        plot_stress_strain([grain], ["a", "b"], tmp_path / "compare.png")


def test_load_is_signed_by_the_side_and_absent_when_broken(grain: Run) -> None:
    frame = grain.frame(6)
    load = signed_load(frame)
    assert np.isnan(load[~frame.bond_intact]).all()
    np.testing.assert_array_equal(np.abs(load[frame.bond_intact]), frame.bond_failure[frame.bond_intact])
    assert ((load < 0) == (frame.bond_stress < 0))[frame.bond_intact].all()


def test_tension_is_red_and_compression_blue() -> None:
    compression, tension = colour_of(np.array([-0.8, 0.8], dtype=np.float32)).astype(int)
    assert compression[2] > compression[0] + 80
    assert tension[0] > tension[2] + 80


def test_picture_is_skipped_with_advice_where_nothing_renders(
    grain: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clast_viz.renderer, "_PROBE", "import os; os.kill(os.getpid(), 11)")
    written = write_picture(grain, SMALL, tmp_path / "picture.png")
    assert written.path is None
    assert "apt install libegl1" in written.skipped


@pytest.fixture(scope="module")
def _renderer() -> None:
    if not RendererProbe().can_render():
        pytest.skip("no OpenGL renderer on this machine")


@pytest.mark.usefixtures("_renderer")
def test_picture_shows_loaded_bonds_in_both_colours(grain: Run, tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    assert write_picture(grain, SMALL, path).path == path
    image = pixels(path)
    assert image.shape == (240, 320, 3)
    above_scale = image[:190]
    assert (above_scale[..., 0] - above_scale[..., 2] > 0.3).sum() > 50
    assert (above_scale[..., 2] - above_scale[..., 0] > 0.3).sum() > 50


@pytest.mark.usefixtures("_renderer")
@pytest.mark.parametrize("most_spheres", [0, 10])
def test_picture_of_two_spheres(
    spheres: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, most_spheres: int
) -> None:
    monkeypatch.setattr(clast_viz.picture_parts, "MOST_SPHERES", most_spheres)
    path = tmp_path / "picture.png"
    write_picture(spheres, SMALL, path)
    covered = (pixels(path) < 0.9).any(axis=-1).mean()
    assert 0.05 < covered < 0.6

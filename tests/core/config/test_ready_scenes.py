"""Every scene that comes with Clast is valid, and says the same when resolved; so is every study and calibration."""

from pathlib import Path

import pytest

from clast.calibration.config import load_calibration
from clast.config.scene import from_mapping, load
from clast.config.yaml_loader import dump_yaml, parse_document, read_document
from clast.forecast import forecast
from clast.studies.config import load_study
from clast.studies.tasks import tasks

CONFIGS = Path(__file__).parents[3] / "configs"
FILES = sorted(CONFIGS.rglob("*.yaml"))


def said_to_be(*kinds: str) -> list[Path]:
    """Return the files that are of some kind: they begin with its key, where scenes have a name."""
    return [path for path in FILES if read_document(path).data.keys() & {*kinds}]


@pytest.mark.parametrize("path", said_to_be("materials"), ids=lambda path: path.stem)
def test_a_ready_scene_is_valid_and_survives_being_resolved(path):
    scene = load(path)
    assert forecast(scene).particles > 0
    plain = parse_document(dump_yaml(scene.resolved())).data
    assert from_mapping(plain).resolved() == scene.resolved()


@pytest.mark.parametrize("path", said_to_be("study", "calibration"), ids=lambda path: path.stem)
def test_a_ready_study_is_valid(path):
    if path in said_to_be("study"):
        assert tasks(load_study(path))
    else:
        assert load_calibration(path).points > 4


def test_every_file_is_a_scene_a_study_or_a_calibration():
    assert set(FILES) == set(said_to_be("materials", "study", "calibration"))

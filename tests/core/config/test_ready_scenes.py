"""Every scene that comes with Clast is valid, and says the same when resolved."""

from pathlib import Path

import pytest

from clast.config.scene import from_mapping, load
from clast.config.yaml_loader import dump_yaml, parse_document
from clast.forecast import forecast

CONFIGS = Path(__file__).parents[3] / "configs"


@pytest.mark.parametrize("path", sorted(CONFIGS.rglob("*.yaml")), ids=lambda path: path.stem)
def test_a_ready_scene_is_valid_and_survives_being_resolved(path):
    scene = load(path)
    assert forecast(scene).particles > 0
    plain = parse_document(dump_yaml(scene.resolved())).data
    assert from_mapping(plain).resolved() == scene.resolved()

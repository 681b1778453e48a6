"""Who asks for a coefficient of restitution, and who has none."""

import pytest
from tests.scenes import COLLISION, write

from clast.config.scene import load
from clast.errors import ConfigError

GIVEN = "{restitution: 0.5, sliding_friction: 0.3}"


@pytest.mark.parametrize(
    ("law", "pair", "message"),
    [
        (
            "hertz_mindlin",
            "{sliding_friction: 0.3}",
            "pairs.default.restitution: this key is missing",
        ),
        (
            "{type: hertz_kuwabara_kono, dissipative_time: 1 us}",
            GIVEN,
            "pairs.default.restitution: 'hertz_kuwabara_kono' damps by parameters of its own and has no coefficient of "
            "restitution; leave this key out",
        ),
    ],
)
def test_a_restitution_that_is_missing_or_has_no_use_is_told_with_its_place(tmp_path, law, pair, message):
    text = COLLISION.replace("law: hertz_mindlin", f"law: {law}").replace(GIVEN, pair)
    with pytest.raises(ConfigError) as told:
        load(write(tmp_path, text))
    assert f"contacts.{message}" in str(told.value)


def test_a_law_with_damping_of_its_own_needs_none_and_resolves_to_itself(tmp_path):
    law = "law: {type: hertz_kuwabara_kono, dissipative_time: 1 us}"
    scene = load(write(tmp_path, COLLISION.replace("law: hertz_mindlin", law).replace(GIVEN, "{}")))
    assert scene.changed({"contacts.pairs": scene.resolved()["contacts"]["pairs"]}).contacts == scene.contacts

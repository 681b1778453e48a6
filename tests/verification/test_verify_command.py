"""``clast verify``: the table, the choice of cases, and laws of a third party."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from clast.cli import main

LAWS = Path(__file__).with_name("laws.py")
LINEAR = Path(__file__).parents[2] / "docs" / "examples" / "my_law.py"


def verify(*arguments):
    return CliRunner().invoke(main, ["verify", *(str(each) for each in arguments)])


def failed(law, case, kind="--contact-law"):
    """Return the quantities of a case that a law of the tests gets wrong."""
    result = verify(case, "--plugin", LAWS, kind, law, "--json")
    (outcome,) = json.loads(result.stdout)
    assert result.exit_code == (1 if outcome["verdict"] == "failed" else 0)
    return {found["quantity"] for found in outcome["findings"] if not found["passed"]}


def test_the_table_has_numbers_errors_bounds_and_a_total():
    result = verify("chung_ooi_2")
    assert result.exit_code == 0
    head, first, *_, last = result.stdout.splitlines()
    assert head.split() == ["case", "quantity", "expected", "got", "error", "bound", "time"]
    assert first.startswith("chung_ooi_2  magnesium alloy: peak force, N")
    assert "7232.68" in first
    assert last.startswith("1 cases: 1 passed;")


def test_cases_are_listed_with_their_scenes():
    told = verify("--list").stdout
    assert "chung_ooi_1" in told
    assert "chung_ooi_3_restitution.yaml" in told


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["chung_ooi_33"], "no case is named 'chung_ooi_33'; did you mean 'chung_ooi_3'?"),
        (["--family", "impact"], "no family is named 'impact'; did you mean 'impacts'?"),
        (
            ["chung_ooi_1", "--contact-law", "hertz_minlin"],
            "no contact law is named 'hertz_minlin'; did you mean 'hertz_mindlin'?",
        ),
        (
            ["chung_ooi_1", "--plugin", LINEAR, "--contact-law", "spring_dashpot"],
            "--contact-law spring_dashpot: contacts.law.stiffness: this key is missing: Stiffness k",
        ),
        (
            ["chung_ooi_1", "--bond-model", "elastic"],
            "--bond-model elastic: none of the chosen cases has bonds; 'clast verify --list' shows all",
        ),
        (
            ["chung_ooi_1", "--set", "bonds.damping=0.1"],
            "--set bonds.damping=0.1: none of the chosen cases has bonds; 'clast verify --list' shows all",
        ),
    ],
)
def test_what_cannot_be_done_is_said_before_anything_runs(arguments, message):
    result = verify(*arguments)
    assert (result.exit_code, result.stdout, result.stderr) == (2, "", message + "\n")


def test_the_law_of_a_plugin_is_put_through_the_cases_by_name():
    assert failed("faithful", "chung_ooi_1") == set()


def test_a_stiffness_wrong_by_2_percent_is_caught():
    """Force and overlap go with the power 2/5 of the stiffness: 0.8 %, where 0.1 % is allowed."""
    quantities = ("peak force, N", "peak overlap, m", "duration, s")
    assert failed("too_stiff", "chung_ooi_1") == {f"{m}: {q}" for m in ("limestone", "glass") for q in quantities}
    assert len(failed("too_stiff", "chung_ooi_2")) == 6


@pytest.mark.parametrize(("kind", "law"), [("contact-law", "too_little_energy"), ("bond-model", "too_much_energy")])
def test_an_energy_wrong_by_2_percent_is_caught_by_the_ledger(kind, law):
    assert failed(law, "run_ledger", f"--{kind}") == {"energy missing or too much: largest share"}


def test_an_energy_that_cannot_be_compiled_is_told_with_its_file():
    result = verify("run_ledger", "--plugin", LAWS, "--contact-law", "beyond_the_compiler")
    assert result.exit_code == 1
    assert "laws.py:" in result.output
    assert "cannot be compiled" in " ".join(result.output.split())
    assert isinstance(result.exception, SystemExit)


def test_a_law_that_does_not_tell_its_losses_has_no_ledger_to_close():
    result = verify("run_ledger", "--plugin", LAWS, "--contact-law", "silent", "--json")
    assert json.loads(result.stdout)[0]["verdict"] == "not applicable"


def test_a_damping_wrong_by_2_percent_is_caught():
    wrong = failed("underdamped", "chung_ooi_3")
    assert "v'/v at e = 0.2, 400 steps per contact" in wrong
    assert "v'/v at e = 1, 400 steps per contact" not in wrong


def test_the_bond_model_of_a_plugin_is_put_through_the_cases_by_name():
    for case in ("bond_stiffness", "bond_elastic"):
        assert failed("faithful_bond", case, "--bond-model") == set()


def test_a_bond_2_percent_too_soft_in_shear_is_caught():
    assert failed("soft_in_shear", "bond_stiffness", "--bond-model") == {"GA/L, N/m"}
    assert "shear: step in which it breaks" in failed("soft_in_shear", "bond_elastic", "--bond-model")


def test_a_bond_2_percent_too_stiff_in_bending_is_caught_by_beams():
    assert failed("stiff_in_bending", "beam_vibration", "--bond-model") == {"first bending frequency, rad/s"}
    wrong = failed("stiff_in_bending", "beam_roll_up", "--bond-model")
    assert "gap between both ends, share of the length" in wrong
    wrong = failed("stiff_in_bending", "beam_cantilever", "--bond-model")
    assert {f"{n} bonds: deflection of the tip, m" for n in (4, 8, 16)} <= wrong


def test_a_strength_wrong_by_a_thousandth_is_caught():
    broken_late = {"tension", "bending", "tension and bending", "compression and bending"}
    wrong = failed("too_strong", "bond_elastic", "--bond-model")
    assert wrong == {f"{load}: step in which it breaks" for load in broken_late}
    assert failed("too_strong", "bond_stiffness", "--bond-model") == set()


def test_a_bond_model_of_another_kind_meets_the_cases_that_say_something_about_it():
    given = ("--set", "bonds.model.damage_strain=0.001", "--set", "bonds.model.breakage_strain=0.004")
    result = verify("bond_stiffness", "bond_elastic", "--plugin", LINEAR, "--bond-model", "softening", *given)
    assert result.exit_code == 0
    assert "GA/L, N/m" in result.stdout
    assert "not applicable: 'softening' has no normal_strength and no" in result.stdout


def test_a_bond_that_declares_another_stiffness_than_it_has_is_caught():
    assert failed("declares_too_much", "bond_stiffness", "--bond-model") == {"EA/L, N/m", "EI/L, N m"}


def test_a_bond_that_is_no_cylinder_is_not_compared_with_one():
    result = verify("bond_stiffness", "--plugin", LAWS, "--bond-model", "no_cylinder")
    assert result.exit_code == 0
    assert "not applicable: the stiffnesses that 'no_cylinder' declares are not those" in " ".join(
        result.stdout.split()
    )


@pytest.mark.parametrize("case", ["chung_ooi_4", "chung_ooi_5", "chung_ooi_6", "chung_ooi_8"])
@pytest.mark.parametrize("law", ["too_rough", pytest.param("pushing", marks=pytest.mark.long)])
def test_friction_of_a_wrong_size_or_sign_is_caught_where_it_slides(law, case):
    assert any("slides" in quantity for quantity in failed(law, case))


def test_a_tangential_stiffness_wrong_by_2_percent_is_caught_where_it_sticks():
    """The fine run of the wrong law agrees with its coarse one; only the closed form tells."""
    assert failed("too_soft_sideways", "chung_ooi_5") == set()
    assert {f"{each}, 400 steps: slip'/slip" for each in ("steel", "polymer")} <= failed(
        "too_soft_sideways", "sticking_impact"
    )


def test_velocities_of_another_time_are_not_asked_for_an_energy():
    result = verify("rotation_pair", "--integrator", "leapfrog")
    assert result.exit_code == 0
    assert "not applicable: the velocities of 'leapfrog' belong to another" in " ".join(result.stdout.split())


def test_a_case_that_says_nothing_about_a_law_says_why():
    arguments = ("--plugin", LINEAR, "--contact-law", "spring_dashpot", "--set", "contacts.law.stiffness=1e6")
    result = verify("chung_ooi_1", *arguments)
    assert result.exit_code == 0
    assert "not applicable: the stiffness of 'spring_dashpot' does not grow" in " ".join(result.stdout.split())
    result = verify("chung_ooi_3", "--set", "contacts.law.tension_cutoff=true")
    assert "not applicable: with tension_cutoff" in result.stdout

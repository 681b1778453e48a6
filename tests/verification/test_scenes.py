"""What cases are about does happen in their scenes."""

from clast.verification.bench import Bench
from clast.verification.reading import spin, velocity


def kinetic(simulation):
    """Return the kinetic energy in J."""
    scene, v, w = simulation.scene, velocity(simulation), spin(simulation)
    inertia = 0.4 * scene.mass * scene.radius**2
    return 0.5 * float((scene.mass * (v**2).sum(axis=1) + inertia * (w**2).sum(axis=1)).sum())


def test_the_cubes_break_and_rub_before_their_momentum_is_compared():
    bench = Bench("run_clusters")
    start, end = bench.start(), bench.run()
    assert end.bonds_broken > 0.3 * len(end.scene.ends)
    assert kinetic(end) < 0.7 * kinetic(start)


def test_the_bond_that_is_turned_is_stretched_sheared_twisted_and_bent():
    loads = Bench("rotation_bond").run().bond_loads()[0]
    assert (loads[[2, 3, 4, 5]] > 0.0).all()

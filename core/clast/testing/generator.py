"""What holds for every generator: a sound packing, the same for the same parameters, as foretold."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from clast.parts.generator import Generator, Packing, Site
from clast.testing.claim import Claim, claim, must

DENSITY = 2500.0


def claims(generator: Generator, params: Any) -> list[Claim]:
    """Return what a generator with parameters must keep to; it packs twice."""
    made: list[Packing] = []

    foretells = generator.predict is not None

    def packing() -> Packing:
        must(bool(made), "not tried: there is no packing")
        return made[0]

    return [
        claim("it packs", lambda: made.append(generate(generator, params))),
        claim("it makes particles, and every table has a row for each", lambda: _tables(packing())),
        claim("every number is one, radii are above 0, materials are known", lambda: _numbers(packing())),
        claim("particles overlap only where they are relieved of it", lambda: _apart(packing())),
        claim("bonds join two particles each, no two of them the same", lambda: _bonds(packing())),
        claim("the same parameters give the same packing", lambda: _again(packing(), generate(generator, params))),
        *([claim("what is foretold comes true", lambda: _foretold(generator, params, packing()))] if foretells else []),
    ]


def generate(generator: Generator, params: Any) -> Packing:
    """Return a packing made in an empty folder, with a material of any name."""
    with tempfile.TemporaryDirectory() as folder:
        return generator.generate(params, _site(folder))


class _AnyMaterial(dict[str, float]):
    def __missing__(self, name: str) -> float:
        return DENSITY


def _site(folder: str) -> Site:
    return Site(Path(folder), _AnyMaterial(glass=DENSITY))


def _tables(made: Packing) -> None:
    n = len(made.position)
    must(n > 0, "it makes no particle")
    shapes = {
        "position": (n, 3),
        "radius": (n,),
        "velocity": (n, 3),
        "spin": (n, 3),
        "prescribed": (n,),
        "grain": (n,),
    }
    for name, shape in shapes.items():
        found = np.shape(getattr(made, name))
        must(found == shape, f"'{name}' has the shape {found}; {shape} is needed")
    must(len(made.material) == n, f"'material' names {len(made.material)} particles of {n}")


def _numbers(made: Packing) -> None:
    for name in ("position", "radius", "velocity", "spin"):
        must(bool(np.isfinite(getattr(made, name)).all()), f"'{name}' holds something that is no number")
    must(bool((made.radius > 0.0).all()), "a radius is not above 0")
    must(all(isinstance(name, str) and name for name in made.material), "a particle has no material")
    must(bool((np.asarray(made.grain) >= -1).all()), "a grain has a number below -1")


def _apart(made: Packing) -> None:
    from scipy.spatial import cKDTree

    pairs = cKDTree(made.position).query_pairs(2.0 * float(made.radius.max()), output_type="ndarray")
    if made.relieved or len(pairs) == 0:
        return
    i, j = pairs.T
    overlap = made.radius[i] + made.radius[j] - np.linalg.norm(made.position[i] - made.position[j], axis=1)
    worst = int(np.argmax(overlap))
    share = float(overlap[worst] / min(made.radius[i[worst]], made.radius[j[worst]]))
    must(share < 1e-3, f"particles {i[worst]} and {j[worst]} overlap by {share:.2%} of the smaller radius")


def _bonds(made: Packing) -> None:
    if made.bonds is None:
        return
    ends, n = np.sort(np.asarray(made.bonds.ends), axis=1), len(made.position)
    must(bool(((ends >= 0) & (ends < n)).all()), f"a bond names a particle that is none of {n}")
    must(bool((ends[:, 0] != ends[:, 1]).all()), "a bond joins a particle to itself")
    must(len(np.unique(ends, axis=0)) == len(ends), "two particles are bonded twice")
    must(bool((np.asarray(made.bonds.diameter) > 0.0).all()), "a bond has no diameter above 0")


def _again(one: Packing, other: Packing) -> None:
    for name in ("position", "radius", "velocity", "spin", "grain"):
        same = np.array_equal(getattr(one, name), getattr(other, name))
        must(same, f"'{name}' differs from one call to the next: random numbers need a seed of the parameters")


def _foretold(generator: Generator, params: Any, made: Packing) -> None:
    assert generator.predict is not None
    with tempfile.TemporaryDirectory() as folder:
        told = generator.predict(params, _site(folder), None)
    n, band = len(made.position), told.particles * told.particles_band
    must(abs(n - told.particles) <= band, f"'predict' tells {told.particles} ± {band:g} particles; there are {n}")
    smallest = float(made.radius.min())
    must(
        abs(told.radius - smallest) <= 0.05 * smallest,
        f"'predict' tells the radius {told.radius:g} m, not {smallest:g}",
    )

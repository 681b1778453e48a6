"""Small scenes that several tests run."""

from __future__ import annotations

from math import cos, pi, sin
from pathlib import Path

CRUSH = """
name: small
materials:
  glass: {density: 570 kg/m3, young_modulus: 420 MPa, poisson_ratio: 0.2}
  steel: {density: 7850 kg/m3, young_modulus: 210 GPa, poisson_ratio: 0.3}
particles:
  type: spherical_agglomerate
  material: glass
  diameter: 1.2 mm
  primary_diameter: 0.25 mm
  primaries: 55
  seed: 3
bonds:
  between: {max_gap: 0.125 mm}
  model:
    type: micro_cracking
    young_modulus: 420 MPa
    poisson_ratio: 0.2
    yield_stress: 2 MPa
    breakage_strain: 0.0075
    compressive_break: 2
    weakening_factor: 0.5
contacts:
  law: hertz_mindlin
  pairs: {default: {restitution: 0.5, sliding_friction: 0.05, rolling_friction: 0.05}}
walls:
  upper:
    type: plane
    material: steel
    point: [0, 0, 0.6 mm]
    normal: [0, 0, -1]
    motion: {type: constant_velocity, velocity: [0, 0, -10 mm/s]}
  lower: {type: plane, material: steel, point: [0, 0, -0.6 mm], normal: [0, 0, 1]}
compression: {upper: upper, lower: lower, height: 1.2 mm, diameter: 1.2 mm}
time: {mass_scaling: 100, step: 4e-7 s, end: {strain: 0.3}}
output: {samples: 60, frames: 12, writers: [], checkpoint: 0.1 s}
"""
"""A grain of 55 primaries that breaks while it is pressed; a few seconds."""

COLLISION = """
name: collision
materials:
  glass: {density: 2500 kg/m3, young_modulus: 100 MPa, poisson_ratio: 0.25}
particles:
  type: explicit
  material: glass
  particles:
    - {position: [-1.0005 mm, 0, 0], radius: 1 mm, velocity: [0.1 m/s, 0, 0]}
    - {position: [1.0005 mm, 0, 0], radius: 1 mm, velocity: [-0.1 m/s, 0, 0]}
contacts:
  law: hertz_mindlin
  pairs: {default: {restitution: 0.5, sliding_friction: 0.3}}
time: {step: 1e-7 s, end: {time: 4e-4 s}}
output: {samples: 400, frames: 4, writers: [], tracks: {particles: [0, 1]}}
"""
"""Two equal spheres that meet head-on."""


def stl_text(triangles: list[list[list[float]]]) -> str:
    """Return triangles as the text of an STL file."""
    lines = ["solid made"]
    for each in triangles:
        corners = [f"vertex {x} {y} {z}" for x, y, z in each]
        lines += ["facet normal 0 0 0", "outer loop", *corners, "endloop", "endfacet"]
    return "\n".join([*lines, "endsolid made\n"])


def write(folder: Path, text: str, name: str = "scene.yaml") -> Path:
    """Write a scene file and return its path."""
    path = folder / name
    path.write_text(text)
    return path


def bed(layers: int = 2, primaries: int = 30, strain: float = 0.35, contacts: str = "auto") -> str:
    """Return a scene of ``layers`` times three grains in a tube that are pressed by a plate, like :data:`CRUSH`."""
    grains = [_grain(layer, k, primaries) for layer in range(layers) for k in range(3)]
    height = 1.2 + 1.0 * (layers - 1)
    head, rest = CRUSH.split("particles:\n")
    tail = rest[rest.index("bonds:\n") : rest.index("walls:\n")]
    return f"""{head.replace("small", "bed")}particles:
{"".join(grains)}{tail}walls:
  upper:
    type: plane
    material: steel
    point: [0, 0, {height:.3f} mm]
    normal: [0, 0, -1]
    motion: {{type: constant_velocity, velocity: [0, 0, -100 mm/s]}}
  lower: {{type: plane, material: steel, point: [0, 0, 0], normal: [0, 0, 1]}}
  tube: {{type: cylinder, material: steel, point: [0, 0, 0], axis: [0, 0, 1], radius: 1.31 mm}}
compression: {{upper: upper, lower: lower, height: {height:.3f} mm, diameter: 2.62 mm}}
time: {{mass_scaling: 100, step: 4e-7 s, end: {{strain: {strain}}}}}
output: {{samples: 60, frames: 12, writers: [], checkpoint: 0.1 s, contacts: {contacts}}}
"""


def _grain(layer: int, k: int, primaries: int) -> str:
    angle = 2.0 * pi * (k + 0.5 * layer) / 3.0
    x, y, z = 0.7 * cos(angle), 0.7 * sin(angle), 0.6 + 1.0 * layer
    return f"""  - type: spherical_agglomerate
    material: glass
    diameter: 1.2 mm
    primary_diameter: 0.25 mm
    primaries: {primaries}
    seed: {1 + 3 * layer + k}
    centre: [{x:.6f} mm, {y:.6f} mm, {z:.6f} mm]
"""

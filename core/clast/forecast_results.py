"""How large the results of a run become: nearly all of them are frames."""

from __future__ import annotations

from clast.config.scene import SceneConfig

PARTICLE_BYTES, ORIENTATION_BYTES, BOND_BYTES, CONTACT_BYTES = 24.0, 16.0, 9.0, 40.0
# beside the contacts that frames keep: guessed for grains of some hundred primaries, most of which lie inside
CONTACTS_PER_PARTICLE = 0.3
LARGE_BYTES = 4e9


def frame_count(config: SceneConfig) -> int:
    """Return how many frames a run keeps, the first and the last among them."""
    return config.output.frames + 1 if config.output.frames else 0


def frame_bytes(config: SceneConfig, particles: float, bonds: float) -> float:
    """Return about how many bytes one frame takes."""
    turned = config.bonds is not None and config.bonds.kinematics.part.needs_orientation
    each = PARTICLE_BYTES + (ORIENTATION_BYTES if turned else 0.0)
    if config.contacts is not None and config.output.contacts is not False:
        each += CONTACTS_PER_PARTICLE * CONTACT_BYTES
    return each * particles + BOND_BYTES * bonds


def results_text(config: SceneConfig, particles: float, bonds: float) -> str:
    """Tell about how large the results become."""
    frames, size = frame_count(config), frame_bytes(config, particles, bonds)
    if not frames:
        return "curves only: output.frames is 0"
    return f"about {_megabytes(frames * size)} MB: {frames:,} frames of {_megabytes(size)} MB"


def size_concerns(config: SceneConfig, particles: float, bonds: float) -> list[str]:
    """Return a line for the user where results become large."""
    frames, size = frame_count(config), frame_bytes(config, particles, bonds)
    if frames * size <= LARGE_BYTES:
        return []
    fitting = max(int(LARGE_BYTES / size) - 1, 1)
    return [
        f"{config.document.where(('output', 'frames'))}: output.frames: the results need about "
        f"{frames * size / 1e9:,.0f} GB of disk, {_megabytes(size)} MB a frame; {fitting} frames would need "
        f"{(fitting + 1) * size / 1e9:,.0f} GB"
    ]


def _megabytes(size: float) -> str:
    """Return a size in MB as sure as it is known.

    >>> _megabytes(2.68e9), _megabytes(31234.0)
    ('2,680', '0.03')
    """
    mb = size / 1e6
    return f"{mb:,.0f}" if mb >= 10.0 else f"{mb:.1f}" if mb >= 1.0 else f"{mb:.1g}"

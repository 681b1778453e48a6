"""Random numbers that depend on what they are for, not on when they are drawn.

Source: J. K. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC'11, doi:10.1145/2063384.2063405
(Philox4x32-10). Written with 64-bit integers and masks, so plain Python and compiled code give the same bits.
"""

from __future__ import annotations

MASK = 0xFFFFFFFF
KEY = 0x636C6173


def product(a: int, b: int) -> tuple[int, int]:
    """Return the upper and the lower word of the product of two 32-bit words, without overflow of 64 signed bits."""
    low = (a & 0xFFFF) * b
    high = (a >> 16) * b + (low >> 16)
    return high >> 16, ((high & 0xFFFF) << 16) | (low & 0xFFFF)


def philox(c0: int, c1: int, c2: int, c3: int, k0: int, k1: int) -> tuple[int, int, int, int]:
    """Return four random 32-bit words for a counter of four and a key of two 32-bit words.

    >>> [hex(word) for word in philox(0, 0, 0, 0, 0, 0)]
    ['0x6627e8d5', '0xe169c58d', '0xbc57ac4c', '0x9b00dbd8']
    """
    for _ in range(10):
        high0, low0 = product(0xD2511F53, c0)
        high1, low1 = product(0xCD9E8D57, c2)
        c0, c1, c2, c3 = high1 ^ c1 ^ k0, low1, high0 ^ c3 ^ k1, low0
        k0 = (k0 + 0x9E3779B9) & MASK
        k1 = (k1 + 0xBB67AE85) & MASK
    return c0, c1, c2, c3


def uniform(seed: int, owner: int, component: int, event: int) -> float:
    """Return a number in the open interval (0, 1), the same for the same four integers, always.

    Parameters
    ----------
    seed : int
        Seed of the run, 0 … 2³²−1.
    owner : int
        Stable number of what draws, e.g. of a bond.
    component, event : int
        Which of the owner's quantities draws, and for the how-manieth time.

    Examples
    --------
    >>> round(uniform(1, 7, 0, 0), 6) == round(uniform(1, 7, 0, 0), 6)
    True
    """
    a, b, _, _ = philox(owner & MASK, (owner >> 32) & MASK, component & MASK, event & MASK, seed & MASK, KEY)
    # 26 bits of each word; every sum and product is exact
    return ((a >> 6) * 67108864.0 + (b >> 6) + 0.5) / 4503599627370496.0

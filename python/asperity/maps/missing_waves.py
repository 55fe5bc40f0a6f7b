# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The roughness that a map does not show: its spectrum continued to waves shorter than four pixels, and what these waves
could do to the adhesion.

A self-affine spectrum C = C₁ (q/q₁)^(-2-2H), q₁ the wave number of four pixels, is fitted to the longer waves of the map.
In full contact the waves beyond q₁ store the energy per area (Persson, Eur. Phys. J. E 8, 385 (2002))

    e = (π/2) E* ∫ q² C dq = (π/2) E* C₁ q₁³ / (2H - 1),    ½ < H,

which is (E*/4) s² (2 - 2H) / ((2H - 1) q₁) with the rms slope s of this law from q = 0 to q₁ (H < 1). At H ≤ ½ the integral
has no limit, and ends at the wavelength of two atoms.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from . import height_map

PIXELS = 4
"""Pixels of the shortest wave that a map is trusted to show."""
DECADE = 10.0
"""The fit reaches from q₁ down by this factor, or to where the spectrum rolls off."""
WIDTH = 4.0
"""The least factor between the roll-off and q₁."""
ROLLED_OFF = 0.1
"""A map whose waves below four pixels hold less than this share of the law's energy has no roughness down to its pixel."""
ATOMS = 5.0
"""Å, the wavelength of two atoms."""
NEGLIGIBLE, DECISIVE, FACTOR = 0.01, 0.25, 4.0
"""Of the missing energy over Δγ: up to NEGLIGIBLE it is no matter, from DECISIVE on nothing can be said, and between them the
numbers are uncertain by FACTOR times it (docs/reports/validation.md)."""


class Law(NamedTuple):
    """A self-affine spectrum fitted to a map: hurst and its standard error, longest and shortest wave of the fit (Å), q₁ (1/Å),
    C₁ (Å⁴), and the energies over E* (Å) of the map's waves that a simulation leaves out, and of waves below four pixels."""

    hurst: float
    hurst_error: float
    longest: float
    shortest: float
    q1: float
    c1: float
    left_out: float
    beyond: float

    @property
    def missing(self) -> float:
        """Energy per area over E*, Å, that missing waves store in full contact."""
        return self.left_out + self.beyond


def energy_beyond(hurst: float, q1: float, c1: float) -> float:
    """Computes the energy of full contact in the waves of the law from q₁ on; for H ≤ ½ as far as the wavelength of two atoms."""
    if hurst > 0.5:
        return 0.5 * math.pi * c1 * q1**3 / (2.0 * hurst - 1.0)
    octaves = max(0.0, math.log(2.0 * math.pi / ATOMS / q1))
    power = 1.0 - 2.0 * hurst
    return 0.5 * math.pi * c1 * q1**3 * (math.expm1(power * octaves) / power if power > 1e-9 else octaves)


def spectrum_of(heights: np.ndarray, edge: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, bool]:
    """Computes the power spectrum of a map up to the Nyquist wave number. Of a map that is not periodic the mean plane is subtracted, and the rest
    multiplied by Hann's window."""
    n = len(heights)
    periodic = height_map.jump(heights) < height_map.PERIODIC
    flat = height_map.filled(height_map.without_tilt(heights) if periodic else height_map.without_plane(heights))
    weight = np.ones(n) if periodic else 1.0 - np.cos(2.0 * np.pi * (np.arange(n) + 0.5) / n)
    window = np.outer(weight, weight)
    power = np.abs(np.fft.fft2((flat - (flat * window).sum() / window.sum()) * window)) ** 2 / n**4 / (window**2).mean()
    k = np.rint(n * np.fft.fftfreq(n)).astype(int)
    squared = (k[:, None] ** 2 + k[None, :] ** 2).ravel()
    count = np.bincount(squared)
    rings = np.flatnonzero((count > 0) & (np.arange(len(count)) > 0) & (4 * np.arange(len(count)) <= n * n))
    mean = np.bincount(squared, power.ravel())[rings] / count[rings]
    return 2.0 * np.pi / edge * np.sqrt(rings), mean * (edge / (2.0 * np.pi)) ** 2, count[rings], periodic


def energy_shown(heights: np.ndarray, edge: float) -> float:
    """Computes the energy that the map's own waves store in full contact: (1/4) Σ q |h_q|²."""
    q, c, count, _ = spectrum_of(heights, edge)
    return 0.25 * float((q * c * count).sum()) * (2.0 * math.pi / edge) ** 2


def _fit(q: np.ndarray, c: np.ndarray, count: np.ndarray, q1: float) -> tuple[float, float, float]:
    """Returns H, C₁ and the roll-off of the law of largest likelihood (Whittle): the power of each mode is distributed
    exponentially about that of the law."""

    def law(rolloff: float, power: float) -> tuple[float, float]:
        shape = (np.maximum(q, rolloff) / q1) ** -power
        c1 = float((count * c / shape).sum() / count.sum())
        return (float((count * np.log(c1 * shape)).sum()), c1) if c1 > 0.0 else (math.inf, 0.0)

    best = (math.inf, 0.0, 0.0, 0.0)
    for rolloff in np.geomspace(q[0], max(q[0], q1 / WIDTH), 12):
        power = float(minimize_scalar(lambda p: law(rolloff, p)[0], bounds=(0.0, 12.0), method="bounded").x)
        cost, c1 = law(rolloff, power)
        if cost < best[0]:
            best = (cost, 0.5 * power - 1.0, c1, rolloff)
    return best[1:]


def law_of(heights: np.ndarray, edge: float, spacing: float) -> Law | None:
    """Derives the law from the spectrum of a map."""
    n = len(heights)
    pixel = edge / n
    q, c, count, periodic = spectrum_of(heights, edge)
    q1 = 2.0 * math.pi / (PIXELS * pixel)
    fitted = (q <= q1 * (1 + 1e-9)) & (q >= q1 / DECADE * (1 - 1e-9))
    if fitted.sum() < 3 or not (c[fitted] > 0.0).any():
        return None
    here = q[fitted], c[fitted], count[fitted]
    hurst, c1, rolloff = _fit(*here, q1)
    power = here[0] >= rolloff
    spread = here[2][power] * (np.log(here[0][power]) - np.average(np.log(here[0][power]), weights=here[2][power])) ** 2
    error = (1.0 if periodic else 2.0) / math.sqrt(max(0.5 * spread.sum(), 1e-9)) / 2.0  # modes of a window are not independent
    ring = (2.0 * math.pi / edge) ** 2 * count  # of the wave plane: energy = (E*/4) Σ q C ring
    law = c1 * (q / q1) ** (-2.0 - 2.0 * hurst)
    below = q > q1 * (1 + 1e-9)
    shown = (q * c * ring)[below].sum() / max((q * law * ring)[below].sum(), 1e-300)
    if shown < ROLLED_OFF:
        return None
    lost = (q > 2.0 * math.pi / (PIXELS * spacing) * (1 + 1e-9)) & ~below
    return Law(hurst, error, 2.0 * math.pi / max(rolloff, here[0][0]), 2.0 * math.pi / q1, q1, c1,
               0.25 * float((q * c * ring)[lost].sum()), energy_beyond(hurst, q1, c1))


class Verdict(NamedTuple):
    """relative: the error that missing waves give each number, over it; withheld: why no number is stated; what: in a few words;
    note: in a sentence."""

    relative: float
    withheld: str
    what: str
    note: str


def verdict(law: Law | None, modulus: float, adhesion: float, sites: str = "") -> Verdict:
    """Estimates the energy of the missing waves of a map and whether it matters."""
    if law is None:
        return Verdict(0.0, "", "none: the map has no roughness down to its pixel", "")
    share = modulus * law.missing / adhesion if adhesion > 0.0 else math.inf
    bounded = law.hurst > 0.5 or share < NEGLIGIBLE
    wave = f"waves below {0.1 * law.shortest:.3g} nm"
    stored = f"in full contact they would store {share:.2g} Δγ" if bounded else "at H of 0.5 or less their energy has no limit"
    spectrum = (f"the spectrum of the map has H = {law.hurst:.2f} ± {law.hurst_error:.2f} from {0.1 * law.longest:.3g} to "
                f"{0.1 * law.shortest:.3g} nm, and is continued with it")
    what = f"{wave}: {f'{share:.2g} Δγ, ' * bounded}H = {law.hurst:.2f}"
    if share < DECISIVE and bounded:
        judged = "this is negligible" if share < NEGLIGIBLE else (
            f"the numbers are uncertain by {100 * FACTOR * share:.2g} %, and likely too high")
        return Verdict(FACTOR * share, "", what, f"{wave} are missing or not trusted; {stored}: {judged} ({spectrum}).")
    return Verdict(0.0, f"roughness that the map does not show decides: {wave} are missing, and {stored} ({spectrum}); "
                   + _help(law, share, bounded, sites), what, "")


def _help(law: Law, share: float, bounded: bool, sites: str) -> str:
    """Tells what would have the numbers stated. share: the missing energy over Δγ; sites: setting of as many sites as show enough."""
    if sites:
        return f"{sites} shows enough of it"
    if not bounded or law.hurst <= 0.55:
        return "a map with smaller pixels shows more of it"
    pixel = 0.1 * law.shortest / PIXELS * (DECISIVE / share) ** (1.0 / (2.0 * law.hurst - 1.0))
    return f"a map with pixels of about {pixel:.2g} nm, or a solid that is {1.0 + share / DECISIVE:.2g} times softer, shows enough of it"

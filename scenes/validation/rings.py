# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""An axisymmetric body over an elastic half-space with the law of the program's exponential wall (docs/reports/validation.md).

The surface is cut into rings of constant pressure p. Their displacements at the middles of the rings are differences of those of
uniformly pressed discs, in complete elliptic integrals. The gap of ring i is

    g_i = d + shape_i + sum_j C_ij p(g_j),

d the height of the surface at rest. pulled() follows the solutions from contact outwards, whole() all equilibria of a body that
touches at its middle first. Nothing here is shared with the program.
Units: Å, eV.
"""
import numpy as np

# Sums over a square lattice: of 1/R less its mean, and of 1/R³.
PHI0, PHI2 = -3.9002649, 9.0336217


def elliptic(k2: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Complete integrals K and E of the parameter k² < 1, by the arithmetic-geometric mean."""
    a, b, power = np.ones_like(k2), np.sqrt(1 - k2), 1.0
    left = 1 - k2 / 2
    for _ in range(12):
        a, b, c2 = (a + b) / 2, np.sqrt(a * b), ((a - b) / 2) ** 2
        left = left - power * c2
        power *= 2
    return np.pi / (2 * a), left * np.pi / (2 * a)


def disc(radius: np.ndarray, r: np.ndarray) -> np.ndarray:
    """Displacement at r below a disc of this radius under unit pressure, E* = 1."""
    inside = r < radius
    small, large = np.where(inside, r, radius), np.where(inside, radius, r)
    k2 = (small / large) ** 2
    first, second = elliptic(k2)
    return 4 / np.pi * large * np.where(inside, second, second - (1 - k2) * first)


def towards(radius: float, finest: float) -> np.ndarray:
    """Radii of rings in a circle, finest at its edge and each next one 1.05 times as wide, up to a fortieth of the circle."""
    widths = [finest]
    while sum(widths) < radius:
        widths.append(min(1.05 * widths[-1], radius / 40))
    edges = np.append(0, np.cumsum(widths[::-1]))
    return edges * radius / edges[-1]


class Rings:
    def __init__(self, edges: np.ndarray, modulus: float, period: float = np.inf):
        """Rings between these radii (the first is 0). With a period the body repeats on a square lattice, its images' displacement
        taken to second order in radius over period, and d is the mean height of the surface."""
        self.r = (edges[1:] + edges[:-1]) / 2
        self.area = np.pi * np.diff(edges**2)
        of_disc = np.zeros((len(self.r), len(edges)))
        of_disc[:, 1:] = disc(edges[None, 1:], self.r[:, None])
        self.flexibility = np.diff(of_disc, axis=1) / modulus
        if np.isfinite(period):
            apart2 = self.r[:, None] ** 2 + self.r[None, :] ** 2
            self.flexibility += (PHI0 / period + PHI2 * apart2 / (4 * period**3)) * self.area / (np.pi * modulus)


class Exponential:
    """Pressure of a gap and its slope: work of adhesion w, range, stiffness of the repulsion."""

    def __init__(self, w: float, reach: float, stiffness: float):
        depth = 2 * w / (1 + np.sqrt(1 + 2 * w / (reach**2 * stiffness)))
        self.adhesion, self.reach, self.stiffness, self.tension = w, reach, stiffness, depth / reach

    def __call__(self, gap: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        attraction = self.tension * np.exp(-np.maximum(gap, 0) / self.reach)
        pressure = -self.stiffness * np.minimum(gap, 0) - attraction
        return pressure, np.where(gap < 0, -self.stiffness, attraction / self.reach)


def solve(rings: Rings, shape: np.ndarray, law: Exponential, height: float, gap: np.ndarray) -> np.ndarray | None:
    """The gaps at this height by Newton's method from these, or None."""
    for _ in range(30):
        pressure, slope = law(gap)
        off = gap - height - shape - rings.flexibility @ pressure
        change = np.linalg.solve(np.eye(len(shape)) - rings.flexibility * slope, off)
        gap = gap - change
        if np.abs(change).max() < 1e-9 * law.reach:
            return gap
    return None


def pulled(rings: Rings, shape: np.ndarray, law: Exponential, start: float, step: float, end: float) -> np.ndarray:
    """Heights, forces and contact radii from contact at the height `start` outwards, each solution from the last, to `end` or to
    where there is no other near the last. There the step is halved down to a thousandth of the range."""
    gap = np.minimum(start + shape, 0)
    for wider in (0, 8, 4, 2, 1):  # the first without adhesion
        eased = Exponential(law.adhesion * min(wider, 1), law.reach * max(wider, 1), law.stiffness)
        gap = solve(rings, shape, eased, start, gap)
        if gap is None:
            raise ArithmeticError(f"no solution at a height of {start} Å and {max(wider, 1)} times the range")
    rows, height = [], start
    while height < end and step > 1e-3 * law.reach:
        found = solve(rings, shape, law, height, gap)
        if found is None or np.abs(found - gap).max() > 5 * law.reach:
            height, step = height - step / 2, step / 2
            continue
        gap = found
        rows.append((height, rings.area @ law(gap)[0], np.sqrt(rings.area[gap < 0].sum() / np.pi)))
        height += step
    return np.array(rows).T


def whole(rings: Rings, shape: np.ndarray, law: Exponential, middle: np.ndarray) -> np.ndarray:
    """Heights, forces and contact radii of all equilibria, stable or not, of a body that is closest at its middle. middle: gaps
    there, descending from far apart to a contact, where a negative gap stands for the pressure; each solution begins from the last
    two."""
    count, rows = len(shape), []
    gap, height = middle[0] + shape, middle[0]
    before: tuple[np.ndarray, float, float] | None = None
    for at in middle:
        tries = [(gap, height)]
        if before is not None and gap[0] != before[2]:
            part = min(1.5, (at - gap[0]) / (gap[0] - before[2]))
            tries.insert(0, (gap + part * (gap - before[0]), height + part * (height - before[1])))
        last = gap, height, gap[0]
        for found, there in tries:
            found = np.append(at, found[1:])
            for _ in range(60):
                pressure, slope = law(found)
                matrix = np.eye(count) - rings.flexibility * slope
                matrix[:, 0] = -1  # the height is unknown in place of the gap at the middle
                change = np.linalg.solve(matrix, found - there - shape - rings.flexibility @ pressure)
                change *= min(1.0, 5 * law.reach / np.abs(change[1:]).max())
                there -= change[0]
                found = found - np.append(0, change[1:])
                if np.abs(change).max() < 1e-9 * law.reach:
                    break
            else:
                continue
            before, gap, height = last, found, there
            rows.append((height, rings.area @ law(gap)[0], np.sqrt(rings.area[gap < 0].sum() / np.pi)))
            break
        else:
            raise ArithmeticError(f"no solution with a gap of {at} at the middle")
    return np.array(rows).T

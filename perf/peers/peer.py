#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""One adhesive rough contact by another program, in the environment that setup.sh makes: peer.py tamaas|adhesion|lattice CASE.json.

The case has the map (npy, Å), the edge of the box (Å), E* (eV/Å³), w (eV/Å²), range (Å), the mean gap (Å) and the tolerance of the
residual (eV/Å for each site). Both programs solve for the gap over a hard wall at that mean gap. lattice: Adhesion, with the stiffness of
Asperity's block for each wave (npy, over E* q/2) in place of the half-space's. Writes what was found as JSON.
"""
import json
import sys
import time

import numpy as np


def tamaas(case: dict, heights: np.ndarray) -> tuple[np.ndarray, float, int]:
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(1)
    n, edge = heights.shape[0], case["edge"]
    start = time.process_time()
    model = tm.Model(tm.model_type.basic_2d, [edge, edge], [n, n])
    model.E, model.nu = case["modulus"], 0.0
    adhesion = tm.ExponentialAdhesionFunctional(heights)
    adhesion.parameters = {"rho": case["range"], "surface_energy": case["adhesion"]}
    solver = tm.PolonskyKeerRey(model, heights, case["relative"], tm.PolonskyKeerRey.gap, tm.PolonskyKeerRey.gap)
    solver.addFunctionalTerm(adhesion)
    solver.max_iter, solver.dump_freq = 5000, 10**9
    solver.solve(case["gap"])
    return np.array(model["gap"]), time.process_time() - start, -1


def adhesion(case: dict, heights: np.ndarray, softer: np.ndarray | None = None) -> tuple[np.ndarray, float, int]:
    from Adhesion.Interactions import Exponential
    from Adhesion.System import BoundedSmoothContactSystem
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from NuMPI.Optimization.CCGWithoutRestart import constrained_conjugate_gradients
    from SurfaceTopography import Topography

    n, edge = heights.shape[0], case["edge"]
    start = time.process_time()
    substrate = PeriodicFFTElasticHalfSpace((n, n), young=case["modulus"], physical_sizes=(edge, edge))
    if softer is not None:
        substrate.surface_stiffness = substrate.surface_stiffness * softer.T
        substrate.greens_function = substrate.greens_function / softer.T
    system = BoundedSmoothContactSystem(substrate, Exponential(case["adhesion"], case["range"]), Topography(heights, physical_sizes=(edge, edge)))
    offset = -case["gap"] - heights.mean()
    gap = np.maximum(0.0, case["gap"] + heights.mean() - heights)
    gap *= case["gap"] / gap.mean()
    found = constrained_conjugate_gradients(system.primal_objective(offset, gradient=True), system.primal_hessian_product, x0=gap.flatten(),
                                            mean_val=case["gap"], gtol=case["tolerance"], maxiter=5000)
    seconds = time.process_time() - start
    if not found.success:
        sys.exit(str(found.message))
    gap = np.asarray(found.x).reshape(n, n)
    return gap, seconds, int(found.nit)


def observables(case: dict, gap: np.ndarray, heights: np.ndarray, softer: np.ndarray | float = 1.0) -> dict:
    """Pressure, contact, energy for each area and residual of a gap, by one rule for all programs. softer: stiffness over E* q/2 (rfft2)."""
    n, edge, w, rho = gap.shape[0], case["edge"], case["adhesion"], case["range"]
    u = gap + heights
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(n, edge / n)[:, None], np.fft.rfftfreq(n, edge / n)[None, :])
    elastic = np.fft.irfft2(softer * case["modulus"] / 2 * q * np.fft.rfft2(u), s=(n, n))
    pull = w / rho * np.exp(-np.maximum(gap, 0) / rho)
    open_sites = gap > 1e-9 * edge
    pressure = -np.mean((elastic + pull)[open_sites])  # the uniform pressure of the free sites' balance
    return {"pressure": pressure, "area": 1.0 - np.mean(open_sites),
            "energy": float(0.5 * np.mean((u - u.mean()) * elastic) - w * np.mean(np.exp(-np.maximum(gap, 0) / rho))),
            "residual": float(np.max(np.abs((elastic + pull)[open_sites] + pressure)) * (edge / n) ** 2)}


def main() -> None:
    case = json.load(open(sys.argv[2]))
    heights = np.load(case["map"])
    softer = np.load(case["softer"]) if sys.argv[1] == "lattice" else None
    gap, seconds, iterations = tamaas(case, heights) if sys.argv[1] == "tamaas" else adhesion(case, heights, softer)
    found = observables(case, gap, heights, 1.0 if softer is None else softer)
    print(json.dumps({"seconds": seconds, "iterations": iterations} | found))


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# Names of results and of scenes with their types and units, for type checkers and editors: what a run has not is not
# there. Written by docs/reference.py from what the program says of itself; do not edit.
from typing import Any

import numpy as np

from .values import Values

class Units(Values):
    def __getattr__(self, name: str) -> Any: ...

class Failure(Values):
    exit_code: int
    """exit code of a command that failed"""
    reason: str
    """error message of the command"""

class Box(Values):
    softness: float
    """largest decrease of a wall's attraction with the gap, divided by the stiffness of the longest wave of the ..."""
    flat_loss: float
    """meV/Å^2: estimate of the energy that flat surfaces lose in this box in a cycle at a prescribed mean height, with ..."""

class WorkOfInterfaceUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of work_of_interface.approach"""
    pull_off: float
    """meV/Å^2: convergence of work_of_interface.pull_off"""

class WorkOfInterface(Values):
    approach: float
    """meV/Å^2: work of the interface during the approach"""
    pull_off: float
    """meV/Å^2: work of the interface during the pull-off, ∫ F dz"""
    uncertainty: WorkOfInterfaceUncertainty

class WorkOfDriveUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of work_of_drive.approach"""
    pull_off: float
    """meV/Å^2: convergence of work_of_drive.pull_off"""

class WorkOfDrive(Values):
    approach: float
    """meV/Å^2: work of the drive on the solids during the approach, from rest beyond the interaction range"""
    pull_off: float
    """meV/Å^2: work of the drive on the solids during the pull-off, until they are at rest beyond the interaction range"""
    uncertainty: WorkOfDriveUncertainty

class DissipatedInBlockUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of dissipated_in_block.approach"""
    pull_off: float
    """meV/Å^2: convergence of dissipated_in_block.pull_off"""

class DissipatedInBlock(Values):
    approach: float
    """meV/Å^2: energy dissipated by a viscoelastic block, during the approach"""
    pull_off: float
    """meV/Å^2: energy dissipated by a viscoelastic block, during the pull-off, with the recovery of the solids after they ..."""
    cycle: float
    """meV/Å^2: energy dissipated by a viscoelastic block, in a whole cycle, from and to rest beyond the interaction range"""
    uncertainty: DissipatedInBlockUncertainty

class DissipatedInSurfaceUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of dissipated_in_surface.approach"""
    pull_off: float
    """meV/Å^2: convergence of dissipated_in_surface.pull_off"""

class DissipatedInSurface(Values):
    approach: float
    """meV/Å^2: plastic work"""
    pull_off: float
    """meV/Å^2: plastic work"""
    cycle: float
    """meV/Å^2: plastic work"""
    uncertainty: DissipatedInSurfaceUncertainty

class LostUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of lost.approach"""
    pull_off: float
    """meV/Å^2: convergence of lost.pull_off"""

class Lost(Values):
    approach: float
    """meV/Å^2: energy damped, less the heat of noise, or of a quasi-static path dissipated at instabilities"""
    pull_off: float
    """meV/Å^2: energy damped, less the heat of noise, or of a quasi-static path dissipated at instabilities"""
    cycle: float
    """meV/Å^2: energy damped, less the heat of noise, or of a quasi-static path dissipated at instabilities"""
    uncertainty: LostUncertainty

class Kinetic(Values):
    approach: float
    """meV/Å^2: kinetic and vibrational energy left at the end of the approach"""
    pull_off: float
    """meV/Å^2: kinetic and vibrational energy left at the end of the pull-off"""

class Spring(Values):
    approach: float
    """meV/Å^2: energy of the spring that holds the top plane"""
    pull_off: float
    """meV/Å^2: energy of the spring that holds the top plane at the end of the pull-off"""

class Stored(Values):
    approach: float
    """meV/Å^2: change of the energy of interface and block"""
    pull_off: float
    """meV/Å^2: change of the energy of interface and block"""

class MeshErrorWorkOfDrive(Values):
    approach: float
    """meV/Å^2: error of work_of_drive.approach and lost.approach by the spacing, as mesh_error.binding_energy"""
    pull_off: float
    """meV/Å^2: error of work_of_drive.pull_off and lost.pull_off by the spacing, as mesh_error.binding_energy"""

class MeshError(Values):
    binding_energy: float
    """meV/Å^2: error of binding_energy by the spacing of a continuum over a wall, by a rule that many scenes meet"""
    work_of_drive: MeshErrorWorkOfDrive
    approach_force: float
    """eV/Å: error of approach_force by the spacing, as mesh_error.binding_energy"""
    pull_off_force: float
    """eV/Å: error of pull_off_force by the spacing, as mesh_error.binding_energy"""

class Jkr(Values):
    approach: float
    """meV/Å^2: work of adhesion by JKR, F/"""
    pull_off: float
    """meV/Å^2: work of adhesion by JKR, F/"""
    approach_averaged: float
    """meV/Å^2: as jkr.approach, from the largest attraction of a running mean over 2 ps, which removes the vibrations ..."""
    pull_off_averaged: float
    """meV/Å^2: as jkr.pull_off, from the largest attraction of a running mean over 2 ps"""
    edge_pinning: float
    """factor by which pinning of the contact edge at rows of sites makes pull_off_force and jkr.pull_off too ..."""
    relaxed: float
    """meV/Å^2: work of adhesion by JKR from the binding energy at zero load instead of a pull-off force"""

class ContactRadius(Values):
    relaxed: float
    """Å: √"""
    pull_off: float
    """Å: √"""

class Instrument(Values):
    approach_force: float
    """nN: approach_force in units of instruments"""
    pull_off_force: float
    """nN: pull_off_force in units of instruments"""
    contact_radius: float
    """nm: contact_radius.relaxed in units of instruments"""
    energy_lost: float
    """aJ: dissipated.energy in units of instruments"""
    edge_distance: float
    """nm: smallest distance of a contact from a free edge of the box on the path"""

class Segment(Values):
    segment: int
    """number of the segment in drive.path, from 0"""
    name: str
    """the segment's text in drive.path"""
    work_of_drive: float
    """meV/Å^2: work of the drive on the solids, including work sideways"""
    work_of_interface: float
    """meV/Å^2: work of the interface, ∫ F dz of the mean height"""
    dissipated_in_block: float
    """meV/Å^2: energy dissipated by a viscoelastic block, in the segment"""
    dissipated_in_surface: float
    """meV/Å^2: plastic work"""
    lost: float
    """meV/Å^2: energy damped, less the heat of noise, or of a quasi-static path dissipated at instabilities"""
    stored: float
    """meV/Å^2: change of the energy of interface and block"""
    work_of_settling: float
    """meV/Å^2: part of work_of_drive of a slide until steady"""
    kinetic: float
    """meV/Å^2: kinetic and vibrational energy left at the end of an approach or a pull-off of a dynamic path at T = 0, as ..."""
    spring: float
    """meV/Å^2: energy of the spring that holds the top plane at the end of an approach or a pull-off of a dynamic path at ..."""
    uncertainty: float
    """meV/Å^2: convergence of work_of_drive and of the losses"""
    largest_attraction: float
    """eV/Å: largest attraction in the segment"""
    friction: float
    """eV/Å: mean force against a slide"""
    largest_friction: float
    """eV/Å: largest force against a slide"""
    steady: str
    """slides over a wall"""
    running_in: float
    """Å: distance omitted at the beginning of the slide, for which the variance of the mean friction is least"""
    steady_friction: float
    """eV/Å: mean force against the slide"""
    steady_friction_error: float
    """eV/Å: error of steady_friction"""
    steady_friction_mesh_error: float
    """eV/Å: part of steady_friction_error"""
    friction_stress: float
    """MPa: steady_friction divided by the area of the box"""
    friction_coefficient: float
    """steady_friction divided by the normal force"""
    friction_coefficient_error: float
    """error of friction_coefficient, as steady_friction_error"""
    steady_pressure: float
    """MPa: mean normal force of the substrate on the lowest layer, divided by the area of the box"""
    steady_contact_fraction: float
    """mean contact fraction"""
    steady_contact_fraction_error: float
    """standard error of steady_contact_fraction"""
    steady_contact_area: float
    """mean area in contact with the wall, as contact_area"""
    steady_contact_area_uncertainty: float
    """error of steady_contact_area"""
    steady_mean_height: float
    """Å: average of the mean height of the lowest layer"""
    steady_dissipated_in_block: float
    """eV/Å: part of steady_friction"""
    steady_dissipated_in_surface: float
    """eV/Å: part of steady_friction"""
    steady_lost: float
    """eV/Å: part of steady_friction"""
    pressure: float
    """MPa: normal force of the substrate on the lowest layer at the end of the segment, divided by the area of the box"""
    force: float
    """nN: force at the end of the segment"""
    pressure_scatter: float
    """MPa: rms deviation of the force from the average, by thermal noise"""
    pressure_averaged_over: float
    """ps: averaging time of the force"""
    mean_height: float
    """Å: mean height of the lowest layer at the end of the segment"""
    top_displacement: float
    """Å: displacement of the top plane at the end of the segment"""
    contact_fraction: float
    """contact fraction at the end of the segment"""
    contact_area: float
    """area in contact with a wall at the end of the segment, as contact_area"""
    yielding_fraction: float
    """sites whose net pressure is the hardness"""
    mean_set: float
    """Å: mean permanent set at the end of the segment"""
    largest_set: float
    """Å: largest permanent set of a site at the end of the segment"""
    slide: list[float]
    """Å: place over the substrate along x and y at the end of the segment"""

class Yielding(Values):
    mean_set: float
    """Å: mean permanent set of a surface that yields"""
    largest_set: float
    """Å: largest permanent set of a site"""
    largest_fraction: float
    """largest share of sites at the hardness at the end of a segment"""
    tension_over_hardness: float
    """largest tension of flat surfaces divided by the smallest hardness, w/"""
    rms_before: float
    """Å: rms height of the surface before the path"""
    rms_after: float
    """Å: rms height of the surface at the end of the last segment, less its set"""
    slope_before: float
    """rms slope of the surface before the path, by differences of neighbours"""
    slope_after: float
    """rms slope of the surface at the end of the last segment, less its set, by differences of neighbours"""

class DissipatedJump(Values):
    segment: int
    """number of the segment of drive.path, from 0"""
    energy: float
    """eV: energy dissipated at the instability"""
    top_displacement: float
    """Å: displacement of the top plane"""
    slide: list[float]
    """Å: place over the substrate"""
    mean_height: list[float]
    """Å: mean height of the lowest layer before and after"""
    force: list[float]
    """eV/Å: force on the top plane, or of the substrate along a slide, before and after"""
    contact_fraction: list[float]
    """contact fraction before and after"""
    site: list[float]
    """x and y of the site that moved furthest"""
    largest_move: float
    """Å: distance moved by that site"""
    sites_moved: int
    """number of sites that moved more than half as far"""

class Dissipated(Values):
    energy: float
    """eV: energy dissipated at instabilities since the start of a quasi-static path"""
    not_followed: float
    """eV: part of dissipated.energy in steps longer than a fiftieth of the shortest time of block.prony, of which ..."""
    events: int
    """number of instabilities"""
    jumps: list[DissipatedJump]

class TheoryPersson(Values):
    gamma_eff: float
    """meV/Å^2: effective work of adhesion, Persson's theory"""
    contact_fraction: float
    """area of real contact, projected"""
    gamma_full_contact: float
    """meV/Å^2: effective work of adhesion for complete contact"""
    delta_gamma: float
    """meV/Å^2: Δγ used by the theory"""
    gamma_eff_error: float
    """meV/Å^2: numerical error of gamma_eff"""
    contact_fraction_error: float
    """numerical error of contact_fraction"""
    elastic_energy: float
    """meV/Å^2: elastic energy stored in the contact"""
    h_rms: float
    """Å: rms height of the spectrum used by the theory"""
    rms_slope: float
    """rms slope of the spectrum used by the theory"""
    theta: float
    """adhesion parameter E* h² q0/Δγ"""
    jkr_pull_off_force: float
    """eV/Å: pull-off force by JKR with gamma_eff"""
    critical_rms: float
    """Å: rms height beyond which adhesion vanishes"""
    critical_rms_full_contact: float
    """Å: rms height beyond which adhesion vanishes for complete contact"""
    area_factor: str
    """definition of the area that adheres"""
    status: str
    """adhesive', 'pressed' or 'no contact"""
    converged: bool
    """true if the errors are below 1e-3"""
    note: str
    """reason why the theory has no solution for this scene"""

class TheoryCapped(Values):
    pressure: float
    """MPa: largest pressure at the end of a segment of a surface that yields, for which Persson's theory with a cap ..."""
    contact_fraction: float
    """contact area at that pressure by Persson's theory with a cap"""
    yielding_fraction: float
    """part of the area at the hardness at that pressure, by Persson's theory with a cap"""
    note: str
    """reason why the theory with a cap does not apply to this scene"""

class TheoryRenormalised(Values):
    gamma_eff: float
    """meV/Å^2: effective work of adhesion, renormalised theory"""
    gamma_eff_ratio: float
    """gamma_eff/Δγ"""
    contact_fraction: float
    """sites in contact"""
    separation: float
    """Å: mean separation"""
    tension: float
    """GPa: largest tension of the renormalised potential"""
    gamma_eff_error: float
    """meV/Å^2: numerical error of gamma_eff"""
    contact_fraction_error: float
    """numerical error of contact_fraction"""
    gamma_eff_expected_error: float
    """meV/Å^2: expected error"""
    contact_fraction_expected_error: float
    """expected error of contact_fraction, as for gamma_eff"""
    note: str
    """reason why there is no solution, or why its error is large"""

class TheorySphere(Values):
    maugis_parameter: float
    """Maugis' λ of the smooth sphere"""
    jkr_images: float
    """meV/Å^2: pull-off force of the smooth sphere by JKR with the periodic images, as a work of adhesion by JKR"""
    maugis_images: float
    """meV/Å^2: as jkr_images, by the theory of Maugis and Dugdale"""
    renormalised: float
    """meV/Å^2: as maugis_images, with the work of adhesion and the largest tension of the renormalised theory"""
    renormalised_parameter: float
    """Maugis' λ with the work of adhesion and the largest tension of the renormalised theory"""
    note: str
    """reason why one of these is missing"""

class TheorySlidingCurve(Values):
    velocity: float
    """m/s: velocity"""
    friction_coefficient: float
    """friction coefficient at this velocity"""
    contact_fraction: float
    """area of real contact at this velocity"""

class TheorySliding(Values):
    friction_coefficient: float
    """Persson's theory of rubber friction at drive.velocity, under drive.load"""
    friction_stress: float
    """MPa: friction_coefficient times the load"""
    contact_fraction: float
    """area of real contact at drive.velocity"""
    slope: float
    """s/m: friction coefficient divided by velocity, in the limit of slow sliding"""
    largest_friction_coefficient: float
    """maximum of the friction coefficient over velocity"""
    velocity_of_largest: float
    """m/s: velocity of the largest friction coefficient"""
    curve: list[TheorySlidingCurve]
    note: str
    """reason why the theory has no result"""

class Theory(Values):
    persson: TheoryPersson
    capped: TheoryCapped
    renormalised: TheoryRenormalised
    sphere: TheorySphere
    sliding: TheorySliding

class Relaxed(Values):
    elastic_energy: float
    """meV/Å^2: elastic energy of the relaxed state"""
    mean_height: float
    """Å: mean height of the lowest layer above the substrate's mean plane"""
    residual_force: float
    """eV/Å: largest residual force on a node"""

class Energy(Values):
    balance_error: float
    """energy balance at the last recorded step"""
    interface: float
    """eV: energy of the interface, of pairs or of the law of a wall"""
    spring: float
    """eV: part of the elastic energy in the spring that holds the top plane"""
    branches: float
    """eV: part of the elastic energy in the branches of a viscoelastic block"""
    elastic: float
    """eV: elastic energy"""
    kinetic: float
    """eV: kinetic energy"""
    time_step: float
    """eV: energy of the time step at a temperature, -"""
    work: float
    """eV: work of the drive on the solids, counted from rest apart"""
    dissipated_in_block: float
    """eV: energy dissipated by a viscoelastic block"""
    dissipated_in_surface: float
    """eV: plastic work"""
    damped: float
    """eV: energy damped, less the heat of noise, or of a quasi-static path dissipated at instabilities"""

class SurfaceOwn(Values):
    rms: float
    """Å: rms height of the block's surface, with surface.counter"""
    rms_slope: float
    """rms slope of the block's surface, with surface.counter"""

class SurfaceCounter(Values):
    rms: float
    """Å: rms height of the second solid's surface"""
    rms_slope: float
    """rms slope of the second solid's surface"""
    file_digest: str
    """digest of the values read from surface.counter, as surface.file_digest"""

class Surface(Values):
    rms: float
    """Å: rms height of the substrate, without the cap"""
    rms_slope: float
    """rms slope √⟨"""
    min: float
    """Å: smallest height of the substrate"""
    max: float
    """Å: largest height of the substrate"""
    atoms: int
    """number of atoms of a substrate of atoms"""
    origin: str
    """author of the map, if its file names one"""
    file_digest: str
    """digest of the values read from surface.file"""
    own: SurfaceOwn
    counter: SurfaceCounter
    correlation: float
    """correlation of the heights of both surfaces, each outwards from its own solid"""
    band_overlap: float
    """overlap of the spectra of both surfaces"""

class Interface(Values):
    cutoff: float
    """Å: cutoff of the pairs, also if the scene says '4 r0"""
    table_digest: str
    """digest of the values of the scene's tabulated potentials. A sweep reuses a result only if the digest is ..."""
    adhesion_digest: str
    """digest of the field of interface.adhesion on the sites. A sweep reuses a result only if the digest is ..."""
    adhesion_least: float
    """meV/Å^2: smallest work of adhesion of a site in the field of interface.adhesion"""
    adhesion_largest: float
    """meV/Å^2: largest work of adhesion of a site in the field of interface.adhesion"""
    hardness_digest: str
    """digest of the field of interface.hardness on the sites. A sweep reuses a result only if the digest is ..."""
    hardness_least: float
    """GPa: smallest hardness of a site in the field of interface.hardness"""
    hardness_largest: float
    """GPa: largest hardness of a site in the field of interface.hardness"""
    table_error: float
    """bound of the error of energies of flat surfaces, and so of binding energies, from the spline between the ..."""

class Block(Values):
    prony_file: str
    """file that block.prony names"""
    prony_error: float
    """relative rms error of the fit in that file"""

class RunPhase(Values):
    seconds: float
    """s: wall time spent in a phase of the run, since the last resume"""
    calls: int
    """number of times that the phase was entered"""

class RunEffect(Values):
    on: bool
    """true if the scene switches the effect on"""
    why: str
    """key that decides"""

class Run(Values):
    wall_seconds: float
    """s: wall time of this process"""
    processor_seconds: float
    """s: processor time of all threads, from the first start"""
    steps: int
    """number of time steps, or of points of a quasi-static path"""
    iterations: int
    """number of iterations of a path's points, or of the state and the search for others"""
    stopped: str
    """reason why the path is incomplete"""
    file_digest: str
    """digest at the end of the run.h5 of this result"""
    ranks: int
    """number of MPI ranks"""
    threads: int
    """number of threads of a rank"""
    phases: dict[str, RunPhase]
    effects: dict[str, RunEffect]
    device: str
    """device that computed the steps"""
    kernels: str
    """instruction set of the kernels used"""
    version: str
    """version of Asperity"""
    git: str
    """commit that the program was built from"""
    compiler: str
    """compiler"""
    flags: str
    """build type and compiler flags"""
    machine: str
    """processor and number of processors"""

class Numbers:
    name: str
    """name of the scene"""
    failure: Failure
    delta_gamma: float
    """meV/Å^2: flat reference Δγ"""
    box: Box
    binding_energy: float
    """meV/Å^2: -"""
    binding_energy_uncertainty: float
    """meV/Å^2: convergence of the solver, not the error"""
    work_of_interface: WorkOfInterface
    pair_binding_energy: float
    """meV/Å^2: -U_LJ of the relaxed state"""
    work_of_drive: WorkOfDrive
    dissipated_in_block: DissipatedInBlock
    dissipated_in_surface: DissipatedInSurface
    lost: Lost
    kinetic: Kinetic
    spring: Spring
    stored: Stored
    contact_fraction: float
    """sites in contact at zero load"""
    contact_area: float
    """area in contact with a wall at zero load"""
    contact_area_uncertainty: float
    """error of contact_area by the spacing"""
    mesh_error: MeshError
    repulsive_fraction: float
    """sites whose net normal force is repulsive, at zero load"""
    approach_force: float
    """eV/Å: largest attraction during the approach"""
    pull_off_force: float
    """eV/Å: largest attraction during the pull-off"""
    jkr: Jkr
    contact_radius: ContactRadius
    instrument: Instrument
    yielding: Yielding
    dissipated: Dissipated
    theory: Theory
    relaxed: Relaxed
    energy: Energy
    surface: Surface
    interface: Interface
    block: Block
    run: Run
    digest: str
    """last member"""

class SceneSurface(Values):
    kind: Any
    """the substrate"""
    sites: Any
    """number of sites along an edge of the box, N"""
    boundary: Any
    """edges of the box"""
    spacing: Any
    """Å: lattice constant a of the block"""
    lattice_ratio: Any
    """block spacing divided by substrate spacing, rounded to whole atoms"""
    rms: Any
    """Å: rms height"""
    hurst: Any
    """Hurst exponent H"""
    rolloff: Any
    """roll-off wavevector q0 / q_L, below which C"""
    q_max: Any
    """largest wavevector q1 / q_L, above which C"""
    amplitudes: Any
    """random amplitudes and phases, or random phases only"""
    seed: Any
    """seed of the surface"""
    radius: Any
    """Å: radius of a spherical cap under the roughness"""
    file: Any
    """for kind = 'file"""
    file_size: Any
    """Å: edge of the map"""
    file_unit: Any
    """unit of the map's heights"""
    detrend: Any
    """removes from a map of a file nothing, the mean plane, or the mean plane and the jumps between opposite edges"""
    file_missing: Any
    """points of the map without a height"""
    file_crop: Any
    """a map that is not square"""
    line_noise: Any
    """noise of a scan from line to line"""
    resample: Any
    """resampling of a map without N x N values to the lattice"""
    counter: Any
    """map of a second solid, in a file as for surface.file, over a wall on a quasi-static path"""
    counter_size: Any
    """Å: edge of the map of surface.counter"""
    counter_unit: Any
    """unit of the map of surface.counter"""
    counter_missing: Any
    """points without a value in the map of surface.counter, as surface.file_missing"""
    counter_crop: Any
    """a map of surface.counter that is not square, as surface.file_crop"""
    counter_shift_x: Any
    """Å: shift of the second solid along x, after its turn"""
    counter_shift_y: Any
    """Å: shift of the second solid along y, after its turn"""
    counter_turn: Any
    """turn of the second solid about the middle of its map, degrees, counter-clockwise from above"""
    counter_young: Any
    """GPa: Young's modulus of the second solid"""
    counter_poisson: Any
    """Poisson's ratio of the second solid"""
    counter_layers: Any
    """coatings of the second solid, from its surface inwards, as block.layers"""
    counter_surface_stress: Any
    """N/m: tension of the second solid's surface"""

class SceneBlock(Values):
    model: Any
    """dynamic paths"""
    young: Any
    """GPa: Young's modulus E"""
    poisson: Any
    """Poisson's ratio"""
    atom_mass: Any
    """u: mass of an atom"""
    thickness: Any
    """thickness in lattice layers, or a length"""
    layers_per_level: Any
    """thickness of each level of the multiscale block, in its own cells"""
    strain: Any
    """small strain, or geometrically exact springs"""
    prony: Any
    """branches of a viscoelastic block"""
    layers: Any
    """coatings between the block's own material and its surface"""
    surface_stress: Any
    """N/m: tension of the block's surface"""

class SceneInterface(Values):
    kind: Any
    """pairs of atoms, or a wall, which acts by a law of the gap below each site without lateral forces"""
    potential: Any
    """potential of the pairs, or of the atoms of a smeared wall"""
    epsilon: Any
    """eV: depth of the Lennard-Jones well"""
    r0: Any
    """Å: distance of zero Lennard-Jones energy"""
    morse_D: Any
    """eV: depth of the Morse well"""
    morse_a: Any
    """1/Å: inverse width of the Morse potential D"""
    morse_r_min: Any
    """Å: distance of the Morse minimum"""
    table: Any
    """file of potential = 'table"""
    cutoff: Any
    """Å: distance beyond which atoms do not interact, at most half the box. '4 r0"""
    pairs: Any
    """potentials of the types of a substrate of atoms from a file"""
    tail: Any
    """continuum correction beyond the cutoff"""
    frictionless: Any
    """no lateral tractions, and normal displacements only"""
    law: Any
    """law of a wall. With a linear repulsion below a gap of 0"""
    adhesion: Any
    """meV/Å^2: work of adhesion of flat surfaces, Δγ, for a wall that is not smeared"""
    adhesion_size: Any
    """Å: edge of the map of interface.adhesion"""
    adhesion_unit: Any
    """unit of the map of interface.adhesion"""
    adhesion_missing: Any
    """points without a value in the map of interface.adhesion, as surface.file_missing"""
    adhesion_crop: Any
    """a map of interface.adhesion that is not square, as surface.file_crop"""
    hardness: Any
    """GPa: largest net pressure of a site over a wall on a quasi-static path"""
    hardness_size: Any
    """Å: edge of the map of interface.hardness"""
    hardness_unit: Any
    """unit of the map of interface.hardness"""
    hardness_missing: Any
    """points without a value in the map of interface.hardness, as surface.file_missing"""
    hardness_crop: Any
    """a map of interface.hardness that is not square, as surface.file_crop"""
    range: Any
    """Å: range of the laws except smeared and table"""
    exponent: Any
    """exponent of the energy of law = 'power"""
    stiffness: Any
    """GPa/Å: stiffness of the linear repulsion"""
    edge_pinning: Any
    """allows or refuses the pull-off of a sphere whose force would be more than 1.3 times too large, because the ..."""

class SceneDrive(Values):
    mode: Any
    """time steps"""
    path: Any
    """segments of the run, in order"""
    velocity: Any
    """m/s: speed of the top plane"""
    control: Any
    """quantity that a quasi-static path prescribes"""
    displacement_step: Any
    """Å: largest step of the quantity of drive.control between points of a quasi-static path"""
    stiffness: Any
    """N/m: stiffness of a spring between drive and top plane, for the whole box, like the cantilever of an instrument"""
    mass: Any
    """u: mass of the top plane on the spring of drive.stiffness"""
    timestep: Any
    """fs: time step of velocity Verlet"""
    damping: Any
    """1/ps: rate Γ of the damping force -m Γ v, with v relative to the drive, which moves the top plane or the far end ..."""
    damping_from: Any
    """fraction of the thickness above which damping acts"""
    ramp: Any
    """ps: duration of smooth changes of the top plane's velocity"""
    load: Any
    """MPa: pressure, or force on the box"""
    temperature: Any
    """K: temperature"""
    seed: Any
    """seed of the thermal noise"""
    max_steps: Any
    """largest number of time steps, or points of a quasi-static path, after which the run stops"""
    tolerance: Any
    """largest residual force of a relaxation, as a fraction of the smallest force on a site that decides the state"""

class SceneTheory(Values):
    delta_gamma: Any
    """meV/Å^2: Δγ of the theory"""
    beta: Any
    """β, correction to the elastic energy of partial contact"""
    area_factor: Any
    """area that adheres, over the projected area"""
    spectrum: Any
    """spectrum of the theory"""
    clip: Any
    """clip the target spectrum at Nyquist, like the surface"""

class SceneNumerics(Values):
    precision: Any
    """precision of the pairs across the interface"""
    device: Any
    """computes the time steps on the processor"""

class SceneOutput(Values):
    trajectory: Any
    """steps between frames of the lowest layer"""
    velocities: Any
    """writes velocities in the frames of the trajectory too"""
    fields: Any
    """times of maps"""
    stress: Any
    """stresses below the surface with each map of a state"""
    stress_depth: Any
    """Å: largest depth of the section"""
    stress_depths: Any
    """number of depths of the section, from the surface"""
    stress_friction: Any
    """friction coefficient of a traction along x in phase with the pressure, where it is repulsive"""
    series: Any
    """steps between rows of the series"""
    checkpoint: Any
    """s: wall time between checkpoints"""

class Scene(Values):
    surface: SceneSurface
    block: SceneBlock
    interface: SceneInterface
    drive: SceneDrive
    theory: SceneTheory
    numerics: SceneNumerics
    output: SceneOutput

class SeriesArrays:
    step: np.ndarray
    """time step"""
    time: np.ndarray
    """ps: time, simulated or of the relaxation of a viscoelastic block"""
    segment: np.ndarray
    """number of the segment of drive.path, from 0"""
    top_displacement: np.ndarray
    """Å: displacement of the top plane"""
    drive_displacement: np.ndarray
    """Å: displacement of the drive"""
    mean_height: np.ndarray
    """Å: mean height of the lowest layer above the substrate's mean plane"""
    force: np.ndarray
    """eV/Å: normal force of the substrate on the lowest layer"""
    top_force: np.ndarray
    """eV/Å: elastic force on the top plane along z"""
    slide_x: np.ndarray
    """Å: place of the block over the substrate along x"""
    slide_y: np.ndarray
    """Å: place of the block over the substrate along y"""
    lateral_force_x: np.ndarray
    """eV/Å: force of the substrate on the lowest layer along x"""
    lateral_force_y: np.ndarray
    """eV/Å: force of the substrate on the lowest layer along y"""
    interface_energy: np.ndarray
    """eV: energy of the interface, of pairs or of the law of a wall"""
    spring_energy: np.ndarray
    """eV: part of the elastic energy in the spring that holds the top plane"""
    branch_energy: np.ndarray
    """eV: part of the elastic energy in the branches of a viscoelastic block"""
    elastic_energy: np.ndarray
    """eV: elastic energy"""
    kinetic_energy: np.ndarray
    """eV: kinetic energy"""
    time_step_energy: np.ndarray
    """eV: energy of the time step at a temperature, -"""
    work: np.ndarray
    """eV: work of the drive on the solids, counted from rest apart"""
    work_of_interface: np.ndarray
    """eV: work of the interface's force on the mean height since the start, ∫ F dz"""
    dissipated_in_block: np.ndarray
    """eV: energy dissipated by a viscoelastic block, since the start"""
    dissipated_in_surface: np.ndarray
    """eV: plastic work"""
    damped: np.ndarray
    """eV: energy damped, less the heat of noise, or of a quasi-static path dissipated at instabilities"""
    dissipated: np.ndarray
    """eV: energy damped, less the heat of noise, or of a quasi-static path dissipated at instabilities"""
    balance_error: np.ndarray
    """energy balance"""
    contact_fraction: np.ndarray
    """sites in contact"""
    repulsive_fraction: np.ndarray
    """sites whose net normal force is repulsive"""
    yielding_fraction: np.ndarray
    """sites whose net pressure is the hardness"""
    mean_set: np.ndarray
    """Å: mean permanent set of a surface that yields"""
    largest_set: np.ndarray
    """Å: largest permanent set of a site of a surface that yields"""
    closest: np.ndarray
    """Å: smallest distance from a site to an atom"""

class StateMaps:
    gap: np.ndarray
    """Å: height of a site above the substrate below it"""
    pressure: np.ndarray
    """GPa: normal force on a site"""
    distance: np.ndarray
    """Å: distance from a site to the nearest atom"""
    contact: np.ndarray
    """1 if distance is below the inflection of the pair potential"""
    adhesion: np.ndarray
    """meV/Å^2: work of adhesion of a site, if interface.adhesion is a field"""
    hardness: np.ndarray
    """GPa: hardness of a site, if interface.hardness is a field"""
    set: np.ndarray
    """Å: permanent set of a site of a surface that yields"""
    yielded_height: np.ndarray
    """Å: heights of a surface that yields, less its set"""
    u_x: np.ndarray
    """Å: displacement of a site along x"""
    u_y: np.ndarray
    """Å: displacement of a site along y"""
    u_z: np.ndarray
    """Å: displacement of a site along z"""
    u_z_counter: np.ndarray
    """Å: displacement of the surface of an elastic second solid along z, whose lower end is held"""

class SubstrateMaps:
    height: np.ndarray
    """Å: heights of the atoms of the substrate at"""
    own_spectrum: np.ndarray
    """Å^4: C"""
    counter_spectrum: np.ndarray
    """Å^4: C"""
    counter_height: np.ndarray
    """Å: heights of the second solid in its place, outwards from it, [y][x]"""

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
    """why it failed"""

class WorkOfInterfaceUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of work_of_interface.approach"""
    pull_off: float
    """meV/Å^2: the same of the pull-off"""

class WorkOfInterface(Values):
    approach: float
    """meV/Å^2: work of the interface"""
    pull_off: float
    """meV/Å^2: the same of the pull-off"""
    uncertainty: WorkOfInterfaceUncertainty

class WorkOfDriveUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of work_of_drive.approach"""
    pull_off: float
    """meV/Å^2: the same of the pull-off"""

class WorkOfDrive(Values):
    approach: float
    """meV/Å^2: work of the drive on the solids during the approach, from rest beyond the interaction range"""
    pull_off: float
    """meV/Å^2: the same of the pull-off, to rest beyond the interaction range"""
    uncertainty: WorkOfDriveUncertainty

class LostUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of lost.approach"""
    pull_off: float
    """meV/Å^2: convergence of lost.pull_off"""

class Lost(Values):
    approach: float
    """meV/Å^2: energy lost on the approach"""
    pull_off: float
    """meV/Å^2: the same of the pull-off"""
    cycle: float
    """meV/Å^2: energy lost over a whole cycle, from and to rest beyond the interaction range, with kinetic.pull_off"""
    uncertainty: LostUncertainty

class Kinetic(Values):
    approach: float
    """meV/Å^2: kinetic and vibrational energy left at the end of the approach"""
    pull_off: float
    """meV/Å^2: the same at the end of the pull-off, above a block at rest beyond the interaction range"""

class DissipatedInBlockUncertainty(Values):
    approach: float
    """meV/Å^2: convergence of dissipated_in_block.approach"""
    pull_off: float
    """meV/Å^2: convergence of dissipated_in_block.pull_off"""

class DissipatedInBlock(Values):
    approach: float
    """meV/Å^2: energy that a viscoelastic block"""
    pull_off: float
    """meV/Å^2: the same of the pull-off"""
    cycle: float
    """meV/Å^2: the same over a whole cycle"""
    uncertainty: DissipatedInBlockUncertainty

class Stored(Values):
    approach: float
    """meV/Å^2: change of the energy of interface and block"""
    pull_off: float
    """meV/Å^2: the same of the pull-off"""

class Jkr(Values):
    approach: float
    """meV/Å^2: work of adhesion by JKR, F/"""
    pull_off: float
    """meV/Å^2: the same of the pull-off"""
    approach_averaged: float
    """meV/Å^2: as jkr.approach, from the largest attraction of a running mean over 2 ps, which leaves out the vibrations ..."""
    pull_off_averaged: float
    """meV/Å^2: the same of the pull-off"""
    edge_pinning: float
    """factor by which rows of sites that hold the edge of the contact make pull_off_force and jkr.pull_off too ..."""
    relaxed: float
    """meV/Å^2: work of adhesion by JKR from the binding energy at zero load, which needs no largest force"""

class ContactRadius(Values):
    relaxed: float
    """Å: √"""
    pull_off: float
    """Å: √"""

class Instrument(Values):
    approach_force: float
    """nN: approach_force in the units of instruments, of a sphere or a box with free edges, like the following"""
    pull_off_force: float
    """nN: pull_off_force"""
    contact_radius: float
    """nm: contact_radius.relaxed"""
    spring: float
    """N/m: drive.stiffness"""
    energy_lost: float
    """aJ: dissipated.energy"""
    edge_distance: float
    """nm: least distance of a contact of the path from a free edge of the box"""

class Segment(Values):
    segment: int
    """its number in drive.path, from 0"""
    name: str
    """as the scene has it"""
    work_of_drive: float
    """meV/Å^2: work of the drive on the solids, also sideways"""
    work_of_interface: float
    """meV/Å^2: ∫ F dz of the mean height"""
    lost: float
    """meV/Å^2: energy damped on the way, or dissipated at instabilities"""
    dissipated_in_block: float
    """meV/Å^2: energy that a viscoelastic block has dissipated by that, beside lost"""
    stored: float
    """meV/Å^2: change of the energy of interface and block"""
    work_of_settling: float
    """meV/Å^2: part of work_of_drive of a slide until steady"""
    kinetic: float
    """meV/Å^2: kinetic and vibrational energy left at the end of an approach or a pull-off of a dynamic path at T = 0, as ..."""
    uncertainty: float
    """meV/Å^2: convergence of work_of_drive, lost and dissipated_in_block"""
    largest_attraction: float
    """eV/Å: on the way"""
    friction: float
    """eV/Å: force against a slide"""
    largest_friction: float
    """eV/Å: the largest force against the slide"""
    steady: str
    """of a slide over a wall"""
    running_in: float
    """Å: distance left out at the beginning, with which the variance of the mean friction is least"""
    steady_friction: float
    """eV/Å: force against the slide"""
    steady_friction_error: float
    """eV/Å: its standard error, by blocking, as of the following ones"""
    friction_stress: float
    """MPa: steady_friction over the area of the box"""
    friction_coefficient: float
    """steady_friction over the normal force"""
    friction_coefficient_error: float
    """its standard error"""
    steady_pressure: float
    """MPa: of the substrate on the lowest layer"""
    steady_contact_fraction: float
    """contact fraction"""
    steady_contact_fraction_error: float
    """its standard error"""
    steady_mean_height: float
    """Å: mean height of the lowest layer"""
    steady_dissipated_in_block: float
    """eV/Å: energy that a viscoelastic block dissipates over the distance"""
    steady_lost: float
    """eV/Å: energy dissipated at instabilities over the distance"""
    pressure: float
    """MPa: at its end"""
    force: float
    """nN: the same as a force, of a sphere or a box with free edges"""
    pressure_scatter: float
    """MPa: thermal noise"""
    pressure_averaged_over: float
    """ps: time of the average"""
    mean_height: float
    """Å: at its end"""
    top_displacement: float
    """Å: at its end"""
    contact_fraction: float
    """at its end"""
    slide: list[float]
    """Å: at its end"""

class DissipatedJump(Values):
    segment: int
    """number of the segment of drive.path, from 0"""
    energy: float
    """eV: energy dissipated"""
    top_displacement: float
    """Å: displacement of the top plane"""
    slide: list[float]
    """Å: place over the substrate, of a path that slides"""
    mean_height: list[float]
    """Å: mean height of the lowest layer, before and after"""
    force: list[float]
    """eV/Å: force on the top plane, or of the substrate along a slide, before and after"""
    contact_fraction: list[float]
    """contact fraction, before and after"""
    site: list[float]
    """x and y of the site that moved furthest"""
    largest_move: float
    """Å: how far it moved"""
    sites_moved: int
    """sites that moved more than half as far"""

class Dissipated(Values):
    energy: float
    """eV: energy dissipated at instabilities since the start of a quasi-static path"""
    not_followed: float
    """eV: of this, in steps longer than a fiftieth of the shortest time of block.prony"""
    events: int
    """number of instabilities"""
    jumps: list[DissipatedJump]

class TheoryPersson(Values):
    gamma_eff: float
    """meV/Å^2: effective work of adhesion, Persson's theory"""
    contact_fraction: float
    """area of real contact, projected"""
    gamma_full_contact: float
    """meV/Å^2: effective work of adhesion if contact is assumed to be complete"""
    delta_gamma: float
    """meV/Å^2: the Δγ that the theory was given"""
    gamma_eff_error: float
    """meV/Å^2: numerical error of gamma_eff"""
    contact_fraction_error: float
    """numerical error of contact_fraction"""
    elastic_energy: float
    """meV/Å^2: elastic energy stored in the contact"""
    h_rms: float
    """Å: rms height of the spectrum that was solved for"""
    rms_slope: float
    """rms slope of that spectrum"""
    theta: float
    """adhesion parameter E* h² q0/Δγ"""
    jkr_pull_off_force: float
    """eV/Å: pull-off force by JKR with gamma_eff"""
    critical_rms: float
    """Å: rms height beyond which adhesion vanishes"""
    critical_rms_full_contact: float
    """Å: the same if contact is assumed to be complete"""
    status: str
    """adhesive', 'pressed' or 'no contact"""
    converged: bool
    """whether the errors are below 1e-3"""
    note: str
    """why the theory has no solution for this scene"""

class TheoryRenormalised(Values):
    gamma_eff: float
    """meV/Å^2: effective work of adhesion, renormalised theory"""
    gamma_eff_ratio: float
    """gamma_eff over Δγ"""
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
    """the same of contact_fraction"""
    note: str
    """why there is no solution, or its error is large"""

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
    """its Maugis' λ"""
    note: str
    """why one of these is missing"""

class TheorySlidingCurve(Values):
    velocity: float
    """m/s: velocity"""
    friction_coefficient: float
    """friction coefficient there"""
    contact_fraction: float
    """area of real contact there"""

class TheorySliding(Values):
    friction_coefficient: float
    """Persson's theory of rubber friction at drive.velocity, under drive.load"""
    friction_stress: float
    """MPa: friction_coefficient times the load"""
    contact_fraction: float
    """area of real contact at drive.velocity"""
    slope: float
    """s/m: friction coefficient over velocity of slow sliding"""
    largest_friction_coefficient: float
    """the maximum over velocity"""
    velocity_of_largest: float
    """m/s: its velocity"""
    curve: list[TheorySlidingCurve]
    note: str
    """why the theory has no number"""

class Theory(Values):
    persson: TheoryPersson
    renormalised: TheoryRenormalised
    sphere: TheorySphere
    sliding: TheorySliding

class Relaxed(Values):
    elastic_energy: float
    """meV/Å^2: elastic energy of the relaxed state"""
    mean_height: float
    """Å: mean height of the lowest layer above the substrate's mean plane"""
    residual_force: float
    """eV/Å: largest force left on a node"""

class Energy(Values):
    balance_error: float
    """energy balance"""
    work: float
    """eV: work of the drive on the solids since they were at rest apart"""
    kinetic: float
    """eV: kinetic energy of the velocities at the last recorded step"""
    elastic: float
    """eV: elastic energy at the last recorded step"""
    interface: float
    """eV: energy of the interface at the last recorded step"""
    time_step: float
    """eV: at a temperature"""
    damped: float
    """eV: energy lost since the start"""
    spring: float
    """eV: of energy.elastic, that of the spring that holds the top plane"""
    branches: float
    """eV: of energy.elastic, what the branches of a viscoelastic block store"""
    dissipated_in_block: float
    """eV: what they have dissipated since the start, beside energy.damped"""

class Surface(Values):
    rms: float
    """Å: rms height of the substrate, without the cap"""
    rms_slope: float
    """rms slope √⟨"""
    min: float
    """Å: lowest height of the substrate"""
    max: float
    """Å: its highest"""
    atoms: int
    """number of atoms of a substrate of atoms anywhere"""
    origin: str
    """who measured the map, where its file says so"""
    file_digest: str
    """digest of what was read from surface.file"""

class Interface(Values):
    cutoff: float
    """Å: cutoff of the pairs, of a scene with interface.cutoff = '4 r0' too"""
    table_digest: str
    """digest of the numbers in the tables of potentials that the scene names. A sweep takes a result again only ..."""
    adhesion_digest: str
    """digest of the field of interface.adhesion on the sites. A sweep takes a result again only if the file ..."""
    adhesion_least: float
    """meV/Å^2: least work of adhesion of a site of that field"""
    adhesion_largest: float
    """meV/Å^2: its largest"""
    table_error: float
    """bound of the error of energies of flat surfaces, and so of binding energies, that the spline between the ..."""

class Block(Values):
    prony_file: str
    """file of block.prony, as the scene names it"""
    prony_error: float
    """rms error of the fit that this file is, over the moduli"""

class RunPhase(Values):
    seconds: float
    """s: wall time spent in a phase of the run, since the last resume"""
    calls: int
    """how often the phase was entered"""

class RunEffect(Values):
    on: bool
    """whether the scene switches this effect on"""
    why: str
    """the key that decides it"""

class Run(Values):
    wall_seconds: float
    """s: wall time of this process"""
    processor_seconds: float
    """s: processor time of all threads, from the first start"""
    steps: int
    """time steps"""
    iterations: int
    """iterations"""
    stopped: str
    """max_steps', 'wall_limit' or 'signal"""
    file_digest: str
    """digest at the end of the run.h5 that belongs to these numbers"""
    ranks: int
    """MPI ranks"""
    threads: int
    """threads of a rank"""
    phases: dict[str, RunPhase]
    effects: dict[str, RunEffect]
    device: str
    """the device that made the steps"""
    kernels: str
    """instruction set of the kernels used"""
    version: str
    """version of Asperity"""
    git: str
    """commit that it was built from"""
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
    binding_energy: float
    """meV/Å^2: -"""
    binding_energy_uncertainty: float
    """meV/Å^2: convergence of its solver, not its error"""
    work_of_interface: WorkOfInterface
    pair_binding_energy: float
    """meV/Å^2: -U_LJ of the relaxed state"""
    work_of_drive: WorkOfDrive
    lost: Lost
    kinetic: Kinetic
    dissipated_in_block: DissipatedInBlock
    stored: Stored
    contact_fraction: float
    """sites closer to an atom than the inflection of the pair potential, at zero load"""
    repulsive_fraction: float
    """sites whose net normal force is repulsive, at zero load"""
    approach_force: float
    """eV/Å: largest attraction during the approach"""
    pull_off_force: float
    """eV/Å: largest attraction during the pull-off"""
    jkr: Jkr
    contact_radius: ContactRadius
    instrument: Instrument
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
    """N"""
    boundary: Any
    """edges of the box"""
    spacing: Any
    """Å: lattice constant a of the block"""
    lattice_ratio: Any
    """block spacing over substrate spacing"""
    rms: Any
    """Å: rms height"""
    hurst: Any
    """Hurst exponent H"""
    rolloff: Any
    """q0 / q_L"""
    q_max: Any
    """q1 / q_L"""
    amplitudes: Any
    """random amplitudes and phases, or random phases alone"""
    seed: Any
    """seed of the surface"""
    radius: Any
    """Å: of a spherical cap"""
    file: Any
    """for kind = 'file"""
    file_size: Any
    """Å: edge of the map"""
    file_unit: Any
    """unit of the map's heights"""
    detrend: Any
    """what is taken off a map from a file"""
    file_missing: Any
    """points of the map without a height"""
    file_crop: Any
    """a map that is not square"""
    line_noise: Any
    """noise of a scan from line to line"""
    resample: Any
    """how a map that has not N x N values is brought onto the lattice"""

class SceneBlock(Values):
    model: Any
    """on a dynamic path"""
    young: Any
    """GPa: Young's modulus E"""
    poisson: Any
    """Poisson's ratio"""
    atom_mass: Any
    """u: mass of an atom"""
    thickness: Any
    """in lattice layers, or a length"""
    layers_per_level: Any
    """thickness of each level of the multiscale block, in its own cells"""
    strain: Any
    """small strain, or geometrically exact springs"""
    prony: Any
    """branches of a viscoelastic block, on a quasi-static path, as in [[9.0, '1 ns'], [1.5, '20 ns']], the times ..."""
    layers: Any
    """coatings between the block's own material and its surface, on a quasi-static path, from the surface upwards"""
    surface_stress: Any
    """N/m: tension of the block's surface, on a quasi-static path"""

class SceneInterface(Values):
    kind: Any
    """pairs of atoms, or a wall"""
    potential: Any
    """potential of the pairs, or of the atoms for which a smeared wall stands"""
    epsilon: Any
    """eV: depth of the Lennard-Jones well"""
    r0: Any
    """Å: distance of zero Lennard-Jones energy"""
    morse_D: Any
    """eV: depth of the Morse well"""
    morse_a: Any
    """1/Å: of the Morse potential D"""
    morse_r_min: Any
    """Å: distance of the Morse minimum"""
    table: Any
    """file of potential = 'table"""
    cutoff: Any
    """Å: distance beyond which atoms do not interact"""
    pairs: Any
    """potentials of the types of a substrate of atoms from a file"""
    tail: Any
    """continuum correction beyond the cutoff"""
    frictionless: Any
    """quasi-static paths"""
    law: Any
    """law of a wall"""
    adhesion: Any
    """meV/Å^2: work of adhesion of flat surfaces, Δγ, of a wall that is not smeared"""
    adhesion_size: Any
    """Å: edge of the map of interface.adhesion"""
    adhesion_unit: Any
    """its unit"""
    adhesion_missing: Any
    """points of this map without a number"""
    adhesion_crop: Any
    """such a map that is not square"""
    range: Any
    """Å: of these laws"""
    exponent: Any
    """of law = 'power"""
    stiffness: Any
    """GPa/Å: stiffness of the linear repulsion"""
    edge_pinning: Any
    """whether a pull-off of a sphere runs although its force is more than 1.3 times too large"""

class SceneDrive(Values):
    mode: Any
    """time steps"""
    path: Any
    """the segments of the run, in order"""
    velocity: Any
    """m/s: speed of the top plane"""
    control: Any
    """what a quasi-static path prescribes"""
    displacement_step: Any
    """Å: largest displacement from point to point of a quasi-static path, of what drive.control prescribes"""
    stiffness: Any
    """N/m: of the spring that holds the top plane of the whole box, as the cantilever of an instrument does"""
    mass: Any
    """u: of the top plane on the spring of drive.stiffness"""
    timestep: Any
    """fs: of velocity Verlet"""
    damping: Any
    """1/ps: rate Γ of the force -m Γ v, v relative to the top plane"""
    damping_from: Any
    """fraction of the thickness above which damping acts"""
    ramp: Any
    """ps: time over which the top plane's velocity is reversed smoothly"""
    load: Any
    """MPa: pressure, or force on the box"""
    temperature: Any
    """K: above 0"""
    seed: Any
    """of the thermal noise"""
    max_steps: Any
    """stop after so many steps"""
    tolerance: Any
    """largest residual force of a relaxation, as a fraction of the smallest force on a site that decides the state"""

class SceneTheory(Values):
    delta_gamma: Any
    """meV/Å^2: flat"""
    beta: Any
    """correction to the elastic energy"""
    area_factor: Any
    """how the true area follows from the slope"""
    spectrum: Any
    """spectrum of the theory"""
    clip: Any
    """clip the target spectrum at Nyquist, like the surface"""

class SceneNumerics(Values):
    precision: Any
    """precision of the pairs across the interface"""
    device: Any
    """what makes the time steps"""

class SceneOutput(Values):
    trajectory: Any
    """steps between frames of the lowest layer"""
    velocities: Any
    """whether the frames of the trajectory hold velocities too"""
    fields: Any
    """when maps are written"""
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
    """Å: place of the block over the substrate, of a path that slides"""
    slide_y: np.ndarray
    """Å: the same along y"""
    lateral_force_x: np.ndarray
    """eV/Å: force of the substrate on the lowest layer along x, of a path that slides"""
    lateral_force_y: np.ndarray
    """eV/Å: the same along y"""
    interface_energy: np.ndarray
    """eV: energy of the interface"""
    branch_energy: np.ndarray
    """eV: of elastic_energy, what the branches of a viscoelastic block store"""
    spring_energy: np.ndarray
    """eV: of elastic_energy, what the spring that holds the top plane stores"""
    elastic_energy: np.ndarray
    """eV: elastic energy"""
    kinetic_energy: np.ndarray
    """eV: kinetic energy"""
    time_step_energy: np.ndarray
    """eV: at a temperature"""
    work: np.ndarray
    """eV: work of the drive on the solids since they were at rest apart, as energy.work"""
    work_of_interface: np.ndarray
    """eV: work of the interface's force on the mean height since the start, ∫ F dz"""
    damped: np.ndarray
    """eV: energy damped since the start, less the heat of the thermostat's noise"""
    dissipated: np.ndarray
    """eV: energy dissipated at instabilities since the start"""
    dissipated_in_block: np.ndarray
    """eV: energy that the branches of a viscoelastic block have dissipated since the start"""
    balance_error: np.ndarray
    """energy balance"""
    contact_fraction: np.ndarray
    """sites closer to an atom than the inflection of the pair potential"""
    repulsive_fraction: np.ndarray
    """sites whose net normal force is repulsive"""
    closest: np.ndarray
    """Å: smallest distance of a site and an atom"""

class StateMaps:
    gap: np.ndarray
    """Å: height of a site above the substrate below it"""
    pressure: np.ndarray
    """GPa: normal force on a site"""
    distance: np.ndarray
    """Å: distance of a site and the nearest atom"""
    contact: np.ndarray
    """1 where that is less than the inflection of the potential"""
    adhesion: np.ndarray
    """meV/Å^2: work of adhesion of a site, where interface.adhesion is a field"""
    u_x: np.ndarray
    """Å: displacement of a site"""
    u_y: np.ndarray
    """Å: displacement of a site"""
    u_z: np.ndarray
    """Å: displacement of a site"""

class SubstrateMaps:
    height: np.ndarray
    """Å: heights of the atoms of the substrate at"""

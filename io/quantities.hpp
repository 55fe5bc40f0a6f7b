// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Every number and text of result.json, and every data set of run.h5: name, unit, normalisation and
// meaning.
//
// This is the one place where a result is described. Result (io/result.hpp) takes no name that is
// not here and states the units from here in result.json; the summary of a run, the columns and
// attributes of run.h5 and docs/reference/result.md (`asperity defaults --results`) follow.
//
// Names: dots lead deeper; "*" stands for any name, "[]" for each element of a list. Units: as
// io/units.hpp reads them; "1" for a pure number, "" if the value is no number.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace asperity::io {

/// Description of a result.
struct Quantity {
    std::string_view name;
    std::string_view unit;
    std::string_view per; ///< divisor of the value, or the whole that the value belongs to
    std::string_view meaning;
};

namespace per {
inline constexpr std::string_view area = "nominal area", block = "whole block",
                                  sites = "all sites of the lowest layer", rank = "first rank",
                                  contact = "area in contact of a sphere";
}

/// Quantities of result.json, in the order of the file.
inline constexpr Quantity result_quantities[] = {
    {"name", "", "", "name of the scene"},
    {"failure.exit_code", "1", "", "exit code of a command that failed"},
    {"failure.reason", "", "", "why it failed: problem, reason, remedy"},
    {"delta_gamma", "meV/Å^2", per::area,
     "flat reference Δγ: flat on flat with the same potential, cutoff and lattices; over atoms "
     "anywhere that of one layer of the block's lattice, as a unit of measure"},
    {"binding_energy", "meV/Å^2", per::area,
     "-(U_LJ + U_el) of the relaxed state at zero load (path = [\"relax\"]: under drive.load)"},
    {"binding_energy_uncertainty", "meV/Å^2", per::area,
     "convergence of its solver, not its error (asperity estimate): the energy that residual "
     "forces of the size of drive.tolerance stand for"},
    {"work_of_interface.approach", "meV/Å^2", per::area,
     "work of the interface: of its force on the mean height of the lowest layer, ∫ F dz, positive "
     "where the solids attract each other on the way in; of dynamic paths, and of quasi-static "
     "ones "
     "that control the mean height"},
    {"work_of_interface.pull_off", "meV/Å^2", per::area,
     "the same of the pull-off: negative where the solids attract each other"},
    {"pair_binding_energy", "meV/Å^2", per::area,
     "-U_LJ of the relaxed state: binding energy of the pairs alone, without the elastic energy"},
    {"work_of_interface.uncertainty.approach", "meV/Å^2", per::area,
     "convergence of work_of_interface.approach (quasi-static), for the sequence of instabilities "
     "that the path takes"},
    {"work_of_interface.uncertainty.pull_off", "meV/Å^2", per::area, "the same of the pull-off"},
    {"work_of_drive.approach", "meV/Å^2", per::area,
     "work of the drive on the solids during the approach, from rest beyond the interaction range: "
     "negative where they attract each other. The drive is the top plane (on dynamic paths with "
     "the "
     "damping medium, which moves along) or the holder of the mean height"},
    {"work_of_drive.pull_off", "meV/Å^2", per::area,
     "the same of the pull-off, to rest beyond the interaction range"},
    {"work_of_drive.uncertainty.approach", "meV/Å^2", per::area,
     "convergence of work_of_drive.approach (quasi-static), for the sequence of instabilities that "
     "the path takes"},
    {"work_of_drive.uncertainty.pull_off", "meV/Å^2", per::area, "the same of the pull-off"},
    {"lost.approach", "meV/Å^2", per::area,
     "energy lost on the approach: dissipated at instabilities (quasi-static), or damped "
     "(dynamic, at T = 0). From rest, without a load, binding_energy = -work_of_drive.approach + "
     "lost.approach + kinetic.approach = work_of_drive.pull_off - lost.pull_off + "
     "kinetic.approach - kinetic.pull_off; of quasi-static paths nothing is kinetic. Of several "
     "cycles: of "
     "the last"},
    {"lost.pull_off", "meV/Å^2", per::area, "the same of the pull-off"},
    {"lost.cycle", "meV/Å^2", per::area,
     "energy lost over a whole cycle, from and to rest beyond the interaction range, with "
     "kinetic.pull_off; where the path is an approach and a pull-off alone, work_of_drive.approach "
     "+ work_of_drive.pull_off - dissipated_in_block.cycle"},
    {"kinetic.approach", "meV/Å^2", per::area,
     "kinetic and vibrational energy left at the end of the approach (dynamic, at T = 0, without "
     "a load), above the state at zero load"},
    {"kinetic.pull_off", "meV/Å^2", per::area,
     "the same at the end of the pull-off, above a block at rest beyond the interaction range"},
    {"dissipated_in_block.approach", "meV/Å^2", per::area,
     "energy that a viscoelastic block (block.prony) has dissipated on the approach, "
     "beside lost.approach"},
    {"dissipated_in_block.pull_off", "meV/Å^2", per::area,
     "the same of the pull-off: at its end a block that is still stretched comes to rest, without "
     "work of the drive"},
    {"dissipated_in_block.cycle", "meV/Å^2", per::area, "the same over a whole cycle"},
    {"dissipated_in_block.uncertainty.approach", "meV/Å^2", per::area,
     "convergence of dissipated_in_block.approach"},
    {"dissipated_in_block.uncertainty.pull_off", "meV/Å^2", per::area,
     "convergence of dissipated_in_block.pull_off"},
    {"stored.approach", "meV/Å^2", per::area,
     "change of the energy of interface and block (branches included) on the approach of a "
     "quasi-static path: work_of_drive = stored + lost + dissipated_in_block, on the approach, on "
     "the pull-off and in each segment; over a cycle nothing is stored"},
    {"stored.pull_off", "meV/Å^2", per::area, "the same of the pull-off"},
    {"lost.uncertainty.approach", "meV/Å^2", per::area, "convergence of lost.approach"},
    {"lost.uncertainty.pull_off", "meV/Å^2", per::area, "convergence of lost.pull_off"},
    {"contact_fraction", "1", per::sites,
     "sites closer to an atom than the inflection of the pair potential, at zero load; over a wall "
     "those that touch it, or nearer than its largest tension (smeared)"},
    {"repulsive_fraction", "1", per::sites,
     "sites whose net normal force is repulsive, at zero load"},
    {"approach_force", "eV/Å", per::block, "largest attraction during the approach"},
    {"pull_off_force", "eV/Å", per::block, "largest attraction during the pull-off"},
    {"jkr.approach", "meV/Å^2", per::contact,
     "work of adhesion by JKR, F/(1.5 π R), from the largest attraction of the approach (spheres)"},
    {"jkr.pull_off", "meV/Å^2", per::contact, "the same of the pull-off"},
    {"jkr.approach_averaged", "meV/Å^2", per::contact,
     "as jkr.approach, from the largest attraction of a running mean over 2 ps, which leaves out "
     "the "
     "vibrations after an instability; needs output.series of 0.5 ps or less"},
    {"jkr.pull_off_averaged", "meV/Å^2", per::contact, "the same of the pull-off"},
    {"jkr.edge_pinning", "1", "",
     "factor by which rows of sites that hold the edge of the contact make pull_off_force and "
     "jkr.pull_off too large, within 15 % (a wall's range that the spacing does not resolve)"},
    {"jkr.relaxed", "meV/Å^2", per::contact,
     "work of adhesion by JKR from the binding energy at zero load, which needs no largest force; "
     "not of a state under drive.load"},
    {"contact_radius.relaxed", "Å", "", "√(contact area/π) of the state (spheres)"},
    {"contact_radius.pull_off", "Å", "", "√(contact area/π) at the largest attraction"},
    {"instrument.approach_force", "nN", per::block,
     "approach_force in the units of instruments, of a sphere or a box with free edges, like the "
     "following"},
    {"instrument.pull_off_force", "nN", per::block, "pull_off_force"},
    {"instrument.contact_radius", "nm", "", "contact_radius.relaxed"},
    {"instrument.spring", "N/m", "", "drive.stiffness"},
    {"instrument.energy_lost", "aJ", per::block, "dissipated.energy"},
    {"instrument.edge_distance", "nm", "",
     "least distance of a contact of the path from a free edge of the box (surface.boundary)"},
    {"segments[]", "", "", "the segments of drive.path that have ended, in order"},
    {"segments[].segment", "1", "", "its number in drive.path, from 0"},
    {"segments[].name", "", "", "as the scene has it"},
    {"segments[].work_of_drive", "meV/Å^2", per::area,
     "work of the drive on the solids, also sideways; on dynamic paths from rest where the path "
     "starts, and to rest beyond the interaction range at a pull-off"},
    {"segments[].work_of_interface", "meV/Å^2", per::area,
     "∫ F dz of the mean height; left out at a controlled top on quasi-static paths"},
    {"segments[].lost", "meV/Å^2", per::area,
     "energy damped on the way, or dissipated at instabilities; at a temperature the "
     "net heat, damped less what the thermostat's noise gives: at rest it fluctuates as the energy "
     "does and does not grow, and the first segment includes what warms the block from 0 K"},
    {"segments[].dissipated_in_block", "meV/Å^2", per::area,
     "energy that a viscoelastic block has dissipated by that, beside lost"},
    {"segments[].stored", "meV/Å^2", per::area,
     "change of the energy of interface and block (quasi-static): work_of_drive = stored + lost + "
     "dissipated_in_block"},
    {"segments[].work_of_settling", "meV/Å^2", per::area,
     "part of work_of_drive of a slide until steady: it brings a viscoelastic block into the shape "
     "in which it slides steadily, before the first step"},
    {"segments[].kinetic", "meV/Å^2", per::area,
     "kinetic and vibrational energy left at the end of an approach or a pull-off of a dynamic "
     "path "
     "at T = 0, as kinetic.*"},
    {"segments[].uncertainty", "meV/Å^2", per::area,
     "convergence of work_of_drive, lost and dissipated_in_block (quasi-static), for the sequence "
     "of instabilities that "
     "the path takes"},
    {"segments[].largest_attraction", "eV/Å", per::block, "on the way"},
    {"segments[].friction", "eV/Å", per::block,
     "force against a slide: the work of what moves the block sideways, over the distance"},
    {"segments[].largest_friction", "eV/Å", per::block, "the largest force against the slide"},
    {"segments[].steady", "", "",
     "of a slide over a wall: whether its mean friction over a correlation length of the map no "
     "longer drifts; what follows are means after the running-in"},
    {"segments[].running_in", "Å", "",
     "distance left out at the beginning, with which the variance of the mean friction is least"},
    {"segments[].steady_friction", "eV/Å", per::block,
     "force against the slide; of a steady slide of a viscoelastic block what is dissipated over "
     "the distance, which is more accurate"},
    {"segments[].steady_friction_error", "eV/Å", per::block,
     "its standard error, by blocking, as of the following ones; if that is larger, by how much "
     "what is dissipated differs from the work over the distance of a steady slide"},
    {"segments[].friction_stress", "MPa", "", "steady_friction over the area of the box"},
    {"segments[].friction_coefficient", "1", "",
     "steady_friction over the normal force; left out if that pulls"},
    {"segments[].friction_coefficient_error", "1", "", "its standard error"},
    {"segments[].steady_pressure", "MPa", "", "of the substrate on the lowest layer"},
    {"segments[].steady_contact_fraction", "1", per::sites, "contact fraction"},
    {"segments[].steady_contact_fraction_error", "1", per::sites, "its standard error"},
    {"segments[].steady_mean_height", "Å", "", "mean height of the lowest layer"},
    {"segments[].steady_dissipated_in_block", "eV/Å", per::block,
     "energy that a viscoelastic block dissipates over the distance: its part of steady_friction"},
    {"segments[].steady_lost", "eV/Å", per::block,
     "energy dissipated at instabilities over the distance: the other part"},
    {"segments[].pressure", "MPa", "",
     "at its end: of the substrate on the lowest layer; at a temperature the average by which the "
     "segment ends"},
    {"segments[].force", "nN", per::block,
     "the same as a force, of a sphere or a box with free edges"},
    {"segments[].pressure_scatter", "MPa", "",
     "thermal noise: rms of the force about that average"},
    {"segments[].pressure_averaged_over", "ps", "",
     "time of the average: one transit of sound, or a tenth of the potential's width at "
     "drive.velocity if that is shorter"},
    {"segments[].mean_height", "Å", "", "at its end"},
    {"segments[].top_displacement", "Å", "", "at its end"},
    {"segments[].contact_fraction", "1", per::sites,
     "at its end; of a dynamic path one step later"},
    {"segments[].slide", "Å", "", "at its end: place over the substrate along x and y"},
    {"dissipated.energy", "eV", per::block,
     "energy dissipated at instabilities since the start of a quasi-static path"},
    {"dissipated.not_followed", "eV", per::block,
     "of this, in steps longer than a fiftieth of the shortest time of block.prony: the block may "
     "have dissipated a part of it"},
    {"dissipated.events", "1", "", "number of instabilities"},
    {"dissipated.jumps[]", "", "",
     "the 20 largest instabilities in the order of the path; an empty list if there were none"},
    {"dissipated.jumps[].segment", "1", "", "number of the segment of drive.path, from 0"},
    {"dissipated.jumps[].energy", "eV", per::block, "energy dissipated"},
    {"dissipated.jumps[].top_displacement", "Å", "", "displacement of the top plane"},
    {"dissipated.jumps[].slide", "Å", "", "place over the substrate, of a path that slides"},
    {"dissipated.jumps[].mean_height", "Å", "",
     "mean height of the lowest layer, before and after"},
    {"dissipated.jumps[].force", "eV/Å", per::block,
     "force on the top plane, or of the substrate along a slide, before and after"},
    {"dissipated.jumps[].contact_fraction", "1", per::sites, "contact fraction, before and after"},
    {"dissipated.jumps[].site", "1", "", "x and y of the site that moved furthest"},
    {"dissipated.jumps[].largest_move", "Å", "", "how far it moved"},
    {"dissipated.jumps[].sites_moved", "1", "", "sites that moved more than half as far"},
    {"theory.persson.gamma_eff", "meV/Å^2", per::area,
     "effective work of adhesion, Persson's theory"},
    {"theory.persson.contact_fraction", "1", per::area, "area of real contact, projected"},
    {"theory.persson.gamma_full_contact", "meV/Å^2", per::area,
     "effective work of adhesion if contact is assumed to be complete"},
    {"theory.persson.delta_gamma", "meV/Å^2", per::area, "the Δγ that the theory was given"},
    {"theory.persson.gamma_eff_error", "meV/Å^2", per::area, "numerical error of gamma_eff"},
    {"theory.persson.contact_fraction_error", "1", per::area,
     "numerical error of contact_fraction"},
    {"theory.persson.elastic_energy", "meV/Å^2", per::area, "elastic energy stored in the contact"},
    {"theory.persson.h_rms", "Å", "", "rms height of the spectrum that was solved for"},
    {"theory.persson.rms_slope", "1", "", "rms slope of that spectrum"},
    {"theory.persson.theta", "1", "", "adhesion parameter E* h² q0/Δγ"},
    {"theory.persson.jkr_pull_off_force", "eV/Å", per::block,
     "pull-off force by JKR with gamma_eff"},
    {"theory.persson.critical_rms", "Å", "", "rms height beyond which adhesion vanishes"},
    {"theory.persson.critical_rms_full_contact", "Å", "",
     "the same if contact is assumed to be complete"},
    {"theory.persson.status", "", "", "\"adhesive\", \"pressed\" or \"no contact\""},
    {"theory.persson.converged", "", "",
     "whether the errors are below 1e-3 (of a ratio above 1: relative)"},
    {"theory.persson.note", "", "", "why the theory has no solution for this scene"},
    {"theory.renormalised.gamma_eff", "meV/Å^2", per::area,
     "effective work of adhesion, renormalised theory (of `asperity theory` and sweeps, like the "
     "following)"},
    {"theory.renormalised.gamma_eff_ratio", "1", "flat reference", "gamma_eff over Δγ"},
    {"theory.renormalised.contact_fraction", "1", per::area, "sites in contact"},
    {"theory.renormalised.separation", "Å", "",
     "mean separation; left out where the surfaces do not adhere"},
    {"theory.renormalised.tension", "GPa", "", "largest tension of the renormalised potential"},
    {"theory.renormalised.gamma_eff_error", "meV/Å^2", per::area, "numerical error of gamma_eff"},
    {"theory.renormalised.contact_fraction_error", "1", per::area,
     "numerical error of contact_fraction"},
    {"theory.renormalised.gamma_eff_expected_error", "meV/Å^2", per::area,
     "expected error: at zero load 19 of 20 simulated surfaces differ by less from gamma_eff; left "
     "out under a load"},
    {"theory.renormalised.contact_fraction_expected_error", "1", per::area,
     "the same of contact_fraction"},
    {"theory.renormalised.note", "", "", "why there is no solution, or its error is large"},
    {"theory.sphere.maugis_parameter", "1", "",
     "Maugis' λ of the smooth sphere; its stress is the largest tension of flat on flat"},
    {"theory.sphere.jkr_images", "meV/Å^2", per::contact,
     "pull-off force of the smooth sphere by JKR with the periodic images, as a work of adhesion "
     "by JKR"},
    {"theory.sphere.maugis_images", "meV/Å^2", per::contact,
     "as jkr_images, by the theory of Maugis and Dugdale"},
    {"theory.sphere.renormalised", "meV/Å^2", per::contact,
     "as maugis_images, with the work of adhesion and the largest tension of the renormalised "
     "theory"},
    {"theory.sphere.renormalised_parameter", "1", "", "its Maugis' λ"},
    {"theory.sphere.note", "", "", "why one of these is missing"},
    {"theory.sliding.friction_coefficient", "1", "",
     "Persson's theory of rubber friction at drive.velocity, under drive.load: hysteresis without "
     "adhesion"},
    {"theory.sliding.friction_stress", "MPa", "", "friction_coefficient times the load"},
    {"theory.sliding.contact_fraction", "1", per::area, "area of real contact at drive.velocity"},
    {"theory.sliding.slope", "s/m", "", "friction coefficient over velocity of slow sliding"},
    {"theory.sliding.largest_friction_coefficient", "1", "", "the maximum over velocity"},
    {"theory.sliding.velocity_of_largest", "m/s", "", "its velocity"},
    {"theory.sliding.curve[]", "", "", "of `asperity theory`: the theory over velocity"},
    {"theory.sliding.curve[].velocity", "m/s", "", "velocity"},
    {"theory.sliding.curve[].friction_coefficient", "1", "", "friction coefficient there"},
    {"theory.sliding.curve[].contact_fraction", "1", per::area, "area of real contact there"},
    {"theory.sliding.note", "", "", "why the theory has no number"},
    {"relaxed.elastic_energy", "meV/Å^2", per::area, "elastic energy of the relaxed state"},
    {"relaxed.mean_height", "Å", "",
     "mean height of the lowest layer above the substrate's mean plane (its apex, if it is "
     "curved)"},
    {"relaxed.residual_force", "eV/Å", "", "largest force left on a node"},
    {"energy.balance_error", "1", "largest term",
     "energy balance: energy.work - kinetic - elastic - interface - damped (- time_step at a "
     "temperature), at the last recorded step, over the largest energy or work so far"},
    {"energy.work", "eV", per::block,
     "work of the drive on the solids since they were at rest apart: it includes the energy that "
     "they have where the path starts"},
    {"energy.kinetic", "eV", per::block,
     "kinetic energy of the velocities at the last recorded step; at rest at a temperature T it is "
     "(3/2) N k T on average"},
    {"energy.elastic", "eV", per::block, "elastic energy at the last recorded step"},
    {"energy.interface", "eV", per::block,
     "energy of the interface at the last recorded step: pairs, or the wall's law"},
    {"energy.time_step", "eV", per::block,
     "at a temperature: -(dt²/8) Σ F²/m at the last recorded step; with it the energies are what "
     "the time step conserves"},
    {"energy.damped", "eV", per::block,
     "energy lost since the start: damped on dynamic paths (less the heat of the thermostat's "
     "noise), dissipated at instabilities on quasi-static ones"},
    {"energy.spring", "eV", per::block,
     "of energy.elastic, that of the spring that holds the top plane (drive.stiffness)"},
    {"energy.branches", "eV", per::block,
     "of energy.elastic, what the branches of a viscoelastic block store"},
    {"energy.dissipated_in_block", "eV", per::block,
     "what they have dissipated since the start, beside energy.damped"},
    {"surface.rms", "Å", "", "rms height of the substrate, without the cap"},
    {"surface.rms_slope", "1", "", "rms slope √⟨(∇h)²⟩, without the cap"},
    {"surface.min", "Å", "", "lowest height of the substrate"},
    {"surface.max", "Å", "", "its highest"},
    {"surface.atoms", "1", "", "number of atoms of a substrate of atoms anywhere"},
    {"surface.origin", "", "", "who measured the map, where its file says so"},
    {"surface.file_digest", "", "",
     "digest of what was read from surface.file: heights and width of a map, positions and types "
     "of atoms. A sweep takes a result again only if the file still holds the same"},
    {"interface.cutoff", "Å", "",
     "cutoff of the pairs, of a scene with interface.cutoff = \"4 r0\" too"},
    {"block.prony_file", "", "",
     "file of block.prony, as the scene names it; scene.block has the numbers that it held"},
    {"block.prony_error", "1", "", "rms error of the fit that this file is, over the moduli"},
    {"interface.table_digest", "", "",
     "digest of the numbers in the tables of potentials that the scene names. A sweep takes a "
     "result again only if they are the same"},
    {"interface.adhesion_digest", "", "",
     "digest of the field of interface.adhesion on the sites. A sweep takes a result again only if "
     "the file still holds the same"},
    {"interface.adhesion_least", "meV/Å^2", "", "least work of adhesion of a site of that field"},
    {"interface.adhesion_largest", "meV/Å^2", "", "its largest"},
    {"interface.table_error", "1", "delta_gamma",
     "bound of the error of energies of flat surfaces, and so of binding energies, that the spline "
     "between the rows of these tables and the noise of the rows make"},
    {"run.wall_seconds", "s", "", "wall time of this process"},
    {"run.processor_seconds", "s", per::rank,
     "processor time of all threads, from the first start"},
    {"run.steps", "1", "", "time steps; of a quasi-static path: points"},
    {"run.iterations", "1", "",
     "iterations: of a path's points, or of the state and of the search for others"},
    {"run.stopped", "", "",
     "\"max_steps\", \"wall_limit\" or \"signal\": the path is not complete"},
    {"run.file_digest", "", "", "digest at the end of the run.h5 that belongs to these numbers"},
    {"run.ranks", "1", "", "MPI ranks"},
    {"run.threads", "1", "", "threads of a rank"},
    {"run.phases.*.seconds", "s", per::rank,
     "wall time spent in a phase of the run, since the last resume"},
    {"run.phases.*.calls", "1", per::rank, "how often the phase was entered"},
    {"run.effects.*.on", "", "", "whether the scene switches this effect on"},
    {"run.effects.*.why", "", "", "the key that decides it"},
    {"run.device", "", "", "the device that made the steps; \"none\": the processor"},
    {"run.kernels", "", "", "instruction set of the kernels used: \"v2\", \"v3\", \"v4\""},
    {"run.version", "", "", "version of Asperity"},
    {"run.git", "", "", "commit that it was built from"},
    {"run.compiler", "", "", "compiler"},
    {"run.flags", "", "", "build type and compiler flags"},
    {"run.machine", "", "", "processor and number of processors"},
    {"digest", "", "",
     "last member: \"crc32:\" and the CRC-32, in hexadecimal, of all bytes before the comma in "
     "front of it"},
};

/// Data sets of run.h5 except the series (engine/run/series.hpp); "@" leads to an attribute.
inline constexpr Quantity run_quantities[] = {
    {"fields/*/gap", "Å", "", "height of a site above the substrate below it"},
    {"fields/*/pressure", "GPa", "a² of a site", "normal force on a site; repulsion is positive"},
    {"fields/*/distance", "Å", "",
     "distance of a site and the nearest atom; infinite beyond the interaction range"},
    {"fields/*/contact", "1", "",
     "1 where that is less than the inflection of the potential; with interface.pairs, where an "
     "atom is nearer than that of its type"},
    {"fields/*/adhesion", "meV/Å^2", "",
     "work of adhesion of a site, where interface.adhesion is a field"},
    {"fields/*/u_x", "Å", "", "displacement of a site"},
    {"fields/*/u_y", "Å", "", "displacement of a site"},
    {"fields/*/u_z", "Å", "", "displacement of a site"},
    {"fields/*/gap_edges", "Å", "", "edges of the bins of gap_density"},
    {"fields/*/gap_density", "1/Å", "", "distribution of gaps P(u), its integral is 1"},
    {"fields/*@slide_x", "Å", "", "place of the block over the substrate, where it was slid"},
    {"fields/*@slide_y", "Å", "", "the same along y"},
    {"fields/*@reference_height", "Å", "", "height of the undisplaced lowest layer"},
    {"substrate/height", "Å", "",
     "heights of the atoms of the substrate at (x a, y a), [y][x]; of atoms anywhere, those of the "
     "topmost one nearest to there"},
    {"substrate/atoms", "Å", "", "of atoms anywhere, their positions, [atom][x, y, z]"},
    {"substrate/type", "1", "",
     "of atoms anywhere with interface.pairs, the entry there of each atom, [atom], from 1"},
    {"substrate/spectrum_q", "1/Å", "", "wavevectors of the bins of the spectrum"},
    {"substrate/spectrum", "Å^4", "", "C(q) of the surface, averaged over rings"},
    {"substrate/spectrum_target", "Å^4", "", "C(q) that the scene asks for"},
    {"substrate@edge", "Å", "", "edge of the periodic box"},
    {"profile/q", "1/Å", "", "theory.h5: wavevector"},
    {"profile/zeta", "1", "", "magnification q/q_L"},
    {"profile/C", "Å^4", "", "power spectrum C(q)"},
    {"profile/A", "1", per::area, "A/A0, projected contact area"},
    {"profile/A_real", "1", per::area, "A*/A0, following the roughness"},
    {"profile/gamma_eff", "meV/Å^2", per::area, "γ_eff, Eq. (3)"},
    {"profile/sigma_a", "GPa", "", "detachment stress, Eq. (4)"},
    {"profile/U_el", "meV/Å^2", per::area, "elastic energy of roughness from q to q1, Eq. (5)"},
    {"profile/stress_variance", "GPa^2", "", "T(q), of the stress at full contact"},
};

/// The name of a quantity of result.json; a name that is not in the table does not compile.
struct Key {
    consteval Key(const char* name) : quantity(&find(name)) {}
    /// Returns the key of a name that is composed at run time. Throws if the table has none.
    static Key composed(std::string_view name) { return Key(find(name)); }
    const Quantity* quantity;

private:
    static constexpr const Quantity& find(std::string_view name) {
        for (const Quantity& q : result_quantities)
            if (q.name == name) return q;
        throw std::logic_error("no quantity of that name in result_quantities");
    }
    constexpr explicit Key(const Quantity& q) : quantity(&q) {}
};

inline std::string_view unit_of(Key key) { return key.quantity->unit; }

/// Returns the quantity of run.h5 with this path ("/fields/relaxed/gap"); nullptr if there is none.
const Quantity* run_quantity(std::string_view path);

/// Returns the page docs/reference/result.md. series: the columns of the series.
std::string result_markdown(std::span<const Quantity> series);

} // namespace asperity::io

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
// io/units.hpp reads them; "1" for a pure number, "" if the value is no number. A row whose name
// has {loss} stands for each loss of io/energy_terms.hpp, a row with {last} for each term that has
// a name in the group "energy", a row with {map} for each quantity of io/site_quantities.hpp.
#pragma once

#include "io/energy_terms.hpp"
#include "io/site_quantities.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

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

/// Quantities of result.json as written, in the order of the file.
inline constexpr Quantity written_quantities[] = {
    {"name", "", "", "name of the scene"},
    {"failure.exit_code", "1", "", "exit code of a command that failed"},
    {"failure.reason", "", "", "error message of the command: problem, reason, remedy"},
    {"delta_gamma", "meV/Å^2", per::area,
     "flat reference Δγ: work of adhesion of flat on flat with the potential, cutoff and lattices "
     "of the scene; for a substrate of atoms (surface.kind = \"atoms\") that of one layer of the "
     "block's lattice, as a unit of measure"},
    {"box.softness", "1", "",
     "largest decrease of a wall's attraction with the gap, divided by the stiffness of the "
     "longest "
     "wave of the box. Given if it is above 1: flat surfaces in this box jump, and works of the "
     "path and the energy lost are those of the box, not of the surface"},
    {"box.flat_loss", "meV/Å^2", per::area,
     "estimate of the energy that flat surfaces lose in this box in a cycle at a prescribed mean "
     "height, with box.softness"},
    {"binding_energy", "meV/Å^2", per::area,
     "-(U_LJ + U_el) of the relaxed state at zero load (path = [\"relax\"]: under drive.load). "
     "From "
     "rest, without a load, binding_energy = -work_of_drive.approach + losses of the approach + "
     "kinetic.approach = work_of_drive.pull_off - losses of the pull-off + kinetic.approach - "
     "kinetic.pull_off, with kinetic = 0 on quasi-static paths, and with spring.* added to "
     "kinetic.* if a spring holds the top plane"},
    {"binding_energy_uncertainty", "meV/Å^2", per::area,
     "convergence of the solver, not the error (asperity estimate): energy of residual forces of "
     "the size of drive.tolerance"},
    {"work_of_interface.approach", "meV/Å^2", per::area,
     "work of the interface during the approach: of its force on the mean height of the lowest "
     "layer, ∫ F dz, positive if the solids attract each other; dynamic paths, and quasi-static "
     "paths that control the mean height"},
    {"work_of_interface.pull_off", "meV/Å^2", per::area,
     "work of the interface during the pull-off, ∫ F dz: negative if the solids attract each "
     "other"},
    {"pair_binding_energy", "meV/Å^2", per::area,
     "-U_LJ of the relaxed state: binding energy of the pairs alone, without the elastic energy"},
    {"work_of_interface.uncertainty.approach", "meV/Å^2", per::area,
     "convergence of work_of_interface.approach (quasi-static): standard error, by the steps "
     "and the tolerance of the path"},
    {"work_of_interface.uncertainty.pull_off", "meV/Å^2", per::area,
     "convergence of work_of_interface.pull_off (quasi-static): standard error, by the steps "
     "and the tolerance of the path"},
    {"work_of_drive.approach", "meV/Å^2", per::area,
     "work of the drive on the solids during the approach, from rest beyond the interaction range: "
     "negative if they attract each other. The drive is the top plane (on dynamic paths with the "
     "damping medium, which moves with the plane) or the holder of the mean height"},
    {"work_of_drive.pull_off", "meV/Å^2", per::area,
     "work of the drive on the solids during the pull-off, until they are at rest beyond the "
     "interaction range"},
    {"work_of_drive.uncertainty.approach", "meV/Å^2", per::area,
     "convergence of work_of_drive.approach (quasi-static): standard error, by the steps and "
     "the tolerance of the path"},
    {"work_of_drive.uncertainty.pull_off", "meV/Å^2", per::area,
     "convergence of work_of_drive.pull_off (quasi-static): standard error, by the steps and "
     "the tolerance of the path"},
    {"{loss}.approach", "meV/Å^2", per::area,
     "{meaning}, during the approach; if the path has several cycles: of the last one"},
    {"{loss}.pull_off", "meV/Å^2", per::area,
     "{meaning}, during the pull-off, with the recovery of the solids after they have separated"},
    {"{loss}.cycle", "meV/Å^2", per::area,
     "{meaning}, in a whole cycle, from and to rest beyond the interaction range; the sum of all "
     "losses is the work of the drive"},
    {"{loss}.uncertainty.approach", "meV/Å^2", per::area,
     "convergence of {loss}.approach: standard error"},
    {"{loss}.uncertainty.pull_off", "meV/Å^2", per::area,
     "convergence of {loss}.pull_off: standard error"},
    {"kinetic.approach", "meV/Å^2", per::area,
     "kinetic and vibrational energy left at the end of the approach (dynamic, at T = 0, without a "
     "load), above the state at zero load"},
    {"kinetic.pull_off", "meV/Å^2", per::area,
     "kinetic and vibrational energy left at the end of the pull-off (dynamic, at T = 0), above a "
     "block at rest beyond the interaction range; lost.cycle includes it"},
    {"spring.approach", "meV/Å^2", per::area,
     "energy of the spring that holds the top plane (drive.stiffness) at the end of the approach "
     "(dynamic, at T = 0, without a load), apart from kinetic.approach"},
    {"spring.pull_off", "meV/Å^2", per::area,
     "energy of the spring that holds the top plane at the end of the pull-off (dynamic, at T = "
     "0), apart from kinetic.pull_off: the plane, released by the jump out of contact, oscillates "
     "on the spring; lost.cycle includes it"},
    {"stored.approach", "meV/Å^2", per::area,
     "change of the energy of interface and block (branches included) during the approach of a "
     "quasi-static path: work_of_drive = stored + all losses, during the approach, the pull-off "
     "and "
     "each segment; zero over a cycle"},
    {"stored.pull_off", "meV/Å^2", per::area,
     "change of the energy of interface and block (branches included) during the pull-off of a "
     "quasi-static path"},
    {"contact_fraction", "1", per::sites,
     "sites in contact at zero load: closer to an atom than the inflection of the pair potential; "
     "over a wall closer than the gap of its largest tension, or in touch with laws that begin at "
     "contact"},
    {"contact_area", "1", per::area,
     "area in contact with a wall at zero load: contact_fraction less (π - 1 + ln 2)/24 of a site "
     "for each pair of neighbours of which one is in contact (Yastrebov et al. 2017). "
     "contact_fraction counts sites at the edges of contacts whole, and is too large by a multiple "
     "of the spacing"},
    {"contact_area_uncertainty", "1", per::area,
     "error of contact_area by the spacing: the difference from contact_fraction, and more where "
     "rows of sites hold the edge of a contact"},
    {"mesh_error.binding_energy", "meV/Å^2", per::area,
     "error of binding_energy by the spacing of a continuum over a wall, by a rule that many "
     "scenes "
     "meet (docs/reports/mesh.md): from the sites at the edges of contacts, contact_fraction less "
     "contact_area, and from the width of the strip beside an edge in which the attraction acts"},
    {"mesh_error.work_of_drive.approach", "meV/Å^2", per::area,
     "error of work_of_drive.approach and lost.approach by the spacing, as "
     "mesh_error.binding_energy"},
    {"mesh_error.work_of_drive.pull_off", "meV/Å^2", per::area,
     "error of work_of_drive.pull_off and lost.pull_off by the spacing, as "
     "mesh_error.binding_energy"},
    {"mesh_error.approach_force", "eV/Å", per::block,
     "error of approach_force by the spacing, as mesh_error.binding_energy"},
    {"mesh_error.pull_off_force", "eV/Å", per::block,
     "error of pull_off_force by the spacing, as mesh_error.binding_energy"},
    {"repulsive_fraction", "1", per::sites,
     "sites whose net normal force is repulsive, at zero load"},
    {"approach_force", "eV/Å", per::block, "largest attraction during the approach"},
    {"pull_off_force", "eV/Å", per::block, "largest attraction during the pull-off"},
    {"jkr.approach", "meV/Å^2", per::contact,
     "work of adhesion by JKR, F/(1.5 π R), from the largest attraction of the approach (spheres)"},
    {"jkr.pull_off", "meV/Å^2", per::contact,
     "work of adhesion by JKR, F/(1.5 π R), from the largest attraction of the pull-off (spheres)"},
    {"jkr.approach_averaged", "meV/Å^2", per::contact,
     "as jkr.approach, from the largest attraction of a running mean over 2 ps, which removes the "
     "vibrations after an instability; needs output.series of 0.5 ps or less"},
    {"jkr.pull_off_averaged", "meV/Å^2", per::contact,
     "as jkr.pull_off, from the largest attraction of a running mean over 2 ps; needs "
     "output.series of 0.5 ps or less"},
    {"jkr.edge_pinning", "1", "",
     "factor by which pinning of the contact edge at rows of sites makes pull_off_force and "
     "jkr.pull_off too large, within 15 % (if the spacing does not resolve the range of a wall)"},
    {"jkr.relaxed", "meV/Å^2", per::contact,
     "work of adhesion by JKR from the binding energy at zero load instead of a pull-off force; "
     "not given under drive.load"},
    {"contact_radius.relaxed", "Å", "",
     "√(contact area/π) of the state at zero load (spheres): of contact_area, or of "
     "contact_fraction if there is none"},
    {"contact_radius.uncertainty.relaxed", "Å", "",
     "error of contact_radius.relaxed by the spacing, of contact_area_uncertainty"},
    {"contact_radius.pull_off", "Å", "",
     "√(contact area/π) at the largest attraction of the pull-off (spheres); of counted sites, "
     "without an error"},
    {"instrument.approach_force", "nN", per::block,
     "approach_force in units of instruments (spheres and boxes with free edges)"},
    {"instrument.pull_off_force", "nN", per::block, "pull_off_force in units of instruments"},
    {"instrument.contact_radius", "nm", "", "contact_radius.relaxed in units of instruments"},
    {"instrument.contact_radius_uncertainty", "nm", "",
     "contact_radius.uncertainty.relaxed in units of instruments"},
    {"instrument.energy_lost", "aJ", per::block, "dissipated.energy in units of instruments"},
    {"instrument.edge_distance", "nm", "",
     "smallest distance of a contact from a free edge of the box on the path (surface.boundary)"},
    {"rows[]", "", "",
     "the main numbers as people read them, in the order of the tables that a run prints; reports "
     "and notebooks print them too"},
    {"rows[].table", "", "",
     "name of the table: of a state, of the path or of its segments; \"\": a table of reports "
     "alone"},
    {"rows[].columns", "", "", "names of the columns of the table"},
    {"rows[].name", "", "", "name of the number"},
    {"rows[].detail", "", "", "true for an error or a share of the number above"},
    {"rows[].unit", "", "", "unit of the values"},
    {"rows[].texts", "", "", "the number as text, for each column; \"-\": none"},
    {"sentences", "", "", "sentences on the meaning of the numbers, as a run prints them"},
    {"segments[]", "", "", "the segments of drive.path that have ended, in order"},
    {"segments[].segment", "1", "", "number of the segment in drive.path, from 0"},
    {"segments[].name", "", "", "the segment's text in drive.path"},
    {"segments[].work_of_drive", "meV/Å^2", per::area,
     "work of the drive on the solids, including work sideways; on dynamic paths counted from rest "
     "at the start of the path, and to rest beyond the interaction range at a pull-off"},
    {"segments[].work_of_interface", "meV/Å^2", per::area,
     "work of the interface, ∫ F dz of the mean height; omitted for a controlled top on "
     "quasi-static paths"},
    {"segments[].{loss}", "meV/Å^2", per::area, "{meaning}, in the segment"},
    {"segments[].stored", "meV/Å^2", per::area,
     "change of the energy of interface and block (quasi-static): work_of_drive = stored + all "
     "losses"},
    {"segments[].work_of_settling", "meV/Å^2", per::area,
     "part of work_of_drive of a slide until steady: brings a viscoelastic block into the shape in "
     "which it slides steadily, before the first step"},
    {"segments[].kinetic", "meV/Å^2", per::area,
     "kinetic and vibrational energy left at the end of an approach or a pull-off of a dynamic "
     "path at T = 0, as kinetic.*"},
    {"segments[].spring", "meV/Å^2", per::area,
     "energy of the spring that holds the top plane at the end of an approach or a pull-off of a "
     "dynamic path at T = 0, as spring.*"},
    {"segments[].uncertainty", "meV/Å^2", per::area,
     "convergence of work_of_drive and of the losses (quasi-static): standard error, by the steps "
     "and the tolerance of the path"},
    {"segments[].largest_attraction", "eV/Å", per::block, "largest attraction in the segment"},
    {"segments[].friction", "eV/Å", per::block,
     "mean force against a slide: work that moves the block sideways, divided by the distance"},
    {"segments[].largest_friction", "eV/Å", per::block, "largest force against a slide"},
    {"segments[].steady", "", "",
     "slides over a wall: true if the mean friction over a correlation length of the map no longer "
     "drifts; the following values are means after the running-in"},
    {"segments[].running_in", "Å", "",
     "distance omitted at the beginning of the slide, for which the variance of the mean friction "
     "is least"},
    {"segments[].steady_friction", "eV/Å", per::block,
     "mean force against the slide; for a steady slide of a viscoelastic block the dissipated "
     "energy divided by the distance, which is more accurate"},
    {"segments[].steady_friction_error", "eV/Å", per::block,
     "error of steady_friction: the standard error, by blocking, as for the following values, at "
     "least the difference between the dissipated energy or the work and the work of the forces, "
     "divided by the distance; over a self-affine map of a continuum with the part of the spacing"},
    {"segments[].steady_friction_mesh_error", "eV/Å", per::block,
     "part of steady_friction_error: error by the spacing"},
    {"segments[].friction_stress", "MPa", "", "steady_friction divided by the area of the box"},
    {"segments[].friction_coefficient", "1", "",
     "steady_friction divided by the normal force; omitted under tension"},
    {"segments[].friction_coefficient_error", "1", "",
     "error of friction_coefficient, as steady_friction_error"},
    {"segments[].steady_pressure", "MPa", "",
     "mean normal force of the substrate on the lowest layer, divided by the area of the box"},
    {"segments[].steady_contact_fraction", "1", per::sites, "mean contact fraction"},
    {"segments[].steady_contact_fraction_error", "1", per::sites,
     "standard error of steady_contact_fraction"},
    {"segments[].steady_contact_area", "1", per::area,
     "mean area in contact with the wall, as contact_area"},
    {"segments[].steady_contact_area_uncertainty", "1", per::area,
     "error of steady_contact_area: that of the spacing, as of contact_area, and the standard "
     "error "
     "of the mean"},
    {"segments[].steady_mean_height", "Å", "", "average of the mean height of the lowest layer"},
    {"segments[].steady_{loss}", "eV/Å", per::block,
     "part of steady_friction: {meaning}, divided by the distance"},
    {"segments[].pressure", "MPa", "",
     "normal force of the substrate on the lowest layer at the end of the segment, divided by the "
     "area of the box; at a temperature the average that ends the segment"},
    {"segments[].force", "nN", per::block,
     "force at the end of the segment (spheres and boxes with free edges)"},
    {"segments[].pressure_scatter", "MPa", "",
     "rms deviation of the force from the average, by thermal noise"},
    {"segments[].pressure_averaged_over", "ps", "",
     "averaging time of the force: one transit of sound, or a tenth of the potential's width at "
     "drive.velocity if that is shorter"},
    {"segments[].mean_height", "Å", "",
     "mean height of the lowest layer at the end of the segment"},
    {"segments[].top_displacement", "Å", "",
     "displacement of the top plane at the end of the segment"},
    {"segments[].contact_fraction", "1", per::sites,
     "contact fraction at the end of the segment; on dynamic paths one step later"},
    {"segments[].contact_area", "1", per::area,
     "area in contact with a wall at the end of the segment, as contact_area; quasi-static"},
    {"segments[].contact_area_uncertainty", "1", per::area,
     "error of segments[].contact_area by the spacing, as contact_area_uncertainty"},
    {"segments[].yielding_fraction", "1", per::sites,
     "sites whose net pressure is the hardness (interface.hardness) within 0.1 %, at the end of "
     "the segment"},
    {"segments[].mean_set", "Å", "", "mean permanent set at the end of the segment"},
    {"segments[].largest_set", "Å", "",
     "largest permanent set of a site at the end of the segment"},
    {"segments[].slide", "Å", "",
     "place over the substrate along x and y at the end of the segment"},
    {"yielding.mean_set", "Å", "",
     "mean permanent set of a surface that yields (interface.hardness: a cap on the net pressure, "
     "without pile-up, hardening and dislocations)"},
    {"yielding.largest_set", "Å", "", "largest permanent set of a site"},
    {"yielding.largest_fraction", "1", per::sites,
     "largest share of sites at the hardness at the end of a segment"},
    {"yielding.tension_over_hardness", "1", "",
     "largest tension of flat surfaces divided by the smallest hardness, w/(ρ H): above about 1 "
     "the attraction at the edges of contacts is beyond what the solid bears, and tension does not "
     "yield here"},
    {"yielding.rms_before", "Å", "", "rms height of the surface before the path"},
    {"yielding.rms_after", "Å", "",
     "rms height of the surface at the end of the last segment, less its set"},
    {"yielding.slope_before", "1", "",
     "rms slope of the surface before the path, by differences of neighbours"},
    {"yielding.slope_after", "1", "",
     "rms slope of the surface at the end of the last segment, less its set, by differences of "
     "neighbours"},
    {"dissipated.energy", "eV", per::block,
     "energy dissipated at instabilities since the start of a quasi-static path"},
    {"dissipated.not_followed", "eV", per::block,
     "part of dissipated.energy in steps longer than a fiftieth of the shortest time of "
     "block.prony, of which the block may have dissipated a part"},
    {"dissipated.events", "1", "", "number of instabilities"},
    {"dissipated.jumps[]", "", "",
     "the 20 largest instabilities in the order of the path; an empty list if there were none"},
    {"dissipated.jumps[].segment", "1", "", "number of the segment of drive.path, from 0"},
    {"dissipated.jumps[].energy", "eV", per::block, "energy dissipated at the instability"},
    {"dissipated.jumps[].top_displacement", "Å", "", "displacement of the top plane"},
    {"dissipated.jumps[].slide", "Å", "", "place over the substrate (paths that slide)"},
    {"dissipated.jumps[].mean_height", "Å", "", "mean height of the lowest layer before and after"},
    {"dissipated.jumps[].force", "eV/Å", per::block,
     "force on the top plane, or of the substrate along a slide, before and after"},
    {"dissipated.jumps[].contact_fraction", "1", per::sites, "contact fraction before and after"},
    {"dissipated.jumps[].site", "1", "", "x and y of the site that moved furthest"},
    {"dissipated.jumps[].largest_move", "Å", "", "distance moved by that site"},
    {"dissipated.jumps[].sites_moved", "1", "", "number of sites that moved more than half as far"},
    {"theory.persson.gamma_eff", "meV/Å^2", per::area,
     "effective work of adhesion, Persson's theory"},
    {"theory.persson.contact_fraction", "1", per::area, "area of real contact, projected"},
    {"theory.persson.gamma_full_contact", "meV/Å^2", per::area,
     "effective work of adhesion for complete contact"},
    {"theory.persson.delta_gamma", "meV/Å^2", per::area, "Δγ used by the theory"},
    {"theory.persson.gamma_eff_error", "meV/Å^2", per::area, "numerical error of gamma_eff"},
    {"theory.persson.contact_fraction_error", "1", per::area,
     "numerical error of contact_fraction"},
    {"theory.persson.elastic_energy", "meV/Å^2", per::area, "elastic energy stored in the contact"},
    {"theory.persson.h_rms", "Å", "", "rms height of the spectrum used by the theory"},
    {"theory.persson.rms_slope", "1", "", "rms slope of the spectrum used by the theory"},
    {"theory.persson.theta", "1", "", "adhesion parameter E* h² q0/Δγ"},
    {"theory.persson.jkr_pull_off_force", "eV/Å", per::block,
     "pull-off force by JKR with gamma_eff"},
    {"theory.persson.critical_rms", "Å", "", "rms height beyond which adhesion vanishes"},
    {"theory.persson.critical_rms_full_contact", "Å", "",
     "rms height beyond which adhesion vanishes for complete contact"},
    {"theory.persson.area_factor", "", "",
     "definition of the area that adheres: theory.area_factor, or what \"auto\" stands for"},
    {"theory.persson.status", "", "", "\"adhesive\", \"pressed\" or \"no contact\""},
    {"theory.persson.converged", "", "",
     "true if the errors are below 1e-3 (relative for a ratio above 1)"},
    {"theory.persson.note", "", "", "reason why the theory has no solution for this scene"},
    {"theory.capped.pressure", "MPa", "",
     "largest pressure at the end of a segment of a surface that yields, for which Persson's "
     "theory with a cap is computed: without adhesion, the pressure absorbed at 0 and at the "
     "hardness"},
    {"theory.capped.contact_fraction", "1", per::area,
     "contact area at that pressure by Persson's theory with a cap"},
    {"theory.capped.yielding_fraction", "1", per::area,
     "part of the area at the hardness at that pressure, by Persson's theory with a cap"},
    {"theory.capped.note", "", "", "reason why the theory with a cap does not apply to this scene"},
    {"theory.renormalised.gamma_eff", "meV/Å^2", per::area,
     "effective work of adhesion, renormalised theory (in results of `asperity theory` and sweeps, "
     "like the following)"},
    {"theory.renormalised.gamma_eff_ratio", "1", "flat reference", "gamma_eff/Δγ"},
    {"theory.renormalised.contact_fraction", "1", per::area, "sites in contact"},
    {"theory.renormalised.separation", "Å", "",
     "mean separation; omitted if the surfaces do not adhere"},
    {"theory.renormalised.tension", "GPa", "", "largest tension of the renormalised potential"},
    {"theory.renormalised.gamma_eff_error", "meV/Å^2", per::area, "numerical error of gamma_eff"},
    {"theory.renormalised.contact_fraction_error", "1", per::area,
     "numerical error of contact_fraction"},
    {"theory.renormalised.gamma_eff_expected_error", "meV/Å^2", per::area,
     "expected error: at zero load 19 of 20 simulated surfaces differ by less from gamma_eff; "
     "omitted under a load"},
    {"theory.renormalised.contact_fraction_expected_error", "1", per::area,
     "expected error of contact_fraction, as for gamma_eff"},
    {"theory.renormalised.note", "", "",
     "reason why there is no solution, or why its error is large"},
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
    {"theory.sphere.renormalised_parameter", "1", "",
     "Maugis' λ with the work of adhesion and the largest tension of the renormalised theory"},
    {"theory.sphere.note", "", "", "reason why one of these is missing"},
    {"theory.sliding.friction_coefficient", "1", "",
     "Persson's theory of rubber friction at drive.velocity, under drive.load: hysteresis without "
     "adhesion"},
    {"theory.sliding.friction_stress", "MPa", "", "friction_coefficient times the load"},
    {"theory.sliding.contact_fraction", "1", per::area, "area of real contact at drive.velocity"},
    {"theory.sliding.slope", "s/m", "",
     "friction coefficient divided by velocity, in the limit of slow sliding"},
    {"theory.sliding.largest_friction_coefficient", "1", "",
     "maximum of the friction coefficient over velocity"},
    {"theory.sliding.velocity_of_largest", "m/s", "",
     "velocity of the largest friction coefficient"},
    {"theory.sliding.curve[]", "", "", "the theory as a function of velocity (`asperity theory`)"},
    {"theory.sliding.curve[].velocity", "m/s", "", "velocity"},
    {"theory.sliding.curve[].friction_coefficient", "1", "",
     "friction coefficient at this velocity"},
    {"theory.sliding.curve[].contact_fraction", "1", per::area,
     "area of real contact at this velocity"},
    {"theory.sliding.note", "", "", "reason why the theory has no result"},
    {"relaxed.elastic_energy", "meV/Å^2", per::area, "elastic energy of the relaxed state"},
    {"relaxed.mean_height", "Å", "",
     "mean height of the lowest layer above the substrate's mean plane (its apex, if it is "
     "curved)"},
    {"relaxed.residual_force", "eV/Å", "", "largest residual force on a node"},
    {"energy.balance_error", "1", "largest term",
     "energy balance at the last recorded step: energy.work - kinetic - elastic - interface (- "
     "time_step at a temperature) - all losses, divided by the largest energy or work so far"},
    {"energy.{last}", "eV", per::block, "{meaning}; at the last recorded step"},
    {"surface.rms", "Å", "",
     "rms height of the substrate, without the cap; with surface.counter of the sum of both "
     "surfaces"},
    {"surface.rms_slope", "1", "", "rms slope √⟨(∇h)²⟩, without the cap"},
    {"surface.min", "Å", "", "smallest height of the substrate"},
    {"surface.max", "Å", "", "largest height of the substrate"},
    {"surface.atoms", "1", "", "number of atoms of a substrate of atoms"},
    {"surface.origin", "", "", "author of the map, if its file names one"},
    {"surface.file_digest", "", "",
     "digest of the values read from surface.file: heights and width of a map, or positions and "
     "types of atoms. A sweep reuses a result only if the digest is unchanged"},
    {"surface.own.rms", "Å", "", "rms height of the block's surface, with surface.counter"},
    {"surface.own.rms_slope", "1", "", "rms slope of the block's surface, with surface.counter"},
    {"surface.counter.rms", "Å", "", "rms height of the second solid's surface"},
    {"surface.counter.rms_slope", "1", "", "rms slope of the second solid's surface"},
    {"surface.counter.file_digest", "", "",
     "digest of the values read from surface.counter, as surface.file_digest"},
    {"surface.correlation", "1", "",
     "correlation of the heights of both surfaces, each outwards from its own solid: 1 for equal "
     "ones, -1 for ones that fit into one another, 0 if one is flat"},
    {"surface.band_overlap", "1", "",
     "overlap of the spectra of both surfaces: 1 for proportional ones, 0 for disjoint ones"},
    {"interface.cutoff", "Å", "", "cutoff of the pairs, also if the scene says \"4 r0\""},
    {"block.prony_file", "", "", "file that block.prony names; scene.block has its values"},
    {"block.prony_error", "1", "", "relative rms error of the fit in that file"},
    {"interface.table_digest", "", "",
     "digest of the values of the scene's tabulated potentials. A sweep reuses a result only if "
     "the digest is unchanged"},
    {"interface.{map}_digest", "", "",
     "digest of the field of interface.{map} on the sites. A sweep reuses a result only if the "
     "digest is unchanged"},
    {"interface.{map}_least", "{unit}", "",
     "smallest {words} of a site in the field of interface.{map}"},
    {"interface.{map}_largest", "{unit}", "",
     "largest {words} of a site in the field of interface.{map}"},
    {"interface.table_error", "1", "delta_gamma",
     "bound of the error of energies of flat surfaces, and so of binding energies, from the spline "
     "between the rows of these tables and the noise of the rows"},
    {"run.wall_seconds", "s", "", "wall time of this process"},
    {"run.processor_seconds", "s", per::rank,
     "processor time of all threads, from the first start"},
    {"run.steps", "1", "", "number of time steps, or of points of a quasi-static path"},
    {"run.iterations", "1", "",
     "number of iterations of a path's points, or of the state and the search for others"},
    {"run.stopped", "", "",
     "reason why the path is incomplete: \"max_steps\", \"wall_limit\" or \"signal\""},
    {"run.file_digest", "", "", "digest at the end of the run.h5 of this result"},
    {"run.ranks", "1", "", "number of MPI ranks"},
    {"run.threads", "1", "", "number of threads of a rank"},
    {"run.phases.*.seconds", "s", per::rank,
     "wall time spent in a phase of the run, since the last resume"},
    {"run.phases.*.calls", "1", per::rank, "number of times that the phase was entered"},
    {"run.effects.*.on", "", "", "true if the scene switches the effect on"},
    {"run.effects.*.why", "", "", "key that decides"},
    {"run.device", "", "", "device that computed the steps; \"none\": the processor"},
    {"run.kernels", "", "", "instruction set of the kernels used: \"v2\", \"v3\", \"v4\""},
    {"run.version", "", "", "version of Asperity"},
    {"run.git", "", "", "commit that the program was built from"},
    {"run.compiler", "", "", "compiler"},
    {"run.flags", "", "", "build type and compiler flags"},
    {"run.machine", "", "", "processor and number of processors"},
    {"digest", "", "",
     "last member: \"crc32:\" and the CRC-32, in hexadecimal, of all bytes before the comma in "
     "front of the member"},
};

/// Returns true if a row of written_quantities stands for a quantity of this name.
constexpr bool stands_for(const Quantity& row, std::string_view name) {
    const std::size_t open = row.name.find('{'), close = row.name.find('}');
    if (open == std::string_view::npos) return row.name == name;
    const std::string_view before = row.name.substr(0, open), after = row.name.substr(close + 1);
    if (!name.starts_with(before) || !name.ends_with(after)) return false;
    name = name.substr(before.size(), name.size() - before.size() - after.size());
    if (row.name.substr(open, close + 1 - open) == "{map}")
        return std::ranges::any_of(site_quantities,
                                   [&](const SiteQuantity& of) { return of.name == name; });
    return std::ranges::any_of(energy_terms,
                               [&](const EnergyTerm& term) { return term.word(row.name) == name; });
}

/// Returns the quantities of result.json, in the order of the file.
const std::vector<Quantity>& result_quantities();

/// Data sets of run.h5 as written; "@" leads to an attribute.
inline constexpr Quantity written_run_quantities[] = {
    {"fields/*/gap", "Å", "", "height of a site above the substrate below it"},
    {"fields/*/pressure", "GPa", "a² of a site", "normal force on a site; repulsion is positive"},
    {"fields/*/distance", "Å", "",
     "distance from a site to the nearest atom; infinite beyond the interaction range"},
    {"fields/*/contact", "1", "",
     "1 if distance is below the inflection of the pair potential; with interface.pairs, if an "
     "atom is closer than that of its type"},
    {"fields/*/{map}", "{unit}", "", "{words} of a site, if interface.{map} is a field"},
    {"fields/*/set", "Å", "", "permanent set of a site of a surface that yields"},
    {"fields/*/yielded_height", "Å", "",
     "heights of a surface that yields, less its set: a map that surface.file reads"},
    {"fields/*/u_x", "Å", "", "displacement of a site along x"},
    {"fields/*/u_y", "Å", "", "displacement of a site along y"},
    {"fields/*/u_z", "Å", "",
     "displacement of a site along z; with surface.counter that of the block less that of the "
     "second solid"},
    {"fields/*/u_z_counter", "Å", "",
     "displacement of the surface of an elastic second solid along z, whose lower end is held"},
    {"fields/*/gap_edges", "Å", "", "edges of the bins of gap_density"},
    {"fields/*/gap_density", "1/Å", "", "distribution of gaps P(u), with integral 1"},
    {"fields/*@slide_x", "Å", "", "place of the block over the substrate along x, after a slide"},
    {"fields/*@slide_y", "Å", "", "place of the block over the substrate along y, after a slide"},
    {"fields/*@reference_height", "Å", "", "height of the undisplaced lowest layer"},
    {"stress/*/largest", "GPa", "",
     "largest stresses in each layer of the block, that of the surface first: [layer][von Mises, "
     "Tresca, largest principal stress]; tension is positive"},
    {"stress/*/largest_error", "GPa", "",
     "sum of the changes of largest between the depths of the search, from the sites to twice the "
     "points, with a constant pressure on each site, and by images of free edges; NaN: the value "
     "is "
     "not to be quoted, because it lies less than half a spacing below the surface or at the end "
     "of the search"},
    {"stress/*/largest_place", "Å", "", "places of largest: [layer][measure][x, y, depth]"},
    {"stress/*/layers", "Å", "", "depths of the searched part of each layer: [layer][from, to]"},
    {"stress/*/profile_depth", "Å", "", "depths of profile"},
    {"stress/*/profile", "GPa", "",
     "largest stresses at each depth: [depth][von Mises, Tresca, largest principal stress]"},
    {"stress/*/depth", "Å", "", "depths of section and volume, from the surface into the block"},
    {"stress/*/section", "GPa", "",
     "stresses in two vertical planes, through the largest stress of von Mises and through the "
     "largest tension: [plane][xx, yy, zz, xy, xz, yz][depth][x]"},
    {"stress/*/section_y", "Å", "", "places of the planes of section"},
    {"stress/*/map", "GPa", "", "stresses at the depth map_depth: [xx, yy, zz, xy, xz, yz][y][x]"},
    {"stress/*/volume", "GPa", "", "stresses at all depths: [xx, yy, zz, xy, xz, yz][depth][y][x]"},
    {"stress/*@map_depth", "Å", "", "depth of the largest stress of von Mises"},
    {"stress/*@friction", "1", "", "output.stress_friction"},
    {"substrate/height", "Å", "",
     "heights of the atoms of the substrate at (x a, y a), [y][x]; for a substrate of atoms the "
     "height of the topmost atom nearest to this place"},
    {"substrate/atoms", "Å", "", "positions of the atoms of a substrate of atoms, [atom][x, y, z]"},
    {"substrate/type", "1", "",
     "type of each atom of a substrate of atoms with interface.pairs: index in interface.pairs, "
     "from 1, [atom]"},
    {"substrate/spectrum_q", "1/Å", "", "wavevectors of the bins of the spectrum"},
    {"substrate/spectrum", "Å^4", "", "C(q) of the surface, averaged over rings"},
    {"substrate/own_spectrum", "Å^4", "", "C(q) of the block's surface, with surface.counter"},
    {"substrate/counter_spectrum", "Å^4", "", "C(q) of the second solid's surface"},
    {"substrate/counter_height", "Å", "",
     "heights of the second solid in its place, outwards from it, [y][x]; height is the sum"},
    {"substrate/spectrum_target", "Å^4", "", "C(q) of the scene's power law"},
    {"substrate@edge", "Å", "", "edge of the periodic box"},
    {"profile/q", "1/Å", "", "theory.h5: wavevector"},
    {"profile/zeta", "1", "", "magnification q/q_L"},
    {"profile/C", "Å^4", "", "power spectrum C(q)"},
    {"profile/A", "1", per::area, "A/A0, projected contact area"},
    {"profile/A_real", "1", per::area, "A*/A0, area that follows the roughness"},
    {"profile/gamma_eff", "meV/Å^2", per::area, "γ_eff, Eq. (3)"},
    {"profile/sigma_a", "GPa", "", "detachment stress, Eq. (4)"},
    {"profile/U_el", "meV/Å^2", per::area, "elastic energy of roughness from q to q1, Eq. (5)"},
    {"profile/stress_variance", "GPa^2", "", "T(q), variance of the stress at full contact"},
};

/// Returns the quantity of result.json of this name. Throws std::logic_error if there is none.
const Quantity& result_quantity(std::string_view name);

/// The name of a quantity of result.json; a name that is not in the table does not compile.
struct Key {
    consteval Key(const char* literal) : name(literal) {
        if (std::ranges::none_of(written_quantities,
                                 [&](const Quantity& row) { return stands_for(row, literal); }))
            throw std::logic_error("no quantity of that name in written_quantities");
    }
    /// Returns the key of a name that is composed at run time. Throws if the table has none.
    static Key composed(std::string_view name) { return Key(result_quantity(name)); }
    /// Returns the key of a term: its name between two parts of a name of the table. Throws if the
    /// table has none.
    static Key of(std::string_view before, const EnergyTerm& term, std::string_view after = {}) {
        return composed(std::string(before).append(term.key).append(after));
    }
    std::string_view name;

private:
    explicit Key(const Quantity& quantity) : name(quantity.name) {}
};

inline std::string_view unit_of(Key key) { return result_quantity(key.name).unit; }

/// Returns the data sets of run.h5 except the series (engine/run/series.hpp).
const std::vector<Quantity>& run_quantities();
/// Returns the quantity of run.h5 with this path ("/fields/relaxed/gap"); nullptr if there is none.
const Quantity* run_quantity(std::string_view path);

/// Returns the page docs/reference/result.md. series: the columns of the series.
std::string result_markdown(std::span<const Quantity> series);

} // namespace asperity::io

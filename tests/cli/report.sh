#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# asperity report: of a run, of one that stopped, failed or lost its run.h5, of the theory and of a sweep; and
# of directories that hold none of these.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

# holds FILE TEXT...
holds() {
    local file=$1 text
    shift
    for text in "$@"; do grep -qF -- "$text" "$file" || fail "$file lacks '$text'"; done
}

printf '[surface]\nsites = 32\nrms = 0.5\n[drive]\nvelocity = 100\ntimestep = 20\n' >small.toml
expect 0 run small.toml --progress off --out run
before=$(cat run/result.json)
expect 0 report run
says "run/report.html: one page"
holds run/report.html '<h1>small: rms 0.5 Å, 32 × 32</h1>' 'binding energy at zero load' 'Persson’s theory' 'energy balance' \
    'Not simulated' 'Force and separation' 'Energies' 'Contact over the path' 'The state at zero load' \
    'Gap (Å)' 'Pressure, positive pushes (GPa)' 'Distribution of gaps' 'Distribution of pressure' \
    'hysteresis' 'pull-off stress' 'Height of the substrate (Å)' \
    'Roughness spectrum' 'Binding energy and roughness' 'All numbers' 'Time spent' 'timestep = 20.0' \
    'Provenance' 'compiler' 'machine' 'arXiv:1112.5275' 'data:image/png;base64,'
for plot in separation loading contact energy balance gap-zero-load pressure-zero-load contact-zero-load \
    gaps-zero-load pressures-zero-load height spectrum roughness; do
    [ "$(head -c 8 "run/report/$plot.png" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] ||
        fail "report/$plot.png is no PNG"
    [ -s "run/report/$plot.csv" ] || fail "report/$plot.csv was not written"
done
# Every plot is in the page, and in the files.
[ "$(grep -o '<figure>' run/report.html | wc -l)" = "$(find run/report -name '*.csv' | wc -l)" ] ||
    fail "figures and files differ in number"
# Nothing is fetched from anywhere.
grep -oE '(src|href)="[^"]*"' run/report.html | grep -vE '="(data:|#)' && fail "the page points outside"
[ "$(wc -l <run/report/gap-zero-load.csv)" = 32 ] || fail "the map has not 32 lines"
[ "$before" = "$(cat run/result.json)" ] || fail "the result was touched"
expect 0 report run/ # again, and with a slash: the same page
holds run/report.html '<h1>small: rms 0.5 Å, 32 × 32</h1>'

# The scene in the page is the scene: it gives the same plan.
sed -n '/<pre>/,/<\/pre>/p' run/report.html | sed 's/<[^>]*>//g; s/&quot;/"/g' >again.toml
expect 0 check again.toml
says "stable up to"

# Stopped early, failed, without its run.h5, with a damaged one.
expect 0 run small.toml --progress off --out stopped --set drive.max_steps=50
expect 0 report stopped
holds stopped/report.html 'stopped early' 'max_steps' 'Not simulated'
expect 3 run small.toml --progress off --out failed --set drive.timestep=70 drive.velocity=3000
expect 0 report failed
holds failed/report.html 'This run failed' 'why:' 'drive.velocity'
cp -r run bare && rm -r bare/run.h5 bare/report bare/report.html
expect 0 report bare
holds bare/report.html 'binding energy at zero load' 'All numbers'
cp -r run damaged && echo "nonsense" >damaged/run.h5
expect 0 report damaged
holds damaged/report.html 'run.h5 cannot be read' 'it is not an HDF5 file'

# A state without a path, the theory alone, a sweep.
expect 0 run small.toml --progress off --out state --set 'drive.path=["zero-load"]'
expect 0 report state
holds state/report.html 'Gap (Å)' 'no inertia'
expect 0 theory small.toml --out theory
expect 0 report theory
holds theory/report.html 'nothing was simulated' 'Persson’s theory'
expect 0 sweep small.toml --theory-only --set surface.rms=0.2:1:0.2 --set drive.load=0,100 --out sweep
expect 0 report sweep
holds sweep/report.html '<h1>small</h1>' '10 points over surface.rms (0.2 to 1), drive.load (0 to 100)' 'load = 100 MPa' \
    'All points' 'full theory'
[ -s sweep/report/gamma.png ] || fail "no plot of the sweep"
# Points that were simulated carry their numbers; names with dots are whole.
sed '0,/"delta_gamma": [0-9]/s//"result": { "delta_gamma": 100, "binding_energy": 91.5, "work_of_adhesion.approach": 90.25 },\n&/' \
    sweep/sweep.json >simulated.json
mkdir simulated && mv simulated.json simulated/sweep.json
expect 0 report simulated
holds simulated/report.html 'state at zero load' 'approach' '0.9150' '0.9025'
# A sweep of runs: the same plots as the sweep's own, a map and a page of each point, seeds shared.
printf '[surface]\nsites = 24\n[block]\nmodel = "spectral"\n[drive]\npath = ["zero-load"]\n' >state.toml
expect 0 sweep state.toml --set surface.rms=0.2,0.6 surface.seed=1,2 --progress off --out points
expect 0 report points
holds points/report.html '4 points over' 'href="rms=0.2,seed=1/report.html"' 'href="rms=0.6,seed=1/report.html"' \
    'class="thumbs"' '±'
[ -s points/rms=0.6,seed=1/report.html ] && [ ! -e points/rms=0.6,seed=2/report.html ] || fail "pages of the points"
[ "$(grep -o '<path d="[^"]*"' points/gamma.svg | wc -l)" -gt 2 ] || fail "no curve of the theory"
head -n 1 points/report/gamma.csv | grep -q theory || fail "no curve of the theory in the report"
page=$(stat -c %Y%i points/rms=0.6,seed=1/report.html)
expect 0 report points
[ "$page" = "$(stat -c %Y%i points/rms=0.6,seed=1/report.html)" ] || fail "a page was made again"
sed 's/24/20/' state.toml >other.toml
expect 0 sweep state.toml other.toml --set surface.rms=0.2,0.6 --progress off --out both
expect 0 report both
holds both/report.html '<h1>other, state</h1>' 'other: state at zero load' 'href="state/rms=0.2/report.html"' \
    'The points of other'
# A sphere: its own numbers, and the curves of a smooth one.
expect 0 run small.toml --progress off --out sphere --set surface.radius=100 surface.rms=0.2 output.series=10
expect 0 report sphere
holds sphere/report.html 'R = 100 Å</h1>' 'smooth sphere, Maugis-Dugdale with images' 'by JKR' 'pull-off force' 'force F (nN)'
# A measured surface: whose it is; and the map need not be there any more.
cp "$source"/scenes/measured/uncd* .
expect 0 run uncd.toml --progress off --out measured --set surface.sites=24 surface.file_size=62.4 surface.rms=0.5
grep -qF '"file": "uncd_afm_100nm_512.h5"' measured/result.json || fail "the map's path is not as it was given"
expect 0 theory uncd.toml --out measured-theory --set surface.sites=24 surface.file_size=62.4 surface.rms=0.5
grep -qF 'L. Pastewka' measured-theory/result.json || fail "the theory of a measured surface does not say whose it is"
rm uncd_afm_100nm_512.h5
expect 0 report measured
holds measured/report.html 'measured surface' 'L. Pastewka, CC BY 4.0' 'a measured substrate' 'with the map beside it'
[ "$(grep -o 'theory' measured/report/roughness.csv | wc -l)" -gt 0 ] || fail "no theory over the stored surface"
# What has no name has its directory's; text is text.
cp -r bare 'a <b> & c' && echo '{"delta_gamma": 1}' >'a <b> & c/result.json'
expect 0 report 'a <b> & c'
holds 'a <b> & c/report.html' '<h1>a &lt;b&gt; &amp; c</h1>'

mkdir empty
expect 4 report empty
says "holds no result"
says "fix:"
expect 4 report gone
says "there is no such directory"
expect 4 report small.toml
says "it is a file"
expect 2 report
mkdir broken && echo '{"scene": [1, ' >broken/result.json
expect 4 report broken
echo '[1, 2]' >broken/result.json
expect 0 report broken
mkdir odd && echo '{"points": 3}' >odd/sweep.json
expect 4 report odd
says "is no sweep"
mpirun=$(command -v mpirun)
if [ -n "$mpirun" ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    out=$(timeout 60 "$mpirun" --oversubscribe -n 2 "$asperity" report empty 2>&1)
    code=$?
    [ $code -eq 4 ] || fail "mpirun: exit code $code: $out"
    [ "$(grep -c 'holds no result' <<<"$out")" = 1 ] || fail "not one complaint: $out"
fi
finish

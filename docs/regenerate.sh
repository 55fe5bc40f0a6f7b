#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
#     docs/regenerate.sh
#
# Makes the pages, tables and figures of the docs that take minutes, with the program as it is, and lists the
# others with the date and the commit of the last change of each. Look at the difference before it is committed.
# Runs go to results/regenerate, which must not be there. maps.png needs VTK (PyPI), in $ASPERITY_OTHERS (tests/python/others.sh).
set -eu
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
place=results/regenerate
[ ! -e $place ] || { echo "$place is there already: remove it first" >&2; exit 2; }
mkdir -p $place
gallery=docs/gallery
python=${ASPERITY_PYTHON:-/usr/bin/python3} # whose packages the script asperity installs
export PYTHONPATH=python
made=""
made() { made="$made $*"; echo "made: $*"; }

./asperity info >$place/info.txt # builds, before a page is opened
./asperity defaults --markdown >$place/scene.md && mv $place/scene.md docs/reference/scene.md
./asperity defaults --results >$place/result.md && mv $place/result.md docs/reference/result.md
made docs/reference/scene.md docs/reference/result.md

for figure in 2 3; do
    ./asperity sweep scenes/paper/fig$figure.toml --theory-only --out $place/theory-$figure >$place/log.txt
done
cp $place/theory-2/sweep.csv $gallery/theory-fig2.csv # the same numbers as those of figure 3
made $gallery/theory-fig2.csv
cp $place/theory-2/gamma.svg $gallery/theory-fig2a.svg
cp $place/theory-2/area.svg $gallery/theory-fig2b.svg
cp $place/theory-3/full-contact.svg $gallery/theory-fig3.svg
made $gallery/theory-fig2a.svg $gallery/theory-fig2b.svg $gallery/theory-fig3.svg

./asperity run scenes/first-contact.toml --progress off --out $place/first-contact | tee $place/first-contact.txt
"$python" $gallery/plot.py $place/first-contact $gallery/first-contact.png
made $gallery/first-contact.png

"$python" $gallery/tip.py $place/tip $gallery/tip.png
made $gallery/tip.png
./asperity run scenes/coating.toml --progress off --out $place/coating >$place/log.txt
"$python" $gallery/coating.py $place/coating $gallery/coating.png
made $gallery/coating.png

./asperity run scenes/ring/ring-and-liner.toml --progress off --out $place/ring-and-liner >$place/log.txt
"$python" $gallery/pair.py $place/ring-and-liner $gallery/pair.png
made $gallery/pair.png

"$python" $gallery/examples.py
made $gallery/examples-*.svg

./asperity sweep scenes/paper/small/fig6.toml --out $place/fig6 >$place/log.txt
"$python" $gallery/contact_regions.py $place/fig6 $gallery/small-fig6.png
made $gallery/small-fig6.png

# States at zero load against both theories (half an hour of one core), spheres, and the definitions of the work.
data=docs/data
./asperity sweep scenes/paper/fig2-equilibrium.toml --set theory.spectrum=realised \
    --out $place/renormalised >$place/log.txt
./asperity sweep scenes/paper/fig5-equilibrium.toml --out $place/fig5-equilibrium >$place/log.txt
for study in renormalised fig5-equilibrium; do cp $place/$study/sweep.csv $data/$study.csv; done
"$python" scenes/validation/parameters.py --out $place/parameters >$place/parameters.txt
cp $place/parameters/parameters.csv $data
made $data/renormalised.csv $data/fig5-equilibrium.csv $data/parameters.csv
"$python" scenes/validation/curves.py --curves 600 --csv $data/tables/curve-fits.csv
made $data/tables/curve-fits.csv
"$python" scenes/validation/tip_curves.py --csv $data/tables/tip-curves.csv
made $data/tables/tip-curves.csv
for sites in 32 64; do
    table=yielding$([ $sites = 64 ] || echo -cost).csv
    "$python" scenes/validation/yielding.py --sites $sites --out $place/yielding-$sites --csv $data/tables/$table
    made $data/tables/$table
done
"$python" scenes/validation/dents.py --out $place/dents --csv $data/tables/dents.csv
made $data/tables/dents.csv
"$python" scenes/validation/works.py --out $place/errors --csv $data/tables/standard-errors.csv
made $data/tables/standard-errors.csv
"$python" scenes/validation/loss_sizes.py --out $place/loss-sizes --csv $data/tables/loss-sizes.csv
made $data/tables/loss-sizes.csv
"$python" $gallery/renormalised.py
"$python" $gallery/fig5.py
./asperity sweep scenes/paper/small/fig2-quasistatic.toml --set surface.rms=0.5,1,1.5,2,3,4.5 --out $place/works >$place/log.txt
cp $place/works/works.svg $gallery/fig2-works.svg
./asperity sweep scenes/paper/small/fig5-quasistatic.toml --out $place/spheres >$place/log.txt
"$python" $gallery/spheres.py $place/spheres $gallery/small-fig5-curves.svg $data/tables/fig5-small-quasistatic.csv
made $gallery/theory-renormalised.svg $gallery/fig2-paths.svg $gallery/theory-sets.svg $gallery/fig5-gamma-force.svg $data/tables/fig5-gamma-force.csv \
    $gallery/fig2-works.svg \
    $gallery/small-fig5-curves.svg $data/tables/fig5-small-quasistatic.csv

"$python" docs/reference.py
"$python" docs/tables.py # those of all pages, from docs/data
made docs/reference/command-line.md

if [ -x "${ASPERITY_OTHERS:-}/bin/python3" ]; then
    ./asperity run scenes/first-contact.toml --set drive.path=relax surface.sites=96 \
        --progress off --out $place/maps >$place/log.txt
    ./asperity export $place/maps --to vtk >$place/log.txt
    "$ASPERITY_OTHERS/bin/python3" $gallery/maps.py $place/maps/export $gallery/maps.png
    made $gallery/maps.png
fi

echo
echo "Not made here: of older programs unless their numbers still agree. Date, commit, file:"
for file in $(git ls-files $gallery docs/data | grep -E '\.(svg|png|csv)$'); do
    case " $made " in *" $file "*) ;; *) echo "  $(git log -1 --format='%as %h' -- "$file") $file" ;; esac
done
echo "Numbers in the text of the gallery and of first-contact: compare with $place/first-contact.txt"

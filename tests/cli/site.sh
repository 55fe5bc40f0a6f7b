#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The pages are a site: Sphinx warns of nothing (links and their anchors, pages that no table of contents has,
# docstrings, files of tables and pictures), and the generated parts of the reference are in it. Links between all
# Markdown files lead somewhere.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

python=${ASPERITY_PYTHON:-/usr/bin/python3}
if ! "$python" -c 'import sphinx, myst_parser, furo, h5py'; then
    echo "Sphinx, MyST, furo or h5py is not installed: the site is not built"
    exit 77
fi
out=$(ASPERITY_PROGRAM=$asperity PYTHONDONTWRITEBYTECODE=1 "$python" -m sphinx -W --keep-going -q -b html -d doctrees \
    "$source/docs" site 2>&1) || fail "the site:
$out"
while IFS= read -r page; do
    [ -s "site/${page%.md}.html" ] || fail "no page of docs/$page"
done < <(cd "$source/docs" && find . -name '*.md')

has() { grep -q -- "$2" "site/reference/$1.html" || fail "reference/$1 lacks $2"; }
has command-line 'wall-limit'
has command-line 'id="sweep"'
has python 'id="asperity.load_sweep"'
has python 'id="asperity.Statics'
has cpp 'set_top_velocity'
has cpp 'id="statics"'
has scene 'lattice_ratio'
grep -q 'inside_' site/reference/cpp.html && fail "reference/cpp has what is private"

"$python" - "$source" <<'END' || fail "links between Markdown files"
import os, re, sys
source = sys.argv[1]
def headings(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    for title in re.findall(r"^#+ +(.*)", text, re.M):
        title = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title).replace("`", "")
        yield re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
links = wrong = 0
for folder, folders, files in os.walk(source):
    folders[:] = [f for f in folders if f not in ("results", "node_modules") and not f.startswith(("build", "."))]
    for name in (f for f in files if f.endswith(".md")):
        text = open(os.path.join(folder, name)).read()
        for target, anchor in re.findall(r"\]\((?!\w+:)([^)#\s]*)(?:#([^)]*))?\)", text):
            links += 1
            path = os.path.join(folder, target or name)
            if not os.path.exists(path) or anchor and anchor not in headings(open(path).read()):
                print(f"{os.path.join(folder, name)}: {target}#{anchor} leads nowhere", file=sys.stderr)
                wrong += 1
assert links > 100, links
sys.exit(wrong > 0)
END
finish

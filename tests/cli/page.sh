#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# The report in a browser: it opens without a word on the console, asks the network for nothing, answers the
# pointer, and is no wider than a phone.
# shellcheck source=tests/cli/common.sh
. "$(dirname "$0")/common.sh"

browser=$(command -v chromium || command -v chromium-browser)
if [ -z "$browser" ]; then
    echo "chromium is not installed: the page is not looked at"
    exit 77
fi
# chromium ARGUMENTS...: what it prints is left in $out, what it says in console.txt. Names lead nowhere.
chromium() {
    out=$(timeout 100 "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
        --disable-background-networking --disable-component-update --disable-sync --hide-scrollbars \
        --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --user-data-dir="$work/profile" \
        --virtual-time-budget=4000 "$@" 2>console.txt) || fail "chromium ended with $?: $(tail -n 3 console.txt)"
}

printf '[surface]\nsites = 32\nrms = 0.5\n[drive]\nvelocity = 100\ntimestep = 20\n' >small.toml
expect 0 run small.toml --progress off --out run
expect 0 report run
expect 0 sweep small.toml --theory-only --set surface.rms=0.2:1:0.2 --out sweep
expect 0 report sweep
printf '[surface]\nsites = 24\n[block]\nmodel = "spectral"\n[drive]\npath = ["zero-load"]\n' >state.toml
expect 0 sweep state.toml --set surface.rms=0.2,0.6 --progress off --out points
expect 0 report points

# A copy that moves the pointer to each plot's middle, and tells its parent how wide it has become, what the
# read-outs say, and what it has loaded.
cat >probe.html <<'END'
<script>
addEventListener('load', () => {
  let answers = 0;
  for (const svg of document.querySelectorAll('svg.plot')) {
    const box = svg.getBoundingClientRect();
    for (const f of [0.2, 0.4, 0.5, 0.6, 0.8]) for (const g of [0.2, 0.35, 0.5, 0.65, 0.8])
      if (!svg.nextElementSibling.textContent)
        svg.dispatchEvent(new PointerEvent('pointermove',
          {clientX: box.left + f * box.width, clientY: box.top + g * box.height}));
    if (/\(.*\d, .*\d\)/.test(svg.nextElementSibling.textContent)) ++answers;
  }
  const wide = [...document.querySelectorAll('main *')]
    .filter(e => !e.closest('.scroll, svg') && e.getBoundingClientRect().right > innerWidth + 0.5);
  const text = 'width ' + innerWidth + ' of ' + document.documentElement.scrollWidth + ', wide ' + wide.length + wide.slice(0, 1).map(e => ' ' + e.tagName + '.' + e.className).join('') +
    ', plots ' + document.querySelectorAll('svg.plot').length + ', answers ' + answers +
    ', loaded ' + performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length;
  parent.postMessage(text, '*');
});
</script>
END
for directory in run sweep points; do
    sed '/^<\/body>/e cat probe.html' $directory/report.html >$directory/probe.html
    for width in 360 1280; do
        cat >frame.html <<END
<!doctype html><title>none</title><script>addEventListener('message', e => document.title = e.data)</script>
<iframe src="$directory/probe.html" style="border:0;width:${width}px;height:900px"></iframe>
END
        chromium --dump-dom "file://$work/frame.html"
        title=$(grep -o '<title>[^<]*' <<<"$out" | head -n 1)
        plots=$(grep -o 'class="plot ink"' $directory/report.html | wc -l)
        [ "$title" = "<title>width $width of $width, wide 0, plots $plots, answers $plots, loaded 0" ] ||
            fail "$directory at $width: '$title', of $plots plots"
        grep CONSOLE console.txt && fail "$directory at $width says something on the console"
    done
    chromium --window-size=1280,1400 --screenshot="$work/$directory.png" "file://$work/$directory/report.html"
    [ "$(wc -c <$directory.png)" -gt 20000 ] || fail "$directory: the screenshot is empty"
    chromium --no-pdf-header-footer --print-to-pdf="$work/$directory.pdf" "file://$work/$directory/report.html"
    [ "$(head -c 5 $directory.pdf)" = "%PDF-" ] || fail "$directory cannot be printed"
done
# Readable without its script: all sections and plots stand in the document itself.
[ "$(sed '/<script>/,$d' run/report.html | grep -o '<svg' | wc -l)" = 13 ] || fail "plots need the script"
finish

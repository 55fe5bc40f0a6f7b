// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/html_page.hpp"

#include "io/markup.hpp"
#include "io/png.hpp"

#include <cctype>
#include <string_view>

#include <fmt/format.h>

namespace asperity::io {

namespace {

constexpr const char* style = R"css(
:root{color-scheme:light dark;--paper:#fdfcf9;--ink:#21262b;--soft:#636a70;--rule:#dcd9d1;
--tint:#f4f2ec;--accent:#0b5c8e;--grid:#e8e5de;--zero:#b5b2aa;--axis:#555b60;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#cc79a7;--c4:#e69f00;--c5:#56b4e9;--c6:#4d4d4d}
@media screen and (prefers-color-scheme:dark){:root{--paper:#15181b;--ink:#e4e1da;--soft:#9ba1a6;
--rule:#343a3f;--tint:#1c2024;--accent:#7cc0ea;--grid:#2a2f34;--zero:#596067;--axis:#9ba1a6;
--c0:#4aa8e0;--c1:#f08a3c;--c2:#36c49a;--c3:#e39cc3;--c4:#f0b93a;--c5:#8acbf2;--c6:#b5b5b5}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%;scroll-behavior:smooth}
body{margin:0;background:var(--paper);color:var(--ink);
font:17px/1.55 "Iowan Old Style","Palatino Linotype",Palatino,"URW Palladio L",P052,"Book Antiqua",
Georgia,"DejaVu Serif",serif;font-variant-numeric:lining-nums;overflow-wrap:break-word}
main{max-width:70rem;margin:0 auto;padding:3.2rem 1.6rem 4rem}
h1,h2,h3{font-weight:600;line-height:1.2;text-wrap:balance}
h1{font-size:2.3rem;margin:.2rem 0 .6rem;letter-spacing:-.01em}
h2{font-size:1.4rem;margin:3.2rem 0 1rem;padding-top:1.1rem;border-top:1px solid var(--rule)}
h3{font-size:1rem;margin:0 0 .4rem}
p{max-width:42rem;margin:0 0 1rem}
.kicker,nav,.numbers,table,figcaption,output,.bars,.notice h3{font-family:system-ui,-apple-system,
"Segoe UI",Roboto,"Helvetica Neue",Arial,"DejaVu Sans",sans-serif}
.kicker{color:var(--soft);font-size:.8rem;letter-spacing:.08em;text-transform:uppercase;margin:0}
.lead{font-size:1.12rem;color:var(--soft);max-width:46rem}
nav{font-size:.85rem;display:flex;flex-wrap:wrap;gap:.2rem 1.3rem;margin:1.6rem 0 0}
nav a{color:var(--accent);text-decoration:none;padding:.15rem 0}
nav a:hover,nav a:focus-visible{text-decoration:underline}
.numbers{display:grid;grid-template-columns:repeat(auto-fill,minmax(11.5rem,1fr));
gap:1.6rem 2rem;margin:2.2rem 0 2rem}
.numbers div{border-top:2px solid var(--ink);padding:.5rem 0 0}
.numbers b{display:block;font-size:1.75rem;font-weight:500;line-height:1.25;
font-variant-numeric:tabular-nums}
.numbers b small{font-size:.9rem;font-weight:400;color:var(--soft);margin-left:.3em}
.numbers span{display:block;font-size:.86rem;line-height:1.35}
.numbers .note{color:var(--soft);font-size:.79rem;margin-top:.15rem}
.columns{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,20rem),1fr));
gap:1.2rem 3rem}
.columns ul{margin:0 0 1rem;padding-left:1.1rem}
.columns li{margin:.2rem 0}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,28rem),1fr));
gap:2rem 2.4rem;align-items:start}
figure{margin:0;min-width:0;position:relative}
svg image{image-rendering:pixelated}
figure svg{display:block;width:100%;height:auto;touch-action:pan-y}
figcaption{font-size:.86rem;line-height:1.45;color:var(--soft);max-width:36rem;margin-top:.3rem}
figcaption i{font-style:normal;font-size:.79rem;opacity:.85}
output{display:block;min-height:1.3em;font-size:.82rem;font-variant-numeric:tabular-nums;
color:var(--accent);padding-left:.9rem}
.scroll{overflow-x:auto;margin:0 0 1.4rem}
table{border-collapse:collapse;font-size:.88rem;font-variant-numeric:tabular-nums}
th,td{padding:.3rem 1.4rem .3rem 0;text-align:right;border-bottom:1px solid var(--rule);
vertical-align:top;white-space:nowrap}
th{font-weight:600;color:var(--soft)}
th:first-child,td:first-child{text-align:left;white-space:normal}
table.words{width:100%}
table.words td:last-child{text-align:left;white-space:normal;overflow-wrap:anywhere;width:75%}
.thumbs{display:grid;grid-template-columns:repeat(auto-fill,minmax(8.5rem,1fr));gap:1.2rem;
margin:0 0 1.4rem}
.thumbs img{display:block;width:100%;image-rendering:pixelated;border:1px solid var(--rule)}
td a,.thumbs a{color:var(--accent);text-decoration:none}
td a:hover,.thumbs a:hover{text-decoration:underline}
.bars{display:grid;grid-template-columns:max-content 1fr max-content;gap:.35rem 1rem;
font-size:.86rem;max-width:46rem;align-items:center;font-variant-numeric:tabular-nums}
.bars i{display:block;height:.7rem;background:var(--c0);min-width:1px}
.bars em{font-style:normal;color:var(--soft);text-align:right}
.notice{border-left:4px solid var(--c1);background:var(--tint);padding:.9rem 1.2rem;
margin:1.6rem 0;max-width:46rem}
.notice p{white-space:pre-line;margin:0}
.notice h3{font-size:.95rem}
pre{font:.8rem/1.5 ui-monospace,"SF Mono",Menlo,Consolas,"DejaVu Sans Mono",monospace;
background:var(--tint);padding:1.1rem 1.3rem;columns:24rem;column-gap:2.4rem;white-space:pre-wrap;
overflow-wrap:anywhere;margin:0 0 1rem}
sub{font-size:.75em;line-height:0}
.paper,.legend{fill:var(--paper)}.legend{stroke:var(--rule)}.ink{fill:var(--ink)}
.grid{stroke:var(--grid)}.zero{stroke:var(--zero)}.axis{stroke:var(--axis)}
.c0{stroke:var(--c0)}.c1{stroke:var(--c1)}.c2{stroke:var(--c2)}.c3{stroke:var(--c3)}
.c4{stroke:var(--c4)}.c5{stroke:var(--c5)}.c6{stroke:var(--c6)}
.f0{fill:var(--c0)}.f1{fill:var(--c1)}.f2{fill:var(--c2)}.f3{fill:var(--c3)}.f4{fill:var(--c4)}
.f5{fill:var(--c5)}.f6{fill:var(--c6)}circle{stroke:var(--paper)}
.cursor{fill:none;stroke:var(--ink);stroke-width:1.5}
@media screen and (max-width:40rem){body{font-size:16px}main{padding:1.6rem 1rem 3rem}
h1{font-size:1.75rem}svg.plot text,svg.map text{font-size:15px}
.numbers{grid-template-columns:1fr 1fr;gap:1.2rem 1.2rem}
.numbers b{font-size:1.35rem}th,td{padding-right:.9rem}}
@media print{@page{margin:16mm 15mm}html{font-size:11.5px}
body{font-size:10.5pt;background:#fff;--paper:#fff}main{padding:0;max-width:none}
nav,output{display:none}h2{break-after:avoid;margin-top:1.8rem}
figure,.numbers,.bars,tr,.notice{break-inside:avoid}.thumbs{grid-template-columns:repeat(6,1fr)}.figures{grid-template-columns:1fr 1fr;
gap:1.4rem 1.6rem}.numbers{grid-template-columns:repeat(3,1fr)}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}a{color:inherit}}
)css";

// The read-out: the point of a curve that is nearest to the pointer, its values from the axes.
constexpr const char* script = R"js(
for (const svg of document.querySelectorAll('svg.plot')) {
  const [left, top, right, bottom] = svg.dataset.frame.split(' ').map(Number);
  const axis = (text, from, to) => {
    const [low, high, kind] = text.split(' ');
    return p => {
      const f = (p - from) / (to - from);
      return kind === 'log' ? low * (high / low) ** f : +low + f * (high - low);
    };
  };
  const x = axis(svg.dataset.x, left, right), y = axis(svg.dataset.y, bottom, top);
  const points = [];
  for (const e of svg.querySelectorAll('[data-label]')) {
    const name = e.dataset.label;
    if (e.tagName === 'circle') points.push([+e.getAttribute('cx'), +e.getAttribute('cy'), name]);
    else for (const m of e.getAttribute('d').matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g))
      points.push([+m[1], +m[2], name]);
  }
  const line = document.createElement('output');
  svg.after(line);
  const ring = document.createElementNS('http://www.w3.org/2000/svg', 'circle');
  ring.setAttribute('class', 'cursor');
  ring.setAttribute('r', 5);
  const show = event => {
    const at = new DOMPoint(event.clientX, event.clientY)
      .matrixTransform(svg.getScreenCTM().inverse());
    let best = null, least = 60 ** 2;
    for (const p of points) {
      if (p[0] < left - 1 || p[0] > right + 1 || p[1] < top - 1 || p[1] > bottom + 1) continue;
      const d = (p[0] - at.x) ** 2 + (p[1] - at.y) ** 2;
      if (d < least) { least = d; best = p; }
    }
    if (!best) { ring.remove(); line.textContent = ''; return; }
    ring.setAttribute('cx', best[0]);
    ring.setAttribute('cy', best[1]);
    svg.append(ring);
    const number = v => String(+v.toPrecision(4)).replace('-', '\u2212');
    line.textContent = (best[2] ? best[2] + ': ' : '') +
      '(' + number(x(best[0])) + ', ' + number(y(best[1])) + ')';
  };
  svg.addEventListener('pointermove', show);
  svg.addEventListener('pointerdown', show);
  svg.addEventListener('pointerleave', () => { ring.remove(); line.textContent = ''; });
}
)js";

/// Escaped, with its subscripts.
std::string set(const std::string& text) {
    std::string out = escape_markup(text);
    for (std::size_t open = 0; (open = out.find("_{", open)) != std::string::npos;) {
        const std::size_t close = out.find('}', open);
        if (close == std::string::npos) break;
        out.replace(close, 1, "</sub>");
        out.replace(open, 2, "<sub>");
    }
    // A unit stays with its number, and in one piece.
    for (std::size_t at = 0; (at = out.find(" meV/Å", at)) != std::string::npos; at += 12)
        out.replace(at, 5, "&nbsp;meV/&#8288;");
    return out;
}

/// A path as an address: what is neither letter nor digit in percents.
std::string linked(const std::string& path, const std::string& markup) {
    if (path.empty()) return markup;
    std::string address;
    for (const char c : path)
        if (std::isalnum(static_cast<unsigned char>(c)) ||
            std::string_view("/._-=,").find(c) != std::string_view::npos)
            address += c;
        else
            address += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return fmt::format("<a href=\"{}\">{}</a>", address, markup);
}

} // namespace

HtmlPage::HtmlPage(const std::string& kicker, const std::string& title, const std::string& lead)
    : kicker_(kicker), title_(title), lead_(lead) {}

void HtmlPage::section(const std::string& id, const std::string& heading) {
    contents_.push_back({id, heading});
    body_ += fmt::format("<h2 id=\"{}\">{}</h2>\n", id, set(heading));
}

void HtmlPage::paragraph(const std::string& text) {
    body_ += fmt::format("<p>{}</p>\n", set(text));
}

void HtmlPage::notice(const std::string& heading, const std::string& text) {
    body_ += fmt::format("<div class=\"notice\"><h3>{}</h3><p>{}</p></div>\n", set(heading),
                         escape_markup(text));
}

void HtmlPage::key_numbers(const std::vector<KeyNumber>& numbers) {
    body_ += "<div class=\"numbers\">\n";
    for (const KeyNumber& n : numbers) {
        body_ += fmt::format("<div><b>{}", set(n.value));
        if (!n.unit.empty()) body_ += fmt::format("<small>{}</small>", set(n.unit));
        body_ += fmt::format("</b><span>{}</span><span class=\"note\">{}</span></div>\n",
                             set(n.name), set(n.note));
    }
    body_ += "</div>\n";
}

void HtmlPage::list(const std::string& heading, const std::vector<std::string>& items) {
    body_ += fmt::format("<div><h3>{}</h3>\n<ul>\n", set(heading));
    for (const std::string& item : items)
        body_ += fmt::format("<li>{}</li>\n", set(item));
    body_ += "</ul></div>\n";
}

void HtmlPage::figure(const std::string& svg, const std::string& caption,
                      const std::string& files) {
    body_ += fmt::format("<figure>{}<figcaption>{}{}</figcaption></figure>\n", svg, set(caption),
                         files.empty() ? "" : fmt::format(" <i>[{}]</i>", escape_markup(files)));
}

void HtmlPage::table(const std::vector<std::string>& heads,
                     const std::vector<std::vector<std::string>>& rows,
                     const std::vector<std::string>& links) {
    // A table without headings is one of names and words.
    body_ +=
        fmt::format("<div class=\"scroll\"><table{}>\n", heads.empty() ? " class=\"words\"" : "");
    const auto line = [&](const std::vector<std::string>& cells, const char* tag,
                          const std::string& link) {
        body_ += "<tr>";
        for (const std::string& cell : cells)
            body_ += fmt::format("<{0}>{1}</{0}>", tag,
                                 &cell == &cells.front() ? linked(link, set(cell)) : set(cell));
        body_ += "</tr>\n";
    };
    if (!heads.empty()) line(heads, "th", "");
    for (std::size_t i = 0; i < rows.size(); ++i)
        line(rows[i], "td", i < links.size() ? links[i] : "");
    body_ += "</table></div>\n";
}

void HtmlPage::thumbnails(const std::vector<Thumbnail>& list) {
    body_ += "<div class=\"thumbs\">\n";
    for (const Thumbnail& t : list)
        body_ +=
            fmt::format("<figure>{}</figure>\n",
                        linked(t.link, fmt::format("<img src=\"data:image/png;base64,{}\" alt=\"\">"
                                                   "<figcaption>{}</figcaption>",
                                                   base64(t.png), set(t.caption))));
    body_ += "</div>\n";
}

void HtmlPage::bars(const std::vector<Bar>& bars) {
    body_ += "<div class=\"bars\">\n";
    for (const Bar& bar : bars)
        body_ += fmt::format("<span>{}</span><i style=\"width:{:.1f}%\"></i><em>{}</em>\n",
                             set(bar.name), 100.0 * bar.share, set(bar.text));
    body_ += "</div>\n";
}

void HtmlPage::preformatted(const std::string& text) {
    body_ += fmt::format("<pre>{}</pre>\n", escape_markup(text));
}

std::string HtmlPage::text() const {
    std::string contents;
    for (const Entry& entry : contents_)
        contents += fmt::format("<a href=\"#{}\">{}</a>\n", entry.id, set(entry.heading));
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
        "<title>{}</title>\n<link rel=\"icon\" href=\"data:,\">\n"
        "<style>{}</style>\n</head>\n<body>\n<main>\n"
        "<header><p class=\"kicker\">{}</p>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n"
        "<nav>\n{}</nav></header>\n{}</main>\n<script>{}</script>\n</body>\n</html>\n",
        escape_markup(title_ + " · " + kicker_), style, set(kicker_), set(title_), set(lead_),
        contents, body_, script);
}

} // namespace asperity::io

# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The pages as a site:

    cmake --build build/release --target docs           # the site is build/release/site/index.html
    sphinx-build -W -b html docs build/docs             # the same with the program that is built already

Needs python3-sphinx, python3-myst-parser and furo of Debian; with libjs-katex formulas need no network. Pages are
Markdown that reads the same elsewhere. The lists of docs/index.md become the navigation of the site.
"""

import re
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "docs"))
from reference import python  # noqa: E402

project = "Asperity"
author = "The Asperity authors"
project_copyright = "2026 " + author
version = re.search(r"project\(\w+\s+VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
smartquotes = False  # options keep their dashes, examples their quotes
highlight_language = "none"
html_theme = "furo"
html_title = f"Asperity {version}"
html_static_path = ["site.css"]
html_css_files = ["site.css"]
katex = Path("/usr/share/javascript/katex")
if (katex / "contrib/auto-render.js").is_file():  # formulas without a network; otherwise MathJax comes from its server
    html_static_path.append(str(katex))
    html_css_files.append("katex.min.css")
    mathjax_path, mathjax_options = "katex.min.js", {"defer": "defer"}
    html_js_files = [("contrib/auto-render.js", {"defer": "defer", "onload": "renderMathInElement(document.body)"})]


def complete(app, page, source):
    """A page before it is parsed: of a link to a Markdown file that is no page of the site the file's name is left.
    The front page's lists of links are tables of contents, too. The page of the Python interface has what its docstrings say."""
    if page == "reference/python":
        source[0] += python()
    up = re.escape("../" * (page.count("/") + 1))
    source[0] = re.sub(rf"\[[^\]]+\]\({up}([^)#]+\.md)(?:#[^)]*)?\)", r"`\1`", source[0])
    if page == "index":
        for caption, items in re.findall(r"^## (.*)\n\n((?:(?:-|\d+\.) .*\n)+)", source[0], re.M):
            names = "\n".join(re.findall(r"\]\(([^)]*)\.md\)", items))
            source[0] += f"\n```{{toctree}}\n:caption: {caption}\n:maxdepth: 1\n:hidden:\n\n{names}\n```\n"


def whole_words(app, page, template, context, doctree):
    """Commands, which the style sheet wraps, break at blanks alone, not behind the dashes of an option."""
    command = r'(?<=<div class="highlight-none notranslate"><div class="highlight"><pre>).*?(?=</pre>)'
    context["body"] = re.sub(command, lambda text: re.sub(r"\S+", r'<span class="pre">\g<0></span>', text[0]),
                             context.get("body", ""), flags=re.S)


def setup(app):
    app.connect("source-read", complete)
    app.connect("env-get-outdated", lambda *_: ["reference/python"])  # the docstrings are other files
    app.connect("html-page-context", whole_words)

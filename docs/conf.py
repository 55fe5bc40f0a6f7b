# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The pages as a site:

    cmake --build build/release --target docs           # the site is build/release/site/index.html
    sphinx-build -W -b html docs build/docs             # the same with the program that is built already

Needs python3-sphinx, python3-myst-parser and furo of Debian; with libjs-katex formulas need no network. Pages are
Markdown that reads the same elsewhere; two of the reference are completed here: the commands by what the program
prints, the C++ interface by its header. The program is that of $ASPERITY_PROGRAM or the build of this source tree.
"""

import os
import re
import sys
import types
from pathlib import Path

from sphinx.errors import ConfigError

root = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(root / "python"), str(root / "packaging")]

from generate import commands_of, say  # noqa: E402

project = "Asperity"
author = "The Asperity authors"
project_copyright = "2026 " + author
version = re.search(r"project\(\w+\s+VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
smartquotes = False  # options keep their dashes, examples their quotes
default_role = "code"  # of docstrings
suppress_warnings = ["myst.header"]  # a page that is completed here may begin its second part below "#"
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
autodoc_member_order = "bysource"
autodoc_typehints = "signature"

try:
    import asperity.engine  # noqa: E402, F401
except ImportError:  # a build without pybind11: what is compiled is missing from the page
    names = ("Simulation", "Statics", "RestState", "SiteMaps", "Energies", "Point")
    sys.modules["asperity._engine"] = types.SimpleNamespace(**{name: type(name, (), {}) for name in names})


def commands() -> str:
    """The help of every command of the program, and of the two that only the script has."""
    found = os.environ.get("ASPERITY_PROGRAM") or str(root / "build/release/engine/asperity")
    if not os.access(found, os.X_OK):
        raise ConfigError(f"there is no program {found}: build it (./asperity info), or set ASPERITY_PROGRAM")
    general = say(found, "--help")
    pages = [(name, say(found, name, "--help")) for name, _ in commands_of(general)]
    return "".join(f"\n## {title}\n\n```text\n{text.strip()}\n```\n" for title, text in [("asperity", general), *pages])


def header() -> str:
    """The header of libasperity: a part for each class and function, its comment as text, its declarations as code."""
    lines = (root / "library/asperity.hpp").read_text().split("namespace libasperity {\n")[1].splitlines()
    out, comment, code = [], [], []
    for line in lines:
        if line.startswith("///"):
            comment.append(line[4:])
        elif code or re.match("class|struct|LIBASPERITY_API", line):
            code.append(line.replace("LIBASPERITY_API ", ""))
            if line != "};" and ("{" in code[0] or not line.endswith(";")):
                continue  # a class ends with its brace, a function with its semicolon
            name = re.match(r"(?:class|struct) (\w+)", code[0]) or re.search(r"(\w+)\(", code[0])
            public = re.sub(r"\nprivate:\n.*(?=\n};)", "", "\n".join(code), flags=re.S)
            public = re.sub(r"\n *(class Inside;|const Inside& inside.*)(?=\n)", "", public)
            public = re.sub(r"\n+(?=\n};)", "", public)
            example = "\n".join(text for text in comment if text.startswith("    "))
            out += [f"\n## {name[1]}\n\n", "\n".join(text for text in comment if not text.startswith("    "))]
            out += [f"\n\n```cpp\n{text}\n```\n" for text in (example, public) if text]
            comment, code = [], []
    return "".join(out)


def complete(app, page, source):
    """A page before it is parsed: of a link to a Markdown file that is no page of the site the file's name is left;
    what is generated comes behind the text of its page."""
    up = re.escape("../" * (page.count("/") + 1))
    source[0] = re.sub(rf"\[[^\]]+\]\({up}([^)#]+\.md)(?:#[^)]*)?\)", r"`\1`", source[0])
    made = {"reference/command-line": commands, "reference/cpp": header}.get(page)
    if made:
        source[0] += made()


def whole_words(app, page, template, context, doctree):
    """Commands, which the style sheet wraps, break at blanks alone, not behind the dashes of an option."""
    command = r'(?<=<div class="highlight-none notranslate"><div class="highlight"><pre>).*?(?=</pre>)'
    context["body"] = re.sub(command, lambda text: re.sub(r"\S+", r'<span class="pre">\g<0></span>', text[0]),
                             context.get("body", ""), flags=re.S)


def docstring(app, what, name, thing, options, lines):
    """Our docstrings are plain text: examples are indented, lists of arguments have two blanks behind the name."""
    out = []
    for part in "\n".join(lines).strip("\n").split("\n\n"):
        literal = re.match(r" {4}|\w+ {2,}\S", part)
        out += ["::", "", *("    " + line for line in part.split("\n")), ""] if literal else [*part.split("\n"), ""]
    lines[:] = out


def setup(app):
    app.connect("source-read", complete)
    app.connect("html-page-context", whole_words)
    app.connect("autodoc-process-docstring", docstring)

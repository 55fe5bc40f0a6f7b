#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""version.py [NEW]: prints the version of CMakeLists.txt, which all programs and packages take, and writes it, or NEW, into the files
that have to name it themselves. version.py --check only says which of these name another one (exit code 1)."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
HOME = ("CMakeLists.txt", r"(?m)(^project\(asperity VERSION )([\d.]+)")
COPIES = (("CITATION.cff", r"(?m)(^version: )([\d.]+)"), ("packaging/conda/recipe.yaml", r'(?m)(^  version: ")([\d.]+)'),
          ("packaging/spack/package.py", r'(?m)(^    version\(")([\d.]+)'),
          ("packaging/spack/package.py", r"(dev-build asperity@)([\d.]+)"), ("packaging/asperity.def", r"(asperity_)([\d.]+)(?=_)"))


def main(words):
    home = (ROOT / HOME[0]).read_text()
    version = re.search(HOME[1], home)[2]
    if words and words != ["--check"]:
        version = words[0]
        if not re.fullmatch(r"\d+\.\d+\.\d+", version):
            raise SystemExit(f"version.py: {version} is no version: MAJOR.MINOR.PATCH")
        (ROOT / HOME[0]).write_text(re.sub(HOME[1], rf"\g<1>{version}", home))
    wrong = []
    for name, pattern in COPIES:
        text = (ROOT / name).read_text()
        found = re.search(pattern, text)
        if not found:
            raise SystemExit(f"version.py: {name} names no version")
        if found[2] != version:
            wrong.append(f"{name} has {found[2]}")
            if words != ["--check"]:
                (ROOT / name).write_text(re.sub(pattern, rf"\g<1>{version}", text))
    print(version)
    if wrong and words == ["--check"]:
        raise SystemExit(f"version.py: {', '.join(wrong)}; python3 packaging/version.py writes {version} there")


if __name__ == "__main__":
    main(sys.argv[1:])

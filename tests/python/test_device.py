# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A run that changes between processor and device at its checkpoints, as a user would change it: every number of its
result is that of a run that never changed."""

import re

from conftest import ROOT, command, found


def contact(out, *sets, more=(), **keys):
    command("run", ROOT / "scenes/first-contact.toml", "--progress", "off", "--out", out, *more, "--set",
            "surface.sites=16", "block.thickness=16", "drive.velocity=40", "output.trajectory=none", *sets, **keys)


def test_a_run_changes_between_processor_and_device(place):
    if re.search("kernels for (portable|v2)", command("info")):
        contact("refused", "numerics.device=emulated", expect=2, says="do not")
        return
    contact("whole")
    contact("changed", "numerics.device=emulated", "drive.max_steps=700", says="Stopped early")
    contact("changed", "numerics.device=none", "drive.max_steps=1200", more=["--resume", "auto"])
    contact("changed", "numerics.device=emulated", more=["--resume", "auto"], says="emulated")
    assert found("whole") == found("changed") and len(found("whole")) > 9

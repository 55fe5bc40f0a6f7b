# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What a run leaves that another one of the same scene must leave to the bit."""
import json
import os


def outcome(out):
    """Bytes of run.h5, result.json without its digest, times and machine, and what it holds of these ("run")."""
    with open(os.path.join(out, "run.h5"), "rb") as file:
        data = file.read()
    with open(os.path.join(out, "result.json")) as file:
        result = json.load(file)
    del result["digest"]  # of the whole file, with its times
    result["units"].pop("run")  # of the phases that there were
    return data, result, result.pop("run")

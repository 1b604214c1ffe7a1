# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run left: digests of results, whether an error is told as it should be, what lies about."""
import hashlib
import os
import re

import programs

MESSAGE = re.compile(r"^error\[[A-Z]\d\d\] .+\n(?:.*\n)*?hint: .+", re.M)
CRASHED = "it crashed; this is a bug"


def digest(path):
    """Of a file's bytes; None without it. The page holds the times of the stages, in a line of their own."""
    try:
        with open(path, "rb") as file:
            content = file.read()
    except FileNotFoundError:
        return None
    if os.path.basename(path) == programs.REPORT:
        content = b"\n".join(line for line in content.split(b"\n") if b'id="block-logs"' not in line)
    return hashlib.sha256(content).hexdigest()


def digests(folder, names):
    return {name: digest(os.path.join(folder, name)) for name in names}


def left_overs(folder):
    """Files that a writer had not finished."""
    return sorted(os.path.join(home, name) for home, _, names in os.walk(folder) for name in names
                  if name.endswith((".tmp", ".new")))

# SPDX-License-Identifier: GPL-3.0-or-later
"""A program under limits: address space, time, size of what it writes; and what it did with them."""
import os
import resource
import select
import signal
import subprocess
import time
from dataclasses import dataclass

ADDRESS_SPACE = 8 << 30  # bytes
SECONDS = 12  # of waiting, or of computing on a machine that others use too
FILE_SIZE = 1 << 30  # bytes


@dataclass
class Ending:
    code: int  # negative: the signal that ended it
    hung: bool
    peak: int  # resident bytes
    out: str
    error: str


def set_limits():
    """Of this process, and so of those that it starts: quicker than a limit on each."""
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, resource.getrlimit(resource.RLIMIT_AS)[1]))
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_SIZE, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def computed(process):
    """Seconds of processor time so far."""
    with open(f"/proc/{process}/stat", encoding="utf-8", errors="replace") as file:
        words = file.read().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def run(command, folder, scratch, environment=None, seconds=SECONDS):
    """Runs `command` in `folder`; what it prints goes through files in `scratch`, so that no amount of it fills our memory."""
    names = [os.path.join(scratch, "stdout"), os.path.join(scratch, "stderr")]
    with open(names[0], "wb") as out, open(names[1], "wb") as error:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=error, env=environment)
    waiting = select.poll()
    handle = os.pidfd_open(process.pid)
    waiting.register(handle, select.POLLIN)
    begun = time.monotonic()
    hung = not waiting.poll(1000 * seconds)
    while hung and computed(process.pid) < seconds and time.monotonic() - begun < 10 * seconds:
        hung = not waiting.poll(1000)
    os.close(handle)
    if hung:
        process.send_signal(signal.SIGKILL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)  # so that Popen does not wait for it once more
    texts = []
    for name in names:
        with open(name, "rb") as file:
            texts.append(file.read(1 << 20).decode("utf-8", "replace"))
    return Ending(process.returncode, hung, usage.ru_maxrss << 10, *texts)

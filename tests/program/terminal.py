"""Follows what a program tells on a terminal."""
import os
import pty
import signal
import subprocess


def interrupted(command, place, *awaited):
    """Runs a command whose stderr is a terminal and sends SIGINT once all of `awaited` have been said.

    Returns all that was said, as bytes, and the exit code."""
    ours, its = pty.openpty()
    process = subprocess.Popen(command, cwd=place, stdout=subprocess.DEVNULL, stderr=its)
    os.close(its)
    said = b""
    try:
        while not all(text in said for text in awaited):
            said += os.read(ours, 4096)
        process.send_signal(signal.SIGINT)
    finally:
        if not said:
            process.kill()
    try:
        while more := os.read(ours, 4096):
            said += more
    except OSError:  # the other end is closed
        pass
    return said, process.wait()

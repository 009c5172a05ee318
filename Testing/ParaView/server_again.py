#!/usr/bin/env python3
"""Runs a client three times against the same parallel server, which has to end by itself when the last one has left.

    server_again.py PVPYTHON CLIENT.py SERVER-COMMAND...

"{port}" in the server's command becomes a free port. A server ends with its last client, so one more is connected all the time: the server
has --multi-clients. Whatever waits for ever is stopped after a minute and a half, and what remains is killed.
"""

import os
import signal
import subprocess
import sys
import threading

from with_server import free_port

SECONDS = 90
WAITING = """
import sys
import paraview.simple as simple
simple.Connect("127.0.0.1", {port})
print("connected", flush=True)
sys.stdin.readline()
simple.Disconnect()
"""


def start(command, **streams):
    """A process that takes those that it starts along, when it is killed."""
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True, **streams)


def kill(process):
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass  # it has ended


def wait_for(process, words):
    """Reads what the process prints up to a line with these words."""
    for line in process.stdout:
        print(line, end="", flush=True)
        if words in line:
            return
    raise RuntimeError(f"{process.args[0]} ended before it said {words!r}")


def use(server, pvpython, client, port):
    wait_for(server, "Accepting connection")
    printing = threading.Thread(target=lambda: print("server:", server.stdout.read()))  # so that it never waits to print
    printing.start()
    holder = start([pvpython, "-c", WAITING.format(port=port)], stdin=subprocess.PIPE)
    guards = [threading.Timer(4 * SECONDS, kill, [each]) for each in (holder, server)]
    for guard in guards:
        guard.start()
    try:
        wait_for(holder, "connected")
        for _ in range(3):
            subprocess.run([pvpython, client, f"127.0.0.1:{port}"], check=True, timeout=SECONDS)
        holder.communicate("leave\n", timeout=SECONDS)
        code = server.wait(timeout=SECONDS)
    finally:
        for guard in guards:
            guard.cancel()
        kill(holder)
        kill(server)
        printing.join(timeout=SECONDS)
    print(f"the server has ended with {code}")
    return code


def main():
    pvpython, client, *server_command = sys.argv[1:]
    port = free_port()
    server = start([word.replace("{port}", str(port)) for word in server_command], stderr=subprocess.STDOUT)
    try:
        return use(server, pvpython, client, port)
    finally:
        kill(server)


if __name__ == "__main__":
    sys.exit(main())

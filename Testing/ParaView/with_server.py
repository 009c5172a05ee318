#!/usr/bin/env python3
"""Runs a client against a pvserver that lives as long as the client.

    with_server.py SERVER-COMMAND... -- CLIENT-COMMAND...

"{port}" in both commands becomes a free port. Fails as the client fails.
"""

import socket
import subprocess
import sys


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))  # a bare Debian may have no /etc/hosts
        return probe.getsockname()[1]


def main():
    split = sys.argv.index("--")
    port = str(free_port())
    server_command = [word.replace("{port}", port) for word in sys.argv[1:split]]
    client_command = [word.replace("{port}", port) for word in sys.argv[split + 1:]]

    server = subprocess.Popen(server_command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True)
    try:
        for line in server.stdout:
            print("server:", line, end="", flush=True)
            if "Accepting connection" in line:
                break
        else:
            print("the server ended before it accepted a connection")
            return 1
        result = subprocess.run(client_command).returncode
    finally:
        server.terminate()
        try:
            output, _ = server.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            server.kill()
            output, _ = server.communicate()
    print("server:", output)
    return result


if __name__ == "__main__":
    sys.exit(main())

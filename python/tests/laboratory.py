"""A real JupyterLab, used in a real browser."""

from __future__ import annotations

import contextlib
import json
import os
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import nbformat
from jupyter_client.blocking.client import BlockingKernelClient
from playwright.sync_api import Page, sync_playwright

CHROMIUM = os.environ.get("CHROMIUM", "/usr/bin/chromium")

PATIENCE = 300.0
"""How long the slowest machine may take for an action [s]: it draws in software."""

SWITCHES = [
    # What a browser would request from the network by itself.
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-domain-reliability",
    "--disable-sync",
    "--metrics-recording-only",
    "--no-first-run",
    "--no-pings",
    # It draws without a graphics card.
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
]


def until(is_so: Callable[[], object], what: str, patience: float = PATIENCE) -> None:
    """Waits until something is so."""
    end = time.monotonic() + patience
    while not is_so():
        assert time.monotonic() < end, f"{what}: not within {patience} s"
        time.sleep(0.1)


class Laboratory:
    """A notebook in JupyterLab in Chromium, and the kernel that runs it."""

    def __init__(self, page: Page, kernel: BlockingKernelClient) -> None:
        self.page, self.kernel = page, kernel
        self.complaints: list[str] = []
        self.requests: list[str] = []

    def python(self, expression: str) -> Any:
        """What an expression is in the kernel, by way of JSON."""
        wanted = {"it": f"__import__('json').dumps({expression})"}
        reply = self.kernel.execute_interactive("", user_expressions=wanted, timeout=PATIENCE)
        answer = reply["content"]["user_expressions"]["it"]
        assert answer["status"] == "ok", answer
        return json.loads(eval(answer["data"]["text/plain"]))

    def run(self, code: str) -> None:
        """Runs statements in the kernel."""
        reply = self.kernel.execute_interactive(code, timeout=PATIENCE)
        assert reply["content"]["status"] == "ok", reply["content"]

    def run_cells(self) -> None:
        """Runs all cells of the notebook."""
        self.page.evaluate("jupyterapp.commands.execute('notebook:run-all-cells')")


@contextlib.contextmanager
def laboratory(cells: Sequence[str], folder: Path) -> Iterator[Laboratory]:
    """Opens a notebook with these cells."""
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_code_cell(cell) for cell in cells],
        metadata={"kernelspec": {"name": "python3", "display_name": "Python 3"}},
    )
    work = folder / "work"
    work.mkdir()
    nbformat.write(notebook, work / "test.ipynb")
    with served(work, folder) as (url, runtime), sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM,
            args=SWITCHES,
            timeout=1000 * PATIENCE,
            # Without it Chromium starts for root under no circumstances.
            chromium_sandbox=os.getuid() != 0,
        )
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        page.set_default_timeout(1000 * PATIENCE)
        lab = Laboratory(page, BlockingKernelClient())
        page.on("request", lambda request: lab.requests.append(request.url))
        page.on("pageerror", lambda error: lab.complaints.append(str(error)))
        page.on(
            "console",
            lambda it: lab.complaints.append(it.text) if it.type == "error" else None,
        )
        page.goto(f"{url}lab/tree/test.ipynb")
        page.wait_for_selector(".jp-Notebook .jp-Cell")
        until(lambda: kernel_ids(url), "a kernel")
        page.wait_for_function(
            "jupyterapp.shell.currentWidget?.sessionContext?.session?.kernel?.status === 'idle'"
        )
        [kernel_id] = kernel_ids(url)
        lab.kernel.load_connection_file(str(runtime / f"kernel-{kernel_id}.json"))
        lab.kernel.start_channels()
        try:
            yield lab
        finally:
            lab.kernel.stop_channels()
            browser.close()


def kernel_ids(url: str) -> list[str]:
    """The kernels that run; none while one is about to, when the server cannot list them."""
    try:
        with urllib.request.urlopen(f"{url}api/kernels") as answer:
            return [kernel["id"] for kernel in json.load(answer)]
    except urllib.error.HTTPError as error:
        if error.code != 500:
            raise
        return []


@contextlib.contextmanager
def served(work: Path, folder: Path) -> Iterator[tuple[str, Path]]:
    """JupyterLab on a folder: its address, and the folder of its kernels' connections."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    url = f"http://127.0.0.1:{port}/"
    runtime = folder / "runtime"
    own = {
        "JUPYTER_RUNTIME_DIR": str(runtime),
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_DATA_DIR": str(folder / "data"),
        "JUPYTERLAB_SETTINGS_DIR": str(folder / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(folder / "workspaces"),
        "IPYTHONDIR": str(folder / "ipython"),
    }
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", f"--port={port}"]
    command += ["--ip=127.0.0.1", "--IdentityProvider.token=", "--expose-app-in-browser"]
    command += ["--allow-root", f"--ServerApp.root_dir={work}", "--ServerApp.port_retries=0"]
    # It looks for news and extensions on the network by itself.
    command += ["--LabApp.news_url=", "--LabApp.extension_manager=readonly"]
    with open(folder / "server.log", "wb") as log:
        server = subprocess.Popen(
            command, env={**os.environ, **own}, stdout=log, stderr=subprocess.STDOUT
        )
    try:
        until(lambda: answers(url) or server.poll() is not None, "the server")
        assert server.poll() is None, (folder / "server.log").read_text(encoding="utf-8")
        yield url, runtime
    finally:
        server.terminate()
        server.wait(PATIENCE)


def answers(url: str) -> bool:
    try:
        with urllib.request.urlopen(f"{url}api"):
            return True
    except OSError:
        return False

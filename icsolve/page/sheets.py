"""The page's script and style sheets, and the policy that lets nothing else run or load."""

from __future__ import annotations

import base64
import hashlib
from functools import cache
from pathlib import Path

HERE = Path(__file__).parent
PARTS = ("data", "moving", "centres", "labels", "words", "position", "construction")
"""The parts of the script, in the order in which they run: each uses those before it."""


@cache
def script() -> str:
    """The script, the same for every page."""
    parts = ((HERE / "script" / f"{part}.js").read_text(encoding="utf-8") for part in PARTS)
    return f'"use strict";\n(() => {{\n{"".join(parts)}}})();\n'


@cache
def style() -> str:
    """The style sheet of the page around the pictures."""
    return (HERE / "page.css").read_text(encoding="utf-8")


def policy(styles: str) -> str:
    """A Content-Security-Policy: this script and these styles, no network, no frames, no forms."""
    return (
        f"default-src 'none'; script-src '{_hash(script())}'; style-src '{_hash(styles)}'; "
        "base-uri 'none'; form-action 'none'"
    )


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()

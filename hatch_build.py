"""What a wheel holds beside the package, and its description for where there is no repository to look into."""

import re
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

SETTINGS = ("jupyter_server_config.py", "labconfig", "voila")
"""What JupyterLab and Voila read of .jupyter."""


def carried(root: Path) -> list[Path]:
    """The notebooks with all that they show and read, and the settings they are shown with; nothing that a run left."""
    inside = [root / "notebooks", *(root / ".jupyter" / name for name in SETTINGS)]
    found = [path for each in inside for path in [each, *sorted(each.rglob("*"))] if path.is_file()]
    return [path for path in found if not re.search(r"/[._](?!jupyter/)", f"/{path.relative_to(root).as_posix()}")]


class Notebooks(BuildHookInterface):
    """A wheel carries the notebooks as data of the package; from a clone they are read where they are."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add them to a wheel, but not to what only points to the clone (an editable install)."""
        root = Path(self.root)
        if version != "editable":
            build_data["force_include"] |= {
                str(path): f"camkit/workbook_files/{path.relative_to(root).as_posix()}" for path in carried(root)
            }


class Description(MetadataHookInterface):
    """README.md as a package index shows it."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Relative links would lead nowhere, and relative pictures would be broken."""
        text = (Path(self.root) / "README.md").read_text(encoding="utf-8")
        metadata["readme"] = {"content-type": "text/markdown", "text": elsewhere(text)}


def elsewhere(text: str) -> str:
    """A Markdown text without relative pictures and links; what a link says stays.

    >>> elsewhere("![a panel](images/panel.png) [MIT](LICENSE), [part](#part)")
    ' MIT, [part](#part)'
    """
    text = re.sub(r"!\[[^\]]*\]\((?!\w+:)[^)]*\)", "", text)
    return re.sub(r"\[([^\]]*)\]\((?![#]|\w+:)[^)]*\)", r"\1", text)

"""What `make lab` tells its server; what JupyterLab's pages are set to is in ``labconfig``."""

import platform

from jupyter_server.services.contents.largefilemanager import AsyncLargeFileManager


class Contents(AsyncLargeFileManager):
    """Notebooks as the Python of this machine stores them: JupyterLab would mark others unsaved as they open."""

    async def get(self, path, content=True, **options):
        """A file, with the version of this Python where it is a notebook's."""
        model = await super().get(path, content=content, **options)
        if model["type"] == "notebook" and model["content"]:
            language = model["content"]["metadata"].get("language_info", {})
            if language.get("name") == "python":
                language["version"] = platform.python_version()
        return model


c = get_config()  # noqa: F821  the server gives it
c.ServerApp.contents_manager_class = Contents

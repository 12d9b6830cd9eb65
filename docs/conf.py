"""How Sphinx makes the site: `make docs`.  What it shows beside the texts here is made by the modules in ``made``."""

import sys
from pathlib import Path

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS))

import camkit  # noqa: E402
from made import api, notebooks  # noqa: E402

api.write_pages(DOCS / "api")
notebooks.copy(DOCS.parent / "notebooks", DOCS / "notebooks")

project, author, copyright, release = "camkit", "camkit contributors", "camkit contributors", camkit.__version__
language = "en"
extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "made.checked",
    "made.docstrings",
    "made.formulas",
    "made.gallery",
    "made.held",
    "made.tables",
]
exclude_patterns = ["made"]
default_role = "py:obj"  # what stands in single backticks, where it is something of the package

myst_enable_extensions = ["amsmath", "deflist", "dollarmath", "html_image"]
myst_heading_anchors = 3
myst_heading_slug_func = "made.notebooks.anchor"
nb_execution_mode = "off"
nb_mime_priority_overrides = [("html", "image/png", 1)]  # of a panel its picture: there is no kernel
nb_ipywidgets_js = {}  # these would be asked of another computer
html_math_renderer = "mathml"

autodoc_member_order = "bysource"
autodoc_default_options = {"exclude-members": "set"}  # which matplotlib adds to its kinds of figure
autodoc_preserve_defaults = True
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 100

html_theme = "pydata_sphinx_theme"
html_title = "camkit"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_domain_indices = False
html_copy_source = html_show_sourcelink = False
html_context = {"default_mode": "auto"}  # light or dark as the system is
html_sidebars = {page: [] for page in ("checks", "gallery", "glossary", "index", "papers", "workshop")}
html_theme_options = {
    "navbar_end": ["theme-switcher"],
    "navbar_persistent": ["search-button"],
    "header_links_before_dropdown": 6,
    "show_prev_next": True,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "use_edit_page_button": False,
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}

"""How the guide is built: ``pip install ".[docs]" && sphinx-build -W docs docs/_build/html``.

What is built needs no network: equations are MathML, fonts those of the reader, scripts lie beside the pages.
"""

from __future__ import annotations

import importlib.metadata
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_extensions"))

project = "ballrace"
author = "the ballrace developers"
copyright = author  # noqa: A001 - Sphinx reads this name
release = importlib.metadata.version("ballrace")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "numpydoc",
    "mathml",
    "from_sources",
]
exclude_patterns = ["_build"]

myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3

# Docstrings are NumPy's; a part of a scene lists its fields once, under Attributes.
numpydoc_show_class_members = False
autodoc_member_order = "bysource"
autodoc_typehints = "none"
python_maximum_signature_line_length = 90

html_theme = "furo"
html_title = "ballrace"
html_math_renderer = "mathml"
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"sidebar_hide_name": False}
html_static_path = ["_static"]
html_css_files = ["guide.css"]

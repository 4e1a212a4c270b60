"""The settings of Sphinx. tools/site puts this file beside the pages that it writes; scripts/site.sh builds them."""

import gc
from typing import Any

gc.disable()  # the many small parts of the pages stay to the end: to look for garbage among them takes a third of the time
project = "diecut-report"
html_title = "diecut-report"
author = "the diecut-report authors"
extensions = ["myst_parser"]
root_doc = "index"
exclude_patterns = ["_extra", "_static"]

myst_enable_extensions = ["attrs_block"]
myst_heading_anchors = 5  # links to a part of a page, as repositories on the web make them
highlight_language = "none"
smartquotes = False  # what stands between quotes is typed so

html_theme = "furo"
html_static_path = ["_static"]
html_extra_path = ["_extra"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_show_copyright = False
html_last_updated_fmt = None  # equal sources give equal pages
html_theme_options = {"sidebar_hide_name": False}

NAVIGATION = "furo_navigation_tree"


def setup(app: Any) -> None:
    """Mend what the theme makes, after it has made it."""
    app.connect("html-page-context", with_levels, priority=900)


def with_levels(app: Any, page: str, template: str, context: dict[str, Any], tree: Any) -> None:
    """Give the titles of the contents at the side their level, without which they are no headings for those who listen."""
    context[NAVIGATION] = context[NAVIGATION].replace('role="heading"', 'role="heading" aria-level="2"')

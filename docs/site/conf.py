"""The settings of Sphinx. tools/site puts this file beside the pages that it writes; scripts/site.sh builds them."""

project = "diecut-report"
html_title = "diecut-report"
author = "the diecut-report authors"
extensions = ["myst_parser"]
root_doc = "index"
exclude_patterns = ["_extra", "_static"]

myst_enable_extensions = ["attrs_block"]
myst_heading_anchors = 5  # links to a part of a page, as repositories on the web make them
highlight_language = "none"
pygments_style, pygments_dark_style = "tango", "monokai"
smartquotes = False  # what stands between quotes is typed so

html_theme = "furo"
html_static_path = ["_static"]
html_extra_path = ["_extra"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False
html_last_updated_fmt = None  # equal sources give equal pages
html_theme_options = {"sidebar_hide_name": False}
